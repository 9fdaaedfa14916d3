#!/usr/bin/env python3
"""Many `navjit run` processes at once on one cache that is empty at first: all have to say the same,
and leave nothing behind but entries that are good.

    tests/stress/many_runs.py build/release/bin/navjit detectors/absorber.gdml --runs 200 --at-once 8

Options that it does not know go to every run. Exit status 1 if not.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import tempfile


def one(navjit, detector, more, folder, number, rays, stop_early):
    report = folder / f"{number}.json"
    command = [navjit, "run", detector, "--rays", str(rays), "--cache", str(folder / "cache"),
               "--report", str(report)] + more
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if stop_early:  # at any moment, also while it writes
        try:
            process.wait(timeout=stop_early)
        except subprocess.TimeoutExpired:
            process.kill()
    error = process.communicate()[1]
    if process.returncode == -9:
        return None
    said = [line for line in error.splitlines() if " rays " not in line]  # but progress
    if process.returncode != 0 or said:
        raise SystemExit(f"run {number}: status {process.returncode}: {said}")
    found = json.loads(report.read_text())
    return {"answer": (found["rays"], found["steps"], found["length_mm"], found["stuck"]),
            "cached": found["cached_modules"], "modules": found["modules"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("navjit")
    parser.add_argument("detector")
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--at-once", type=int, default=8)
    parser.add_argument("--rays", type=int, default=40000)
    parser.add_argument("--kill", type=int, default=0, help="kill every so many-th run at some moment")
    options, options.more = parser.parse_known_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        os.chmod(folder, 0o700)
        with concurrent.futures.ThreadPoolExecutor(options.at_once) as pool:
            runs = [pool.submit(one, options.navjit, options.detector, options.more, folder, i, options.rays,
                                0.05 + 0.013 * (i % 37) if options.kill and i % options.kill == 0
                                else None)
                    for i in range(options.runs)]
            results = [run.result() for run in runs]
        done = [r for r in results if r]
        answers = {r["answer"] for r in done}
        verify = subprocess.run([options.navjit, "cache", "verify", "--cache", str(folder / "cache")],
                                capture_output=True, text=True)
        entries = sorted(p.name for p in (folder / "cache").iterdir())
        litter = [e for e in entries if not e.endswith(".navjit")]
        print(f"{len(done)} runs ended, {len(results) - len(done)} were killed; "
              f"{len(answers)} different answers; {sum(r['modules'] for r in done)} modules, "
              f"{sum(r['cached'] for r in done)} of them from the cache; {len(entries)} files in it, "
              f"{len(litter)} unfinished; verify: {verify.stdout.strip().splitlines()[-1]}")
        good = len(answers) == 1 and verify.returncode == 0 and (options.kill or not litter)
        return 0 if good else 1


if __name__ == "__main__":
    raise SystemExit(main())
