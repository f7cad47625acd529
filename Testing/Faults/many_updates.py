"""Many updates of one pipeline on one pvserver: neither the server nor its client grows.

usage: many_updates.py PVSERVER PVPYTHON FOLDER [UPDATES]      1,000 by default

Every update changes the method of the correction and the places of the profile, so that the tables, the transforms, the
reflectance image, the error maps and their summary are made anew. Prints the resident sets in MiB ten times. Exit status 1
where one grew by more than MOST in the second half. MULTISPECTRAL_ROOT and MULTISPECTRAL_PLUGIN as in the test suite."""

import glob
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Pipelines"))
import client_server  # noqa: E402

MOST = 4.0  # MiB: the C library's heap breathes
METHODS = ("Direct", "Pooled", "R-model", "Banded")


def resident(process):
    with open(f"/proc/{process}/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def client(folder, port, updates):
    from paraview import servermanager, simple
    simple.Connect("127.0.0.1", port)
    pipelines = client_server.Pipelines(simple, servermanager, folder)
    fit = simple.MetamerismCorrection(Calibration=pipelines.chart, Tuning=pipelines.fabric)
    scene = os.path.join(os.environ["MULTISPECTRAL_ROOT"], "Data", "Images", "demo-fabric")
    white, dark = (simple.SpectralImageReader(FileNames=sorted(glob.glob(os.path.join(scene, kind, "channel_*.tif"))))
                   for kind in ("white", "dark"))
    image = simple.FlatFieldCorrection(Input=pipelines.stack, White=white, Dark=dark)
    estimate = simple.ReflectanceEstimation(Input=image, ReflectanceTransform=fit[0], MetamerismTransform=fit[1])
    reference = simple.PatchReferenceImage(Input=pipelines.labels, PatchTable=pipelines.patches)
    errors = simple.CIEDE2000Evaluator(Input=estimate, Reference=reference)
    summary, profile = simple.ErrorSummary(Input=errors), simple.SpectralProfile(Input=estimate, Points=[5, 5])
    seen = set()
    for update in range(1, updates + 1):
        fit.Method = METHODS[update % len(METHODS)]
        profile.Points = [update % 200, update % 150, 100, 50]
        seen.add(repr(pipelines.table(summary)))
        pipelines.table(profile)
        if update % max(1, updates // 10) == 0:
            print(f"update {update}", flush=True)
    if len(seen) != len(METHODS):
        print(f"{len(METHODS)} methods gave {len(seen)} results", flush=True)
    simple.Disconnect()
    os._exit(0)


def main():
    pvserver, pvpython, folder = sys.argv[1:4]
    updates = sys.argv[4] if len(sys.argv) > 4 else "1000"
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    sets = []
    with client_server.Server([pvserver]) as server:
        process = subprocess.Popen([pvpython, __file__, "client", folder, str(server.port), updates], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        for line in process.stdout:
            if line.startswith("update "):
                sets.append((resident(server.process.pid), resident(process.pid)))
                print(f"{line.strip():<14} server {sets[-1][0]:7.1f} MiB, client {sets[-1][1]:7.1f} MiB", flush=True)
            else:
                print(line, end="", flush=True)
        process.wait()
    if process.returncode or len(sets) < 10:
        sys.exit("the client did not come to its end:\n" + "".join(server.output))
    grown = [sets[-1][i] - sets[len(sets) // 2 - 1][i] for i in range(2)]
    print(f"grown in the second half: server {grown[0]:.1f} MiB, client {grown[1]:.1f} MiB")
    sys.exit(1 if max(grown) > MOST else 0)


if __name__ == "__main__":
    if sys.argv[1] == "client":
        client(sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
    else:
        main()
