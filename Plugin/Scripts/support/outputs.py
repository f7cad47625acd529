"""The files that a command writes: none is one of its inputs, and each is complete or absent."""

import contextlib
import fcntl
import fnmatch
import html
import itertools
import json
import os
import re
import socket

from . import command
from .command import Failure

END_OF_PNG = b"IEND\xaeB`\x82"
# An input in two files: who names one reads both.
_PARTNERS = ({".hdr", ".img", ".dat", ".raw", ".bil", ".bsq", ".bip", ".bin", ".cube", ".sli"}, {".json", ".csv"})
_inputs = {}  # (device, inode): the name that the user gave
_declared = None  # the folder, and the patterns of what is written into it
_old_report = None  # until the first result of this run
_written = {}  # what this run wrote, in order
_LIST = re.compile(r"<meta name='multispectral-files' content='([^']*)'>")
_numbers = itertools.count()
_locks = []  # folders that this run holds, until it ends


def reads(*paths):
    """Notes the input files."""
    for path in filter(None, paths):
        _require_utf8(path, "rename the file or its folder")
        for file in _files_of(path):
            with contextlib.suppress(OSError):
                status = os.stat(file)
                _inputs[status.st_dev, status.st_ino] = path


def require_files(*paths):
    """Each is there; from now on none of them is written over."""
    for path in paths:
        if path is not None and not os.path.isfile(path):
            raise Failure(f"{path}: no such file")
    reads(*paths)


def _require_utf8(path, remedy):
    if any("\udc80" <= c <= "\udcff" for c in path):
        raise Failure(f"{command.printable(path)}: the name is not UTF-8; {remedy}")


def _files_of(path):
    stem, extension = os.path.splitext(path)
    partners = next((group for group in _PARTNERS if extension.lower() in group), ())
    return [path] + [stem + other for other in sorted(partners) if stem + other != path]


def make_folder(path):
    """Also one within the output folder, which claim() makes."""
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise Failure(f"{path}: cannot make the output folder: {error.strerror}") from error
    return path


def claim(folder, patterns):
    """Makes the output folder this run's own, before anything is written.

    patterns: what the command may write into it, names or FOLDER/names with * and ?. Where one of those files is an input the command is refused; where
    another run writes into the folder, too. What killed runs left unfinished is removed."""
    global _declared, _old_report
    _require_utf8(folder, "choose another folder with --output")
    require_apart(folder, patterns)
    make_folder(folder)
    _declared = folder, tuple(patterns)
    if command.rank() == 0:
        _lock(folder)
        for place in {os.path.dirname(pattern) for pattern in patterns}:
            _remove_stale_parts(os.path.join(folder, place))
    _written.clear()
    _old_report = os.path.join(folder, "report.html") if "report.html" in patterns else None
    return folder


def leave_to_original():
    """In a copy of the process, which writes only what the original has checked."""
    global _declared, _old_report
    _declared = _old_report = None
    _inputs.clear()
    while _locks:
        os.close(_locks.pop())


def require_apart(folder, patterns):
    """Refuses an output folder where one of the files that the command may write is an input."""
    for pattern in patterns:
        for path in _existing(folder, pattern):
            _refuse_input(path)


def _existing(folder, pattern):
    place, names = os.path.join(folder, os.path.dirname(pattern)), os.path.basename(pattern)
    with contextlib.suppress(OSError):
        return [os.path.join(place, name) for name in os.listdir(place) if fnmatch.fnmatchcase(name, names)]
    return []


def _refuse_input(path):
    with contextlib.suppress(OSError):
        status = os.stat(path)
        given = _inputs.get((status.st_dev, status.st_ino))
        if given is not None:
            raise Failure(f"{given}: is an input, and the command would write {path} over it; "
                          "choose another folder with --output")


def _lock(folder):
    with contextlib.suppress(OSError):  # not every file system has locks
        descriptor = os.open(folder, os.O_RDONLY | os.O_CLOEXEC)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Failure(f"{folder}: another run writes into this folder; wait for it, or choose another folder "
                          "with --output") from None
        _locks.append(descriptor)


def _host():
    return re.sub(r"[/.-]", "_", socket.gethostname())[:16]


