"""The pipeline as a ParaView state that opens with the RGB view and the error map side by side.

In ParaView the state is saved at once. Elsewhere this file, as a program of pvbatch, makes the pipeline again from its
recipe and saves it, beside what else there is to do."""

import json
import os
import subprocess
import sys

if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    __package__ = "support"

from . import command, outputs, pipeline  # noqa: E402

_running = []


def save(path, color, errors=None, top=1.0, array="dE00 D65"):
    """color: image with the array sRGB; errors: image with the named array, whose color scale ends at top."""
    if command.in_paraview():
        _save(path, color, errors, top, array)
    else:
        from . import plain
        made, places = plain.recipe(color, *([errors] if errors else []))
        work = {"path": outputs.check(path), "top": top, "array": array, "made": made, "places": places}
        environment = {name: value for name, value in os.environ.items() if name != "MULTISPECTRAL_PYTHON"}
        process = subprocess.Popen(["pvbatch", os.path.abspath(__file__), json.dumps(work)], env=environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        _running.append((path, process))


def finish():
    """Waits for the states that are being saved."""
    while _running:
        path, process = _running.pop()
        said = process.communicate()[1].strip().splitlines()
        if process.returncode != 0:
            raise command.Failure(f"{path}: the state was not saved" + (f": {said[-1]}" if said else ""))


def _save(path, color, errors, top, array):
    from paraview import simple

    from . import views
    color.UpdatePipelineInformation()
    shown = [views.image_view(color, "sRGB", rgb=True)]
    if errors is not None:
        errors.UpdatePipelineInformation()
        shown.append(views.image_view(errors, array, (0.0, top)))
    views.side_by_side(shown)
    if command.rank() == 0:
        with outputs.written(path, b"</GenericParaViewApplication>\n") as part:
            simple.SaveState(part)


def _main():
    work = json.loads(sys.argv[1])
    pipeline.load_plugin()
    sources = []
    for name, given in work["made"]:
        given = {key: sources[value["proxy"]][value["port"]] if isinstance(value, dict) else value
                 for key, value in given.items()}
        sources.append(pipeline.create(name, **given))
    color, *errors = (sources[place] for place in work["places"])
    _save(work["path"], color, errors[0] if errors else None, work["top"], work["array"])


if __name__ == "__main__":
    command.run(_main)
