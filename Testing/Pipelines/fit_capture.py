"""A capture from two measured tables: fit_capture.py CHART TARGET FOLDER. The simulated camera is fitted to the chart, the
real one is what the target's table holds."""

import json
import os
import pathlib
import shutil
import sys

from paraview import servermanager, simple

simple.LoadPlugin(os.environ["MULTISPECTRAL_PLUGIN"], remote=False, ns=simple.__dict__)
chart, target, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
folder.mkdir(parents=True)
fit = simple.CameraModelFit(Input=simple.SampleTableReader(FileName=chart))
servermanager.writers.CameraWriter(Input=fit[0], FileName=str(folder / "camera.json")).UpdatePipeline()
description = json.loads((folder / "camera.json").read_text(encoding="utf-8"))
(folder / "camera.json").unlink()
(folder / "capture.json").write_text(json.dumps(
    {"name": "fitted to a chart", "white_level": 1, "dark": description["dark"], "noise": None}),
    encoding="utf-8")
for name in ("samples.csv", "responses.csv"):
    shutil.copy(target, folder / name)
