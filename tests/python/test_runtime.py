"""The runtime: options, reports, threads, the end."""

import json
import logging
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest
from conftest import random_rays

import navjit


def run(program):
    """A Python of its own; what it printed."""
    made = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, timeout=120
    )
    assert made.returncode == 0, made.stderr
    return made.stdout


def test_scenes_are_specialised_and_reported(detector):
    runtime = navjit.Runtime(detector, jit="wait")
    assert runtime.specialised > 0
    points, directions = random_rays(3000)
    steps = runtime.scan(points, directions).steps.sum()
    report = runtime.report(final=True, most_seconds=0.2)
    assert report["steps"] == steps
    assert sum(scene["steps"] for scene in report["scenes"]) == steps
    assert any(scene["binding"] != "generic" for scene in report["scenes"])
    assert json.loads(json.dumps(report)) == report
    off = navjit.Runtime(detector, jit="off")
    off.scan(points, directions)
    assert all(scene["binding"] == "generic" for scene in off.report()["scenes"])


def test_shadow_mode_finds_no_difference(detector):
    runtime = navjit.Runtime(detector, jit="shadow")
    navigator = runtime.navigator()
    state, point = navigator.locate([0, 0, 0], [0.6, 0, 0.8]), np.zeros(3)
    while state:
        step = navigator.step(state, point, [0.6, 0, 0.8])
        point = point + step.length * np.array([0.6, 0, 0.8])
        state = step.next
    assert navigator.counts["differences"] == 0


def test_profiles_and_caches_are_written(detector, tmp_path):
    points, directions = random_rays(3000)
    runtime = navjit.Runtime(detector, cache=tmp_path / "cache", jit="wait")
    runtime.scan(points, directions)
    runtime.save_profile(tmp_path / "profile.json")
    profile = json.loads((tmp_path / "profile.json").read_text())
    assert profile
    if runtime.report()["modules"] > 0:
        again = navjit.Runtime(detector, cache=tmp_path / "cache", jit="wait")
        assert again.report()["cached_modules"] > 0
    with pytest.raises(navjit.Error, match="profile"):
        runtime.save_profile(tmp_path / "no" / "profile.json")


@pytest.mark.parametrize(
    "options, what",
    [
        ({"jit": "maybe"}, "jit"),
        ({"observe": "nothing"}, "nothing"),
        ({"threads": 0}, "threads"),
        ({"nice": 20}, "nice"),
        ({"budget": -1.0}, "budget"),
        ({"budget": float("nan")}, "budget"),
    ],
)
def test_bad_options_are_refused(detector, options, what):
    with pytest.raises(navjit.UsageError, match=what):
        navjit.Runtime(detector, **options)


def test_a_volume_that_is_not_there(detector):
    with pytest.raises(navjit.GeometryError, match="NoSuchVolume"):
        navjit.Runtime(detector, observe="materials,NoSuchVolume")
    with pytest.raises(TypeError):
        navjit.Runtime("detectors/shashlik.gdml")
    with pytest.raises(TypeError, match="cache: a folder"):
        navjit.Runtime(detector, cache=3)


def test_reports_say_what_is_mixed_and_by_how_much(detector):
    report = navjit.Runtime(detector, jit="off", observe="mixtures:10%").report()["observe"]
    assert report["mixtures"] and report["measured"]["rays"] > 0
    assert 0 < report["measured"]["mean_change"] <= 0.1 * report["measured"]["mean_of_ray"]
    mixture = report["mixtures"][0]
    assert mixture["placements"] >= len(mixture["of"]) > 0 and mixture["density_g_per_cm3"] > 0
    report = navjit.Runtime(detector, jit="off", observe="budget:0.1g/cm2").report()["observe"]
    assert report["bound_g_per_cm2"] <= 0.1 and "mixtures" not in report


def test_errors_are_of_both_kinds(tmp_path):
    bad = tmp_path / "bad.gdml"
    bad.write_text("<gdml>\n<solids>\n<box/>\n")
    with pytest.raises(navjit.ParseError, match="bad.gdml:"):
        navjit.read_gdml(bad)
    for kind in (navjit.ParseError, navjit.UsageError, navjit.GeometryError):
        assert issubclass(kind, navjit.Error) and issubclass(kind, ValueError)
        assert kind.__module__ == "navjit"


def test_what_is_logged_is_pythons(detector, tmp_path, caplog):
    plugin = tmp_path / "no.so"
    with caplog.at_level(logging.DEBUG, logger="navjit"):
        navjit.Runtime(detector, plugin=str(plugin))
    assert any("no.so" in record.getMessage() for record in caplog.records)


def test_other_threads_go_on(detector):
    """The interpreter's lock is released: a counter goes on while arrays are navigated."""
    runtime = navjit.Runtime(detector, jit="off")
    points, directions = random_rays(200000)
    counted, done = [], threading.Event()

    def count():
        while not done.is_set():
            counted.append(time.perf_counter())
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    begun = time.perf_counter()
    runtime.scan(points, directions)
    ended = time.perf_counter()
    done.set()
    counter.join()
    assert sum(begun < t < ended for t in counted) >= 3


def test_many_threads_share_a_runtime(detector):
    runtime = navjit.Runtime(detector)
    points, directions = random_rays(2000)
    expected = runtime.trace(points, directions)
    results = [None] * 6

    def work(i):
        for _ in range(5):
            results[i] = runtime.trace(points, directions)
            runtime.report()

    threads = [threading.Thread(target=work, args=(i,)) for i in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for made in results:
        for a, b in zip(made, expected):
            np.testing.assert_array_equal(a, b)


def test_a_keyboard_interrupt_ends_a_call(detector):
    runtime = navjit.Runtime(detector, threads=2)
    points, directions = random_rays(1000)
    many = np.tile(directions, (20000, 1))  # minutes of it
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        runtime.scan([0, 0, 0], many)
    timer.join()
    assert runtime.scan(points, directions).steps.sum() > 0


def test_the_end_of_the_interpreter():
    """Whatever is still there: a Runtime that compiles, one that is in a cycle, a navigator."""
    program = """
        import navjit, numpy as np
        detector = navjit.read_gdml("detectors/barrel.gdml")
        runtime = navjit.Runtime(detector)
        directions = np.random.default_rng(1).normal(size=(20000, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        runtime.scan([0, 0, 0], directions)
        navigator = navjit.Runtime(detector).navigator()
        cycle = [runtime]
        cycle.append(cycle)
        print("the end")
    """
    for _ in range(3):
        assert run(program) == "the end\n"


def test_a_navigator_may_outlive_its_runtime(detector):
    navigator = navjit.Runtime(detector).navigator()
    state = navigator.locate((0, 0, 0))
    assert navigator.step(state, (0, 0, 0), (0, 0, 1)).length > 0


def test_states_are_values():
    import pickle

    state = navjit.State(5, 2)
    assert state == navjit.State(5, 2) and hash(state) == hash(navjit.State(5, 2))
    assert state != navjit.State(6, 2) and state != 5
    assert pickle.loads(pickle.dumps(state)) == state
    assert not navjit.State() and not pickle.loads(pickle.dumps(navjit.State()))
    assert (state.touchable, state.volume, state.inside) == (5, 2, True)
