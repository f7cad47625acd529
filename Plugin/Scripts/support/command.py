"""The command line of the scripts behind the launcher: arguments, one-line errors, the end of a run."""

import argparse
import contextlib
import os
import re
import resource
import signal
import sys
import time

# NumPy's OpenBLAS, where it is installed, starts threads as soon as it is loaded; a copy of the process (painter.py) may then
# wait for them for ever.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


class Failure(Exception):
    """The work failed; the text is the one line that the user sees."""


class Parser(argparse.ArgumentParser):
    """Wrong arguments are one line on stderr and exit status 2."""

    def error(self, message):
        leave(f"{message} (see {self.prog} --help)", 2)


def parser(name, description, *examples):
    """examples: arguments of the command, one line each."""
    end_at_once_when_stopped()
    program = f"{os.environ.get('MULTISPECTRAL_PROGRAM', './multispectral')} {name}"
    arguments = Parser(prog=program, description=description, allow_abbrev=False,
                       formatter_class=argparse.RawDescriptionHelpFormatter,
                       epilog="\n".join(["examples:"] + [f"  {program} {example}".rstrip() for example in examples]))
    arguments.add_argument("--output", metavar="DIR", default=os.path.join("output", name),
                           help="folder for the results (default: %(default)s)")
    arguments.add_argument("--ranks", metavar="N", type=int, default=1,
                           help="run under MPI with N ranks (default: 1)")
    return arguments


def whole_number(least):
    def parse(text):
        if not text.isdigit() or int(text) < least:
            raise argparse.ArgumentTypeError(f"'{text}' is not a whole number of at least {least}")
        return int(text)
    return parse


def root():
    return os.environ["MULTISPECTRAL_ROOT"]


def in_paraview():
    """Whether pvbatch or pvpython runs this program; else a plain Python does, beside the package multispectral."""
    return "MULTISPECTRAL_PYTHON" not in os.environ


def rank():
    if not in_paraview():
        return 0
    from paraview import servermanager
    return servermanager.vtkProcessModule.GetProcessModule().GetPartitionId()


def ranks():
    if not in_paraview():
        return 1
    from paraview import servermanager
    return servermanager.vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions()


_CONTROL = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\udc80-\udcff]")


def printable(text):
    """Control characters spelled out: names from files may hold sequences that steer a terminal."""
    return _CONTROL.sub(lambda found: f"\\x{ord(found[0]) & 0xff:02X}", text)


def counted(number, noun, plural=None):
    return f"{number} {noun if number == 1 else plural or noun + 's'}"


def say(text):
    if rank() == 0:
        try:
            print(printable(text), flush=True)
        except BrokenPipeError:
            raise
        except OSError as error:
            raise Failure(f"the standard output cannot be written: {error.strerror}") from error


_GRACE = 3.0  # seconds that the first rank has to say what went wrong


def leave(message, status):
    """Ends every rank at once: an exception on one must not leave the others waiting.

    MPI ends all ranks as soon as one has failed, so the others let the first one speak; where it has nothing to say one of
    them speaks."""
    spoken = printable(" ".join(message.split())) if message else ""
    place = _place()
    if place > 0 and status != 0:
        time.sleep(_GRACE)
    if spoken and not _has_the_word():
        spoken = ""
        time.sleep(_GRACE)  # until what the other one said is out
    with contextlib.suppress(OSError, ValueError):  # nobody can be told
        if spoken:
            print(f"multispectral: {spoken}", file=sys.stderr)
        sys.stderr.flush()
        sys.stdout.flush()
    if spoken and _is_parallel():
        time.sleep(0.3)  # MPI forwards what was printed
    os._exit(status)


def _has_the_word():
    """The launcher gives the ranks of a run one file: who removes it speaks for all."""
    try:
        os.remove(os.environ.get("MULTISPECTRAL_WORD", ""))
    except FileNotFoundError:
        return "MULTISPECTRAL_WORD" not in os.environ
    except OSError:
        pass
    return True


def _place():
    """The rank, also before ParaView is loaded."""
    for name in ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"):
        if os.environ.get(name, "").isdigit():
            return int(os.environ[name])
    return rank() if "paraview" in sys.modules else 0


def _is_parallel():
    return any(name in os.environ for name in ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"))


def end_at_once_when_stopped():
    """Ctrl-C ends the process at once, also within a filter, and without the traces that Python, MPI and ParaView print.

    What was being written is under no final name; the next run removes it."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)


def run(main):
    """Runs main() and turns what can go wrong into one line and an exit status."""
    end_at_once_when_stopped()  # ParaView has set its own handlers since
    try:
        main()
        painter = sys.modules.get(f"{__package__}.painter")
        if painter is not None:
            painter.finish()  # no command ends before its pictures are there
        pipeline = sys.modules.get(f"{__package__}.pipeline")
        if pipeline is not None:
            pipeline.tell_notes()
    except Failure as failure:
        leave(str(failure), 1)
    except BrokenPipeError:  # nobody reads on, as behind `| head`
        os._exit(1)
    except UnicodeEncodeError as error:
        leave(f"{error.object}: the name is not UTF-8; rename it", 1)
    except OSError as error:
        leave(": ".join(part for part in (error.filename, error.strerror) if part) or str(error), 1)
    except Exception as error:  # a fault of ours: one line all the same
        if os.environ.get("MULTISPECTRAL_TRACEBACK"):
            raise
        leave(f"internal error, please report it: {type(error).__name__}: {error} "
              "(MULTISPECTRAL_TRACEBACK=1 shows where)", 1)
    except SystemExit as end:
        leave("", end.code if isinstance(end.code, int) else 0)
    _finish()


def _write_peak():
    """For tests: the largest resident set of this process in KiB, into the folder MULTISPECTRAL_PEAKS."""
    folder = os.environ.get("MULTISPECTRAL_PEAKS")
    if folder:
        with open(os.path.join(folder, str(rank())), "w", encoding="ascii") as file:
            print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=file)


def _finish():
    """A normal end, which lets MPI close down; a single process leaves at once."""
    _write_peak()
    if ranks() == 1:
        leave("", 0)
