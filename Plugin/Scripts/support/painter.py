"""Draws pictures in a process of its own while the program goes on.

The process is a copy of this one, made before there are threads. It loads what draws, then draws each picture in a copy
of itself, as many at once as there are processors. In ParaView, which MPI may have started, pictures are drawn at once."""

import os
import pickle
import signal
import struct

from . import command, outputs
from .command import Failure

_LENGTH = struct.Struct("<Q")
_ENDED = "the process that draws the pictures ended; was it killed, or is there too little memory?"
_orders = None  # where what is to be drawn is written to
_answers = None  # where what went wrong is read from


def start():
    global _orders, _answers
    if command.in_paraview() or _orders is not None:
        return
    from_program, orders = os.pipe()
    answers, to_program = os.pipe()
    if os.fork() == 0:
        os.close(orders)
        os.close(answers)
        _serve(os.fdopen(from_program, "rb"), os.fdopen(to_program, "wb"))
        os._exit(0)
    os.close(from_program)
    os.close(to_program)
    _orders, _answers = os.fdopen(orders, "wb"), os.fdopen(answers, "rb")


def draw(path, function, *arguments):
    """function(path, *arguments) draws the picture; it is of a module of this package, the arguments are plain data."""
    if command.rank() != 0:
        return
    if _orders is None:
        function(path, *arguments)
    else:
        _order((function, (outputs.check(path), *arguments)))


def finish():
    """Returns when all pictures are there."""
    if _orders is None:
        return
    _order(None)
    try:
        fault = _receive(_answers)
    except EOFError:
        raise Failure(_ENDED) from None
    if fault:
        raise Failure(fault)


def _order(content):
    try:
        _send(_orders, content)
    except BrokenPipeError:
        raise Failure(_ENDED) from None


def _send(file, content):
    data = pickle.dumps(content, protocol=pickle.HIGHEST_PROTOCOL)
    file.write(_LENGTH.pack(len(data)) + data)
    file.flush()


def _receive(file):
    """The next content; EOFError where there is none."""
    length = file.read(_LENGTH.size)
    if len(length) < _LENGTH.size:
        raise EOFError
    return pickle.loads(file.read(_LENGTH.unpack(length)[0]))


def _serve(orders, answers):
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # Who waits for the end of the program's output does not wait for this process.
    outputs.leave_to_original()
    nothing = os.open(os.devnull, os.O_RDWR)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)
    try:
        import matplotlib.backends.backend_agg  # noqa: F401
        from matplotlib import pyplot  # noqa: F401
        most, running, faults = len(os.sched_getaffinity(0)), {}, []
        while True:
            order = _receive(orders)
            while running and (order is None or len(running) >= most):
                _await_one(running, faults)
            if order is None:
                _send(answers, faults[0] if faults else None)
                faults = []
            else:
                _draw_apart(*order, running)
    except (EOFError, BrokenPipeError):  # the program has ended
        pass


def _draw_apart(function, arguments, running):
    told, tell = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(told)
        try:
            function(*arguments)
        except BaseException as error:
            text = f"{error.filename}: {error.strerror}" if isinstance(error, OSError) and error.filename else str(error)
            kind = "" if isinstance(error, (OSError, Failure)) else \
                f"internal error, please report it: {type(error).__name__}: "
            os.write(tell, (kind + text).encode("utf-8", "replace"))
        os._exit(0)
    os.close(tell)
    running[process] = told


def _await_one(running, faults):
    process, status = os.wait()
    with os.fdopen(running.pop(process), "rb") as told:
        text = told.read().decode("utf-8", "replace")
    if text or status != 0:
        faults.append(text or "a picture could not be drawn")
