"""Whole rays: traces and scans."""

import csv
import os
import subprocess

import numpy as np
import pytest
from conftest import random_rays

import navjit


def test_a_trace_is_its_steps(runtime):
    points, directions = random_rays(200, spread=5000)
    points[7] = [0, 0, 1e6]  # starts outside
    trace = runtime.trace(points, directions)
    assert trace.offset[0] == 0 and trace.offset[-1] == len(trace.length) == len(trace.state)
    assert trace.offset[8] == trace.offset[7]
    assert not trace.stuck.any()
    at = points.copy()
    states = runtime.locate(points, directions)
    for turn in range(10):
        made = runtime.step(states, at, directions)
        for i in range(200):
            step = trace.offset[i] + turn
            if step >= trace.offset[i + 1]:
                assert not navjit.inside(states)[i]
                continue
            assert trace.state[step] == states[i]
            assert trace.length[step] == made.length[i]
            assert trace.ray[step] == i
        at = at + made.length[:, None] * directions
        states = made.next


def test_a_scan_is_the_sum_of_the_trace(detector, runtime):
    points, directions = random_rays(500)
    trace = runtime.trace(points, directions)
    scan = runtime.scan(points, directions, by_material=True)
    rays = len(points)
    np.testing.assert_array_equal(scan.steps, np.diff(trace.offset))
    np.testing.assert_allclose(
        scan.length, np.bincount(trace.ray, weights=trace.length, minlength=rays), rtol=1e-12
    )
    material = np.array([v.material.number for v in detector.volumes])[trace.state["volume"]]
    table = np.zeros((rays, len(detector.materials)))
    np.add.at(table, (trace.ray, material), trace.length)
    np.testing.assert_allclose(scan.by_material, table, rtol=1e-12, atol=1e-9)
    x0 = np.array([m.radiation_length for m in detector.materials])
    known = x0 > 0
    np.testing.assert_allclose(
        scan.radiation_lengths, (table[:, known] / x0[known]).sum(axis=1), rtol=1e-12
    )
    np.testing.assert_allclose(scan.unknown, table[:, ~known].sum(axis=1), atol=1e-9)
    assert runtime.scan(points, directions).by_material.shape == (rays, 0)


@pytest.mark.parametrize("options", [{"jit": "off"}, {"jit": "wait"}, {"threads": 3}])
def test_nothing_changes_a_bit(detector, runtime, options):
    points, directions = random_rays(700)
    expected = runtime.trace(points, directions)
    for a, b in zip(navjit.Runtime(detector, **options).trace(points, directions), expected):
        np.testing.assert_array_equal(a, b)


def test_the_same_as_the_command(detector, runtime, tmp_path):
    command = os.environ.get("NAVJIT_COMMAND")
    if not command:
        pytest.skip("the command was not built")
    points, directions = random_rays(100, spread=2000)
    rays = tmp_path / "rays.csv"
    np.savetxt(
        rays,
        np.hstack([points, directions]),
        delimiter=",",
        fmt="%.17g",
        header="x,y,z,dx,dy,dz",
        comments="",
    )
    made = subprocess.run(
        [command, "trace", "detectors/shashlik.gdml", "--rays", rays, "--cache", "off"],
        check=True,
        capture_output=True,
        text=True,
    )
    rows = list(csv.DictReader(made.stdout.splitlines()))
    trace = runtime.trace(points, directions)
    names = [v.name for v in detector.volumes]
    assert [int(r["ray"]) for r in rows] == trace.ray.tolist()
    assert [r["volume"] for r in rows] == [names[v] for v in trace.state["volume"]]
    # The command makes directions anew, of unit length.
    np.testing.assert_allclose([float(r["length"]) for r in rows], trace.length, atol=1e-8)


def test_what_is_observed(detector, runtime):
    points, directions = random_rays(500)
    observed = navjit.Runtime(detector, observe="materials")
    few, all_of_it = observed.scan(points, directions), runtime.scan(points, directions)
    assert few.steps.sum() < all_of_it.steps.sum()
    np.testing.assert_allclose(few.radiation_lengths, all_of_it.radiation_lengths, rtol=1e-9)
    report = observed.report()["observe"]
    assert report["kind"] == "materials"
    assert report["placements_after"] <= report["placements_before"]
    # Steps of arrays and of the navigator see the same boundaries.
    states = observed.locate(points, directions)
    made = observed.step(states, points, directions)
    one = observed.navigator().step(states[3], points[3], directions[3])
    assert one.length == made.length[3]


def test_states_of_what_is_observed():
    detector = navjit.read_gdml("detectors/absorber.gdml")
    low, high = detector.world.extent
    points = low + (high - low) * np.random.default_rng(5).random((2000, 3))
    directions = np.broadcast_to([0.0, 0.0, 1.0], (2000, 3))
    runtime = navjit.Runtime(detector, jit="off")
    observed = navjit.Runtime(detector, jit="off", observe="materials")
    states, right = observed.locate(points, directions), runtime.locate(points, directions)
    assert observed.detector.touchables < detector.touchables
    paths, deepest = detector.paths(observed.original(states)), detector.paths(right)
    assert all(whole.startswith(path) for path, whole in zip(paths, deepest))
    assert list(observed.detector.paths(states)) != list(deepest)
    np.testing.assert_array_equal(observed.original(states, points, directions), right)
    assert runtime.detector.touchables == detector.touchables
    with pytest.raises(navjit.UsageError, match="neither"):
        observed.original(states, points)


def test_bad_rays_are_named(runtime):
    points, directions = random_rays(1000)
    directions[900] = 0
    for ask in (runtime.trace, runtime.scan):
        with pytest.raises(navjit.UsageError, match="element 900"):
            ask(points, directions)
