"""Arrays of points from Python beside the same loops in C++ (bench/arrays.cpp), in turn.

Usage: arrays.py build/release/bin/bench_arrays DET.gdml... [--count 1000000] [--repetitions 5]
Prints a Markdown table: ns for each point in C++ (for each ray of the scan), and the median of how
many times as long Python takes. All in processor time of one thread, each run in a process of its own.
"""

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import navjit

PARTS = ("locate", "step", "safety", "scan")


def made_in_python(path, rays):
    """The times of arrays.cpp, s."""
    runtime = navjit.Runtime(navjit.read_gdml(path), jit="wait")
    both = np.fromfile(rays).reshape(-1, 6)
    points, directions = both[:, :3].copy(), both[:, 3:].copy()
    for _ in range(2):
        times = []

        def timed(call):
            begun = time.thread_time()
            result = call()
            times.append(time.thread_time() - begun)
            return result

        states = timed(lambda: runtime.locate(points, directions))
        timed(lambda: runtime.step(states, points, directions))
        timed(lambda: runtime.safety(states, points))
        some = slice(0, len(points) // 10)
        timed(lambda: runtime.scan(points[some], directions[some]))
    print(*times)


def write_rays(path, detector, count):
    """From points all over the middle of the world, in all directions."""
    random = np.random.default_rng(1)
    low, high = detector.world.extent / 2
    directions = random.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    np.hstack([random.uniform(low, high, size=(count, 3)), directions]).tofile(path)


def main():
    if sys.argv[1] == "--made":
        return made_in_python(*sys.argv[2:])
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("detectors", nargs="+")
    parser.add_argument("--count", type=lambda text: int(float(text)), default=1000000)
    parser.add_argument("--repetitions", type=int, default=5)
    options = parser.parse_args()
    print("| detector |", " | ".join(f"{part}, ns | Python" for part in PARTS), "|")
    print("|---" * (1 + 2 * len(PARTS)) + "|")
    for path in options.detectors:
        with tempfile.NamedTemporaryFile(suffix=".bin") as rays:
            write_rays(rays.name, navjit.read_gdml(path), options.count)
            cpp, python = [], []
            for _ in range(options.repetitions):
                for command, times in (
                    ([options.program, path, rays.name], cpp),
                    ([sys.executable, __file__, "--made", path, rays.name], python),
                ):
                    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
                    times.append([float(t) for t in out.split()])
        ratios = [statistics.median(p[i] / c[i] for p, c in zip(python, cpp)) for i in range(4)]
        counts = [options.count] * 3 + [options.count // 10]
        ns = [1e9 * statistics.median(c[i] for c in cpp) / counts[i] for i in range(4)]
        row = " | ".join(f"{n:.0f} | {r:.2f}" for n, r in zip(ns, ratios))
        print(f"| {os.path.basename(path)} | {row} |")


main()
