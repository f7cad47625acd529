"""The corrected camera of a diagnosis, written to a file and read again, simulates what the real camera answered."""

import math
import os
import pathlib
import sys

from paraview import servermanager, simple

simple.LoadPlugin(os.environ["MULTISPECTRAL_PLUGIN"], remote=False, ns=simple.__dict__)
root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
NOISE_OF_TWO = 0.001  # the capture's reading noise at white, sqrt(read^2 + shot^2) / sqrt(2)

capture = simple.CaptureReader(FileName=str(root / "Data" / "Captures" / "demo-warm-camera"))
gap = simple.SimToRealGap(Camera=capture[0], Samples=capture[1], Responses=capture[2])
path = folder / "camera-corrected.json"
servermanager.writers.CameraWriter(Input=gap[7], FileName=str(path)).UpdatePipeline()

responses = servermanager.Fetch(capture, idx=2)
channels = [f"C{k}" for k in range(1, 17)]
real = {}
for row in range(responses.GetNumberOfRows()):
    real.setdefault(responses.GetValueByName(row, "sample").ToString(), []).append(
        [responses.GetValueByName(row, name).ToDouble() for name in channels])


def rms_of(simulator):
    simulator.UpdatePipeline()
    table = servermanager.Fetch(simulator)
    squares = []
    for row in range(table.GetNumberOfRows()):
        readings = real[table.GetValueByName(row, "sample").ToString()]
        for k, name in enumerate(channels):
            mean = sum(reading[k] for reading in readings) / len(readings)
            squares.append((mean - table.GetValueByName(row, name).ToDouble()) ** 2)
    return math.sqrt(sum(squares) / len(squares))


before = rms_of(simple.CameraSimulator(Input=capture[1], Camera=capture[0], Noise="None"))
after = rms_of(simple.CameraSimulator(Input=capture[1], Camera=simple.CameraReader(FileName=str(path)),
                                     Noise="None"))
print(f"rms {before:.5f} before, {after:.5f} after")
held_out = servermanager.Fetch(gap, idx=0).GetValueByName(0, "rms_before").ToDouble()
faults = []
if abs(before - held_out) > 1e-9:
    faults.append(f"the diagnosis says {held_out} before, the simulator {before}")
if after > NOISE_OF_TWO:
    faults.append(f"{after} is left; expected no more than noise, {NOISE_OF_TWO}")
print("\n".join(faults) or "the corrected camera is the real one, but for noise")
sys.stdout.flush()
os._exit(1 if faults else 0)