def _remove_stale_parts(folder):
    """.STEM.HOST-PROCESS-NUMBER.part.EXTENSION, as the plugin's writers name them, of processes that are no more."""
    part = re.compile(r"\..+\." + re.escape(_host()) + r"-(\d+)-\d+\.part(\.[^.]*)?")
    with contextlib.suppress(OSError):
        for name in os.listdir(folder):
            found = part.fullmatch(name)
            if found and _is_gone(found[1]):
                os.remove(os.path.join(folder, name))


def _is_gone(process):
    """Also where it ended and nobody asked for its status, as in containers whose first process asks for none."""
    try:
        with open(f"/proc/{process}/stat", encoding="ascii", errors="replace") as status:
            return status.read().rpartition(")")[2].split()[0] in "ZX"
    except FileNotFoundError:
        return True
    except OSError:
        return False


def _require_declared(path):
    """For tests: MULTISPECTRAL_CHECK_OUTPUTS makes an output that its command did not declare an error."""
    if _declared is not None and os.environ.get("MULTISPECTRAL_CHECK_OUTPUTS"):
        folder, patterns = _declared
        name = os.path.relpath(path, folder)
        if not any(os.path.dirname(pattern) == os.path.dirname(name) and fnmatch.fnmatchcase(name, pattern)
                   for pattern in patterns):
            raise AssertionError(f"{name} is not declared as an output of this command")


def check(path):
    """Before another writer writes 'path'."""
    _require_declared(path)
    for file in _files_of(path):
        _refuse_input(file)
    _remove_old_results()
    _written[path] = None
    return path


def _remove_old_results():
    """With the first result: the report of an earlier run, and what it says that the run wrote, must not stand beside newer
    results."""
    global _old_report
    if _old_report is not None and command.rank() == 0:
        path, _old_report = _old_report, None
        folder, patterns = _declared
        for name in _listed_in(path):
            place, base = os.path.split(name)
            if any(place == os.path.dirname(pattern) and fnmatch.fnmatchcase(base, os.path.basename(pattern))
                   for pattern in patterns):
                old = os.path.join(folder, name)
                _refuse_input(old)
                _remove(old)
        _remove(path)


def list_of_written():
    """What this run has written, for its report: the next run into the same folder removes it."""
    files = dict.fromkeys(file for path in _written for file in _files_of(path) if file == path or os.path.isfile(file))
    names = [os.path.relpath(file, _declared[0]) for file in files] if _declared else []
    return f"<meta name='multispectral-files' content='{html.escape(json.dumps(names), quote=True)}'>"


def _listed_in(report):
    with contextlib.suppress(OSError, ValueError), open(report, encoding="utf-8", errors="replace") as file:
        found = _LIST.search(file.read(1 << 16))
        names = json.loads(html.unescape(found[1])) if found else []
        return [name for name in names if isinstance(name, str)]
    return []


def remove(path):
    """An output of an earlier run that this one does not have."""
    check(path)
    _written.pop(path, None)
    _remove(path)


def _remove(path):
    try:
        os.remove(path)
    except FileNotFoundError:
        pass
    except OSError as error:
        raise Failure(f"{path}: cannot be removed: {error.strerror}") from error


@contextlib.contextmanager
def written(path, ending=b""):
    """Gives the name to write to; the file takes the name 'path' when it is complete, which 'ending' tells."""
    check(path)
    stem, extension = os.path.splitext(os.path.basename(path))
    part = os.path.join(os.path.dirname(path), f".{stem}.{_host()}-{os.getpid()}-{next(_numbers)}.part{extension}")
    try:
        yield part
        if os.path.exists(part) or command.rank() == 0:
            _complete(part, path, ending)
    except OSError as error:
        raise Failure(f"{path}: cannot be written: {error.strerror or error}; check the folder, its access rights and "
                      "the free space") from error
    finally:
        with contextlib.suppress(OSError):
            os.remove(part)


def _complete(part, path, ending):
    with open(part, "rb") as file:
        file.seek(0, os.SEEK_END)
        size = file.tell()
        file.seek(max(0, size - len(ending)))
        if size == 0 or file.read(len(ending)) != ending:
            raise OSError(0, "it is not complete")
        os.fsync(file.fileno())
    os.replace(part, path)


def write_text(path, text):
    with written(path) as part, open(part, "w", encoding="utf-8", errors="backslashreplace") as file:
        file.write(text)
