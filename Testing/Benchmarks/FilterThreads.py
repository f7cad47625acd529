#!/usr/bin/env python3
"""The filters over images with one thread and with two, in real time, as Google Benchmark writes its JSON.

usage: FilterThreads.py [FILTER...]      with MULTISPECTRAL_PYTHON, the folder of the build's package multispectral

Processes take turns, so that other work on the machine slows all alike; the fastest of their runs count. Each filter has
2048 x 2048 pixels, 31 wavelengths and 16 channels. A core is slower while the other one works too, on machines where they
share clock, caches or the core itself: the peer "each core one thread" does the work twice at the same time in two processes
of one thread, which is what two threads can reach at the most (2 times as fast).
"""
import json
import os
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "Plugin", "Scripts"))
SIDE = 2048
ROUNDS = 3
FILTERS = ("Synthetic Scene", "Camera Simulator, ideal", "Camera Simulator, effects and noise", "Channel Displacement",
           "Channel Registration", "Reflectance Estimation, transfer", "Reflectance Estimation, affine",
           "Spectral To Color", "CIEDE2000 Evaluator")
EFFECTS = [
    {"effect": "channel_crosstalk", "parameters": {"coupling": 0.02}},
    {"effect": "veiling_glare", "parameters": {"fraction": 0.02}},
    {"effect": "local_stray_light", "parameters": {"fraction": 0.05, "radius": 8.0}}]


def pipelines():
    """Filters by name, each ready to run again."""
    from support import pipeline
    pipeline.load_plugin()
    create, port = pipeline.create, pipeline.port

    def ready(proxy):
        pipeline.update(proxy)
        return proxy

    chart, fabric = (ready(create("SampleTableReader", FileName=os.path.join(ROOT, "Data", "Samples", f"demo-{name}.csv")))
                     for name in ("chart", "fabric"))
    tuning = ready(create("SampleSplit", Input=fabric))
    camera = ready(create("CameraModelFit", Input=chart, Draws=0))
    scene = create("SyntheticScene", Subject="Fabric", Size=[SIDE, SIDE])
    yield "Synthetic Scene", scene
    ideal = create("CameraSimulator", Input=scene, Camera=port(camera, 0), Effects="None (ideal camera)", Noise="None")
    yield "Camera Simulator, ideal", ideal
    effects = os.path.join(os.environ["BENCHMARK_FOLDER"], "effects.json")
    yield "Camera Simulator, effects and noise", create(
        "CameraSimulator", Input=scene, Camera=port(camera, 0), Effects="Effect File", EffectFile=effects)
    displacement = create("ChannelDisplacement", Input=ideal)
    yield "Channel Displacement", displacement
    yield "Channel Registration", create("ChannelRegistration", Input=ideal, Displacements=displacement, Preview=0)
    transfer = ready(create("MetamerismCorrection", Calibration=chart, Tuning=port(tuning, 0), Method="Transfer"))
    estimate = create("ReflectanceEstimation", Input=ideal, ReflectanceTransform=port(transfer, 0),
                      MetamerismTransform=port(transfer, 1), Preview=0, TrustResponses=1)
    yield "Reflectance Estimation, transfer", estimate
    affine = ready(create("ReflectanceCalibration", Input=chart, Method="Ridge"))
    yield "Reflectance Estimation, affine", create(
        "ReflectanceEstimation", Input=ideal, ReflectanceTransform=port(affine, 0), Preview=0, TrustResponses=1)
    yield "Spectral To Color", create("SpectralToColor", Input=estimate)
    yield "CIEDE2000 Evaluator", create("CIEDE2000Evaluator", Input=estimate, Reference=scene)


def work():
    """A line of input: run the filter that was named once more; a line of output: the seconds."""
    from support import pipeline
    known = pipelines()
    proxies = {}
    for line in sys.stdin:
        name = line.strip()
        while name not in proxies:
            try:
                found, proxy = next(known)
            except StopIteration:
                sys.exit(f"there is no filter '{name}'; the filters are {', '.join(proxies)}")
            proxies[found] = proxy
            pipeline.update(proxy)
        algorithm = proxies[name].SMProxy.GetClientSideObject()
        algorithm.Modified()
        start = time.perf_counter()
        algorithm.Update()
        seconds = time.perf_counter() - start
        pipeline.fail_on_error()
        print(seconds, flush=True)


def worker(threads, folder):
    return subprocess.Popen(
        [sys.executable, os.path.abspath(__file__), "--work"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
        env={**os.environ, "VTK_SMP_BACKEND_IN_USE": "STDThread", "VTK_SMP_MAX_THREADS": str(threads),
             "BENCHMARK_FOLDER": folder, "MALLOC_MMAP_THRESHOLD_": "33554432", "MALLOC_TRIM_THRESHOLD_": "134217728",
             "GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"})


def start(process, name):
    process.stdin.write(name + "\n")
    process.stdin.flush()


def seconds(process, name):
    line = process.stdout.readline()
    if not line:
        sys.exit(f"{name} was not measured")
    return float(line)


def measured(workers, name):
    """The seconds with two threads, with one, and with one while the other core does the same."""
    one, other, two = workers
    start(two, name)
    found = [seconds(two, name)]
    start(one, name)
    found.append(seconds(one, name))
    start(one, name)
    start(other, name)
    found.append((seconds(one, name) + seconds(other, name)) / 2)
    return found


def main():
    names = sys.argv[1:] or FILTERS
    found = []
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "effects.json"), "w") as file:
            json.dump(EFFECTS, file)
        workers = [worker(threads, folder) for threads in (1, 1, 2)]
        for name in names:
            for process in workers:  # what comes before the filter in its pipeline
                start(process, name)
                seconds(process, name)
            rounds = [measured(workers, name) for _ in range(ROUNDS)]
            for best, peer in zip(map(min, zip(*rounds)), (None, "one thread", "each core one thread")):
                found.append({"name": f"two threads/{name}", "cpu_time": 1e3 * best, "time_unit": "ms", "peer": peer})
        for process in workers:
            process.stdin.close()
            process.wait()
    json.dump({"context": {}, "benchmarks": found}, sys.stdout, indent=1)


if __name__ == "__main__":
    work() if sys.argv[1:] == ["--work"] else main()
