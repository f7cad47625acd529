"""The command line of the scripts behind the launcher: arguments, one-line errors, the output folder."""

import argparse
import os
import resource
import sys


class Failure(Exception):
    """The work failed; the text is the one line that the user sees."""


class Parser(argparse.ArgumentParser):
    """Wrong arguments are one line on stderr and exit status 2."""

    def error(self, message):
        leave(f"{message} (see {self.prog} --help)", 2)


def parser(name, description, *examples):
    """examples: arguments of the command, one line each."""
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


def require_files(*paths):
    for path in paths:
        if path is not None and not os.path.isfile(path):
            raise Failure(f"{path}: no such file")


def make_folder(path):
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise Failure(f"{path}: cannot make the output folder: {error.strerror}") from error
    return path


def root():
    return os.environ["MULTISPECTRAL_ROOT"]


def rank():
    from paraview import servermanager
    return servermanager.vtkProcessModule.GetProcessModule().GetPartitionId()


def say(text):
    if rank() == 0:
        print(text, flush=True)


def leave(message, status):
    """Ends every rank at once: an exception on one must not leave the others waiting."""
    if message and (status == 2 or rank() == 0):
        print(f"multispectral: {message}", file=sys.stderr)
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def run(main):
    """Runs main() and turns what can go wrong into one line and an exit status."""
    try:
        main()
    except Failure as failure:
        leave(str(failure), 1)
    except BrokenPipeError:  # nobody reads on, as behind `| head`
        os._exit(1)
    except OSError as error:
        leave(f"{error.filename}: {error.strerror}", 1)
    except Exception as error:  # a fault of ours: one line all the same
        if os.environ.get("MULTISPECTRAL_TRACEBACK"):
            raise
        leave(f"internal error, please report it: {type(error).__name__}: {error} "
              "(MULTISPECTRAL_TRACEBACK=1 shows where)", 1)
    except KeyboardInterrupt:
        leave("stopped", 1)
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
    from paraview import servermanager
    _write_peak()
    if servermanager.vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions() == 1:
        leave("", 0)
