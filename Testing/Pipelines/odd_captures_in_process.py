"""Every odd capture, read and diagnosed in one program: refused with the right words, or diagnosed with a note."""

import json
import os
import pathlib
import shutil
import sys

sys.path.insert(0, os.path.join(os.environ["MULTISPECTRAL_ROOT"], "Plugin", "Scripts"))
from support import command, diagnosis, image_gap, pipeline  # noqa: E402

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from odd_captures import refused, undecided  # noqa: E402

faults = []


def diagnosed(capture, folder):
    """The report, or the text of the failure."""
    pipeline.forget_messages()
    try:
        place = diagnosis.folder_of(str(capture))
        image_gap.pair(place)
        gap = diagnosis.diagnose(diagnosis.read_capture(str(capture)))
        file = folder / f"{capture.name}.json"
        pipeline.save("GapReportWriter", gap.port("summary"), str(file))
    except command.Failure as failure:
        return None, str(failure)
    return json.loads(file.read_text(encoding="utf-8")), ""


def main():
    folder = pathlib.Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    pipeline.load_plugin()
    for capture, part in refused(folder):
        report, failure = diagnosed(capture, folder)
        if report is not None or part not in failure:
            faults.append(f"{capture.name}: expected '{part}', got '{failure}'")
    for capture, part in undecided(folder):
        report, failure = diagnosed(capture, folder)
        notes = report["notes"] if report else [failure]
        if report is None or (part is not None and not any(part in note for note in notes)):
            faults.append(f"{capture.name}: no note with '{part}' in {notes}")
    print("\n".join(faults) or "all as expected", flush=True)
    os._exit(1 if faults else 0)


main()
