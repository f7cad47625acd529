#!/usr/bin/env python3
"""Runs clang-tidy over the project's own sources, those of the tests excepted.

A source that was clean stays clean until it, a header of ours that it includes, its compile command or
.clang-tidy changes; BUILD/tidy remembers.

The clang analyzer's checks take longer than all others together and run with --analyze only.

usage: check_tidy.py CLANG_TIDY ROOT BUILD JOBS [--analyze]
"""

import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys

ROOMS = ("Filters/", "Readers/", "Plugin/")
TEST = re.compile(r"(^|/)(Testing/|Test[A-Z]\w*(/|\.(cpp|cxx)\b)|\w+Probe\.cpp$)")
GROUP = re.compile(r"/Unity/\w+/unity_\w+\.cxx$")
WRAPPERS = "Plugin/CMakeFiles/"  # generated
# The sources of a group are included by it: checked like a main file. GCC's own warnings are unknown to clang, and clang's are not asked for.
ARGUMENTS = ("--extra-arg=-Wno-unknown-warning-option", "--extra-arg=-Wno-error", "--checks=-bugprone-suspicious-include,-clang-analyzer-*")
ANALYZE = ("--extra-arg=-Wno-unknown-warning-option", "--extra-arg=-Wno-error", "--extra-arg=-Xclang", "--extra-arg=-analyzer-opt-analyze-headers",
           "--checks=-*,clang-analyzer-*,-clang-analyzer-optin.cplusplus.VirtualCall")


def own_sources(root, build):
    """Path below the root and compile command of each source."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        commands = json.load(file)
    found = {}
    for entry in commands:
        # Sources that are compiled together are checked together.
        base = build if GROUP.search(entry["file"]) else root
        path = os.path.relpath(entry["file"], base)
        if path.startswith(ROOMS) and not path.startswith(WRAPPERS) and not TEST.search(path):
            found[os.path.relpath(entry["file"], root)] = entry
    return found


def headers_of_objects(root, build, listing):
    """For each object file the project's own files that it was built from, out of ninja's listing; ccache makes paths relative to the build."""
    headers = {}
    current = None
    for line in listing.splitlines():
        if line.startswith(" ") and current is not None:
            path = os.path.normpath(os.path.join(build, line.strip()))
            if path.startswith(root + os.sep):
                current.append(path)
        elif line and not line.startswith("ninja:"):
            current = headers.setdefault(line.split(":")[0], [])
    return headers


def key_of(root, entry, headers, configuration):
    digest = hashlib.sha256(configuration)
    digest.update(entry["command"].encode())
    name = re.search(r" -o (\S+)", entry["command"])
    for path in [entry["file"], *sorted(set(headers.get(name.group(1), []) if name else []))]:
        with open(path, "rb") as file:
            digest.update(os.path.relpath(path, root).encode() + b"\0" + file.read())
    return digest.hexdigest()


def tidy(tool, build, arguments, path):
    run = subprocess.run([tool, "-p", build, "--quiet", *arguments, path], capture_output=True, text=True)
    # The counts of suppressed warnings of system headers say nothing.
    noise = re.compile(r"^\d+ warnings? (generated|treated)|^Suppressed|^Use -header-filter")
    errors = "\n".join(line for line in run.stderr.splitlines() if not noise.match(line))
    return run.returncode, (run.stdout + (errors if run.returncode else "")).strip()


def main():
    tool, root, build, jobs = sys.argv[1:5]
    arguments = ANALYZE if sys.argv[5:] == ["--analyze"] else ARGUMENTS
    root, build = os.path.realpath(root), os.path.realpath(build)
    sources = own_sources(root, build)
    if not sources:
        print(f"{build}: no sources of {root} in compile_commands.json")
        return 1
    version = subprocess.run([tool, "--version"], capture_output=True, check=True).stdout
    with open(os.path.join(root, ".clang-tidy"), "rb") as file:
        configuration = version + " ".join(arguments).encode() + file.read()
    listing = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    headers = headers_of_objects(root, build, listing)
    memory = os.path.join(build, "tidy" if arguments is ARGUMENTS else "analyzer")
    os.makedirs(memory, exist_ok=True)
    stamps = {path: os.path.join(memory, key_of(root, entry, headers, configuration))
              for path, entry in sources.items()}
    due = [path for path in sorted(sources) if not os.path.exists(stamps[path])]
    print(f"{len(sources)} sources, {len(sources) - len(due)} known to be clean", flush=True)
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(int(jobs)) as pool:
        runs = {path: pool.submit(tidy, tool, build, arguments, os.path.join(root, path)) for path in due}
        for path, run in runs.items():
            status, text = run.result()
            if status == 0:
                open(stamps[path], "w", encoding="utf-8").close()
            else:
                failed += 1
                print(text, flush=True)
    for stale in set(os.listdir(memory)) - {os.path.basename(stamp) for stamp in stamps.values()}:
        os.remove(os.path.join(memory, stale))
    print(f"{failed} of {len(sources)} sources with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
