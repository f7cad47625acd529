"""What the launcher says and does where the system, the network or the build folder is not as it should be.

Each case runs the launcher in a folder of its own with stand-ins for apt-get, dpkg-query, cmake, ninja and id, so that
nothing is installed or built. Arguments: the launcher, a folder."""

import os
import pathlib
import shutil
import subprocess
import sys

TOOLS = ("sh", "sed", "grep", "dirname", "readlink", "mkdir", "cat", "rm", "wc", "flock", "env", "nproc", "sleep", "touch",
         "id", "python3", "awk")
# dpkg-query: the packages in the file 'have' are installed; apt-get install puts there what it is asked for.
DPKG_QUERY = 'for p in $(cat "$STATE/have" 2>/dev/null); do echo "installed $p"; done'
APT_GET = '''case "$*" in
  *" update") exit 0 ;;
  *" install "*) for p in "$@"; do case $p in -*|install) ;; *) echo "$p" >>"$STATE/have" ;; esac; done ;;
esac'''
CMAKE = '''case " $* " in *" -DBUILD_TESTING=OFF "*) done=configured ;; *) done=configured-with-tests ;; esac
while [ $# -gt 0 ]; do [ "$1" = -B ] && tree=$2; shift; done
echo $done >>"$STATE/log"
mkdir -p "$tree"
{ echo "CMAKE_HOME_DIRECTORY:INTERNAL=$ROOT"; echo "CMAKE_CACHEFILE_DIR:INTERNAL=$tree"; } >"$tree/CMakeCache.txt"
touch "$tree/build.ninja"'''
NINJA = '''case "$*" in *" -n "*) [ -f "$2/built" ] && echo "ninja: no work to do."; exit 0 ;; esac
echo built >>"$STATE/log"; sleep 1; touch "$2/built"'''


class Case:
    """A clone with the launcher alone, and a system made of stand-ins."""

    def __init__(self, launcher, folder, **stand_ins):
        self.root, self.state, self.bin = folder / "clone", folder / "state", folder / "bin"
        for place in (self.root, self.state, self.bin):
            place.mkdir(parents=True)
        for name in ("multispectral", "packages.txt"):
            shutil.copy(pathlib.Path(launcher).parent / name, self.root)
        for tool in TOOLS:
            os.symlink(shutil.which(tool), self.bin / tool)
        for name, text in {"dpkg-query": DPKG_QUERY, "apt-get": APT_GET, "cmake": CMAKE, "ninja": NINJA, "dpkg": "",
                           **stand_ins}.items():
            name = name.replace("_", "-")
            (self.bin / name).unlink(missing_ok=True)
            if text is not None:
                (self.bin / name).write_text(f"#!/bin/sh\n{text}\n", encoding="ascii")
                (self.bin / name).chmod(0o755)

    def start(self, *arguments, **environment):
        return subprocess.Popen(["sh", self.root / "multispectral", *arguments], text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, cwd=self.root,
                                env={"PATH": str(self.bin), "STATE": str(self.state), "ROOT": str(self.root), **environment})

    def run(self, *arguments, **environment):
        process = self.start(*arguments, **environment)
        process.out, process.err = process.communicate(timeout=60)
        return process

    def log(self):
        path = self.state / "log"
        return path.read_text(encoding="ascii").split() if path.exists() else []


def expect(condition, text):
    if not condition:
        raise SystemExit(text)


def one_line(done, beginning):
    lines = done.err.strip().splitlines()
    lines = [line for line in lines if not line.startswith("multispectral: note: ")]
    expect(done.returncode == 1 and len(lines) == 1 and lines[0].startswith(f"multispectral: {beginning}"),
           f"expected one line '{beginning}': status {done.returncode}\n{done.err}\n{done.out}")


def ready(case, **environment):
    done = case.run("setup", **environment)
    expect(done.returncode == 0 and done.out.splitlines()[-1].startswith("The plugin is ready"),
           f"setup: {done.returncode}\n{done.out}{done.err}")
    return done


def what_is_missing(launcher, folder):
    case = Case(launcher, folder / "no-apt", apt_get=None)
    one_line(case.run("setup"), "this is no Debian system and these tools were not found: c++ pkg-config pvbatch paraview; ")
    case = Case(launcher, folder / "no-sudo", id="echo 1000")
    one_line(case.run("setup"), "packages are missing and there is no sudo; as root: apt-get install ")
    expect(case.log() == [], "something was built")


def what_apt_says(launcher, folder):
    case = Case(launcher, folder / "no-network", apt_get="echo 'W: Failed to fetch http://x  Could not resolve x'")
    one_line(case.run("setup"), "the lists of packages cannot be fetched: W: Failed to fetch http://x")
    case = Case(launcher, folder / "no-package",
                apt_get='case "$*" in *" install "*) echo "E: Unable to locate package paraview"; exit 100 ;; esac')
    one_line(case.run("setup"), "apt-get install failed: E: Unable to locate package paraview; the log is ")
    (case.bin / "apt-get").write_text(f"#!/bin/sh\n{APT_GET}\n", encoding="ascii")
    ready(case)


def what_a_build_left(launcher, folder):
    case = Case(launcher, folder / "build")
    ready(case)
    ready(case)
    expect(case.log() == ["configured", "built"], f"a second start did {case.log()}")
    tree = case.root / "build" / "plugin"
    (tree / "build.ninja").unlink()
    (tree / "built").unlink()
    ready(case)
    expect(case.log()[2:] == ["configured", "built"], "a half-finished build was not taken up")
    case.root.rename(folder / "build" / "elsewhere")
    case.root = folder / "build" / "elsewhere"
    done = ready(case)
    expect("was made for another folder; it is built anew" in done.out, f"moved: {done.out}")
    expect(case.log()[4:] == ["configured", "built"], "a moved build was not made anew")

    case = Case(launcher, folder / "wrong", ninja="echo 'a.cpp:1: error: what'; exit 1")
    done = case.run("setup")
    expect(done.returncode == 1 and done.err.splitlines()[0] == "a.cpp:1: error: what" and
           done.err.splitlines()[-1].startswith("multispectral: the build failed; the log is "), done.err)
    case = Case(launcher, folder / "cmake", cmake="echo 'CMake Error at x:1'; exit 1")
    done = case.run("setup")
    expect("multispectral: configuring failed; the log is " in done.err, done.err)


def where_nothing_can_be_written(launcher, folder):
    case = Case(launcher, folder / "read-only")
    one_line(case.run("setup", MULTISPECTRAL_BUILD="/proc/multispectral"),
             "cannot write to /proc/multispectral; clone the project to a folder of your own")
    ready(case, MULTISPECTRAL_BUILD=str(folder / "own build"))
    expect((folder / "own build" / "plugin" / "built").exists(), "nothing was built in the folder that was named")


def two_at_once(launcher, folder):
    case = Case(launcher, folder / "two")
    started = [case.start("setup") for _ in range(3)]
    ended = [process.communicate(timeout=60) for process in started]
    expect([process.returncode for process in started] == [0, 0, 0], f"{ended}")
    expect(case.log() == ["configured", "built"], f"three starts did {case.log()}")
    expect(sum("Waiting for another command" in out for out, _ in ended) == 2, f"{ended}")


def main(launcher, folder):
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    for case in (what_is_missing, what_apt_says, what_a_build_left, where_nothing_can_be_written, two_at_once):
        case(launcher, folder)
        print(f"{case.__name__}: as expected")


main(*sys.argv[1:])
