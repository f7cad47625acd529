"""A client of a pvserver, on one rank and on two, gets the tables, images and files of ParaView by itself.

Arguments: pvserver, pvpython, mpiexec, a folder. Under pvpython the same file is the client: 'client', a folder, a port.
"""

import filecmp
import glob
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import threading

START = 60  # s, at most, until a server listens
WORK = 240  # s, at most, for a client
TRIES = 3


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Server:
    """A pvserver on a free port, gone at the end of the block whatever happens in it."""

    def __init__(self, command):
        self.command = command

    def __enter__(self):
        for _ in range(TRIES):
            self.port = free_port()
            self.output = []
            self.process = subprocess.Popen(
                [*self.command, f"--server-port={self.port}"], text=True, stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
            listening = threading.Event()
            threading.Thread(target=self._read, args=(listening,), daemon=True).start()
            listening.wait(START)
            if any("Accepting connection" in line for line in self.output):
                return self
            self.__exit__()
        raise SystemExit("the server does not listen:\n" + "".join(self.output))

    def _read(self, listening):
        for line in self.process.stdout:
            self.output.append(line)
            if "Accepting connection" in line:
                listening.set()
        listening.set()  # it has ended

    def __exit__(self, *_):
        for kind in (signal.SIGTERM, signal.SIGKILL):
            try:
                os.killpg(self.process.pid, kind)
                self.process.wait(10)
            except ProcessLookupError:
                return
            except subprocess.TimeoutExpired:
                continue


def drive(pvserver, pvpython, mpiexec, folder):
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    as_root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
    several = [mpiexec, "-q", *as_root, "--oversubscribe", "-np", "2", pvserver]
    faults = []
    for name, command in (("1 rank", [pvserver]), ("2 ranks", several)):
        with Server(command) as server:
            try:
                done = subprocess.run([pvpython, __file__, "client", folder / name.replace(" ", "-"),
                                       str(server.port)], text=True,
                                      timeout=WORK, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            except subprocess.TimeoutExpired as late:
                raise SystemExit(f"{name}: no answer after {WORK} s\n{late.stdout}\n" + "".join(server.output))
            print(f"{name}: {done.stdout}", end="")
            if done.returncode != 0:
                faults.append(f"{name}: status {done.returncode}\n" + "".join(server.output))
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


class Pipelines:
    """What a user makes of the demo's image, on whichever server is connected."""

    def __init__(self, simple, servermanager, folder):
        root = os.environ["MULTISPECTRAL_ROOT"]
        scene = os.path.join(root, "Data", "Images", "demo-fabric")
        self.simple, self.manager, self.folder, self.scene = simple, servermanager, folder, scene
        simple.LoadPlugin(os.environ["MULTISPECTRAL_PLUGIN"], remote=True, ns=simple.__dict__)
        simple.LoadPlugin(os.environ["MULTISPECTRAL_PLUGIN"], remote=False, ns=simple.__dict__)
        self.chart = simple.SampleTableReader(FileName=os.path.join(root, "Data", "Samples", "demo-chart.csv"))
        self.fabric = simple.SampleTableReader(FileName=os.path.join(root, "Data", "Samples", "demo-fabric.csv"))
        self.patches = simple.SampleTableReader(FileName=os.path.join(scene, "patches.csv"))
        self.labels = simple.LabelImageReader(FileName=os.path.join(scene, "labels.png"))
        self.stack = simple.SpectralImageReader(FileNames=sorted(glob.glob(os.path.join(scene, "channel_*.tif"))))

    def write(self, source, name, **options):
        path = os.path.join(self.folder, name)
        self.simple.SaveData(path, proxy=source, **options)
        return path

    def run(self):
        """All results by name: tables as lists of rows, images as lists of values; files lie in the folder."""
        simple = self.simple
        cube = simple.SpectralImageReader(FileNames=[self.write(self.stack, "cube.img")])
        samples = simple.PatchSampler(Input=cube, Labels=self.labels, PatchTable=self.patches)
        fit = simple.MetamerismCorrection(Calibration=self.chart, Tuning=self.fabric, Method="Pooled")
        estimate = simple.ReflectanceEstimation(Input=cube, ReflectanceTransform=fit[0],
                                                MetamerismTransform=fit[1], TrustResponses=True)
        # The same counts without a word for them: refused, also where each rank has a part of the image.
        refused = simple.ReflectanceEstimation(Input=cube, ReflectanceTransform=fit[0], MetamerismTransform=fit[1])
        refused.UpdatePipeline()
        # All parts of a scene, one after another: each keeps what it had.
        scene = simple.SceneReader(FileName=self.scene)
        of_scene = simple.ReflectanceEstimation(Input=scene[0], ReflectanceTransform=fit[0], MetamerismTransform=fit[1])
        of_scene.UpdatePipeline()
        simple.PatchReferenceImage(Input=scene[1], PatchTable=scene[2]).UpdatePipeline()
        reference = simple.PatchReferenceImage(Input=self.labels, PatchTable=self.patches)
        errors = simple.CIEDE2000Evaluator(Input=estimate, Reference=reference)
        self.write(estimate, "reflectance.exr")
        self.write(samples, "samples.ti3")
        results = {
            "chart": self.table(self.chart), "samples": self.table(samples),
            "transform": self.table(fit[0]), "fit": self.table(fit[2]),
            "profile of a scene": self.table(simple.SpectralProfile(Input=of_scene, Points=[21, 160, 190, 75])),
            "profile": self.table(simple.SpectralProfile(Input=estimate, Points=[5, 5, 100, 50])),
            "errors": self.table(simple.ErrorSummary(Input=errors)),
            "refused": refused.PointData.GetNumberOfArrays(),
            "notes": self.notes(cube)}
        for name, source in (("cube", cube), ("estimate", estimate), ("errors", errors)):
            source.UpdatePipeline()
            arrays = source.PointData
            results[f"{name} ranges"] = [(array.Name, [array.GetRange(i) for i in range(array.GetNumberOfComponents())])
                                         for array in (arrays.GetArray(i) for i in range(arrays.GetNumberOfArrays()))]
        return results

    def notes(self, reader):
        reader.UpdatePropertyInformation()
        return str(reader.GetProperty("Notes").GetData())

    def table(self, source):
        source.UpdatePipeline()
        data = self.manager.Fetch(source, idx=getattr(source, "Port", 0))
        columns = [data.GetColumn(i) for i in range(data.GetNumberOfColumns())]
        return [[column.GetName() for column in columns]] + [
            [column.GetValue(row) for column in columns] for row in range(data.GetNumberOfRows())]


def client(folder, port):
    from paraview import servermanager, simple
    folders = [os.path.join(folder, name) for name in ("alone", "server")]
    for path in folders:
        os.makedirs(path)
    alone = Pipelines(simple, servermanager, folders[0]).run()
    simple.Connect("127.0.0.1", int(port))
    served = Pipelines(simple, servermanager, folders[1]).run()
    # Text first: NaN does not equal itself.
    faults = [f"{name} differs:\n{alone[name]}\n{served[name]}"
              for name in alone if repr(alone[name]) != repr(served[name])]
    if alone["refused"] != 0:
        faults.append("raw counts were estimated")
    files = sorted(os.listdir(folders[0]))
    faults += [f"{name} differs" for name in files
               if not filecmp.cmp(*(os.path.join(path, name) for path in folders), shallow=False)]
    if len(files) < 4 or min(len(alone[name]) for name in ("samples", "transform", "errors")) < 4:
        faults.append(f"too little to compare: {files}, {alone}")
    print("\n".join(faults) or f"{len(alone)} results and {len(files)} files, the same as without a server", flush=True)
    simple.Disconnect()
    os._exit(1 if faults else 0)


if __name__ == "__main__":
    if sys.argv[1] == "client":
        client(*sys.argv[2:])
    else:
        drive(*sys.argv[1:])
