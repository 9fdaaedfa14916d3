"""Arrays are navigated as single points are, to the last bit."""

from random import Random

import numpy as np
import pytest
from conftest import random_rays

import navjit


def test_steps_are_those_of_the_navigator(detector, runtime):
    points, directions = random_rays(300, spread=3000)
    limits = np.random.default_rng(2).uniform(0, 2000, 300)
    states = runtime.locate(points, directions)
    assert states.dtype == navjit.state_dtype
    navigator = runtime.navigator()
    boundaries = 0
    for turn in range(12):
        made = runtime.step(states, points, directions, limits)
        safety = runtime.safety(states, points)
        for i in range(300):
            if not navjit.inside(states)[i]:
                assert made.length[i] == 0 and not made.boundary[i] and safety[i] == 0
                assert not navjit.inside(made.next)[i]
                continue
            if turn == 0:
                assert navigator.locate(points[i], directions[i]).touchable == states[i]["touchable"]
            one = navigator.step(states[i], points[i], directions[i], limits[i])
            assert one.length == made.length[i]  # the same bits
            assert one.boundary == made.boundary[i]
            assert one.next.inside == navjit.inside(made.next)[i]
            if one.next:
                assert one.next.touchable == made.next["touchable"][i]
                assert one.next.volume == made.next["volume"][i]
            boundaries += one.boundary
            assert navigator.safety(states[i], points[i]) == safety[i]
        points = points + made.length[:, None] * directions
        states = made.next
    assert boundaries > 100


def test_one_stands_for_all(runtime):
    _, directions = random_rays(50)
    states = runtime.locate([0, 0, 0], directions)
    assert states.shape == (50,)
    assert (states == runtime.locate(np.zeros((50, 3)), directions)).all()
    one = runtime.step(states, [0, 0, 0], directions, 100)
    each = runtime.step(states, np.zeros((50, 3)), directions, np.full(50, 100.0))
    for a, b in zip(one, each):
        np.testing.assert_array_equal(a, b)
    assert runtime.locate([0, 0, 0]).shape == (1,)


def test_any_layout_gives_the_same(runtime):
    points, directions = random_rays(64, spread=4000)
    states = runtime.locate(points, directions)
    expected = runtime.step(states, points, directions)
    doubled = np.zeros((128, 6))
    doubled[::2, ::2] = points
    two_columns = np.stack([states["touchable"], states["volume"].astype(np.uint64)], axis=1)
    packed = states.astype(np.dtype([("touchable", "<u8"), ("volume", "<u4")]))
    assert packed.dtype.itemsize == 12
    for p, d, s in [
        (np.asfortranarray(points), directions, states),
        (doubled[::2, ::2], directions, states),
        (points[::-1].copy()[::-1], directions, states),
        (points.tolist(), directions.tolist(), states),
        (points.astype(">f8"), directions.astype(np.longdouble), states),
        (points, directions, two_columns),
        (points, directions, packed),
        (points, directions, np.repeat(states, 2)[::2]),
    ]:
        for a, b in zip(runtime.step(s, p, d), expected):
            np.testing.assert_array_equal(a, b)


def test_nothing_is_written_to_what_was_given(runtime):
    points, directions = random_rays(20)
    states = runtime.locate(points, directions)
    before = points.copy(), directions.copy(), states.copy()
    for array in (points, directions, states):
        array.setflags(write=False)
    runtime.step(states, points, directions)
    for a, b in zip(before, (points, directions, states)):
        np.testing.assert_array_equal(a, b)


def test_out_is_written_to(runtime):
    points, directions = random_rays(100)
    states = runtime.locate(points, directions)
    expected = runtime.step(states, points, directions)
    out = navjit.Steps(np.empty(100), np.empty(100, dtype=bool), states.copy())
    assert runtime.step(out.next, points, directions, out=out) is out
    for a, b in zip(out, expected):
        np.testing.assert_array_equal(a, b)
    read_only = np.empty(100)
    read_only.setflags(write=False)
    for bad in (
        navjit.Steps(np.empty(99), out.boundary, out.next),
        navjit.Steps(np.empty(100, dtype=np.float32), out.boundary, out.next),
        navjit.Steps(np.empty(200)[::2], out.boundary, out.next),
        navjit.Steps(read_only, out.boundary, out.next),
        navjit.Steps(out.length, np.empty(100), out.next),
        navjit.Steps(out.length, out.boundary, np.empty(100)),
        navjit.Steps(out.length, out.boundary, np.repeat(out.next, 2)[::2]),
        (out.length,),
        5,
    ):
        with pytest.raises((navjit.UsageError, TypeError, IndexError)):
            runtime.step(states, points, directions, out=bad)


def test_out_that_is_still_to_be_read_is_refused(runtime):
    memory = np.zeros(20)
    points, length = memory[:15].reshape(5, 3), memory[10:15]
    directions = np.tile([0.0, 0.0, 1.0], (5, 1))
    states = runtime.locate(points, directions)
    boundary, following = np.empty(5, dtype=bool), np.repeat(states, 2)
    with pytest.raises(navjit.UsageError, match="out.length: it shares memory with points"):
        runtime.step(states, points, directions, out=navjit.Steps(length, boundary, states.copy()))
    with pytest.raises(navjit.UsageError, match="out.next: it shares memory with states"):
        out = navjit.Steps(np.empty(5), boundary, following[1:6])
        runtime.step(following[:5], points, directions, out=out)



@pytest.mark.parametrize("threads", [2, 5])
def test_threads_change_nothing(detector, runtime, threads):
    several = navjit.Runtime(detector, threads=threads)
    assert several.threads == threads
    points, directions = random_rays(20000, spread=5000)
    states = runtime.locate(points, directions)
    assert (several.locate(points, directions) == states).all()
    for a, b in zip(
        several.step(states, points, directions), runtime.step(states, points, directions)
    ):
        np.testing.assert_array_equal(a, b)
    np.testing.assert_array_equal(several.safety(states, points), runtime.safety(states, points))


def test_empty_arrays(runtime):
    none = np.empty((0, 3))
    states = runtime.locate(none, none)
    assert states.shape == (0,)
    assert runtime.step(states, none, none).length.shape == (0,)
    assert runtime.safety(states, none).shape == (0,)
    assert runtime.trace(none, none).offset.tolist() == [0]
    assert runtime.scan(none, none, by_material=True).by_material.shape[0] == 0


def test_bad_elements_are_named(runtime, detector):
    points, directions = random_rays(5000)
    states = runtime.locate(points, directions)

    def refused(what, *arguments, **more):
        with pytest.raises(navjit.UsageError, match=what):
            runtime.step(*arguments, **more)

    bad = points.copy()
    bad[4321, 1] = np.nan
    bad[4567, 1] = np.inf
    refused("element 4321: the point is not finite", states, bad, directions)
    bad = directions.copy()
    bad[17] *= 2
    refused("element 17: the direction is not a unit vector", states, points, bad)
    refused("element 0: the step limit", states, points, directions, -1)
    refused("element 0: the step limit", states, points, directions, np.nan)
    refused("do not go together", states[:-1], points, directions)
    refused("do not go together", states, points, directions, np.ones(3))
    refused("points: the shape is", states, points[:, :2], directions)
    refused("limit: the shape is", states, points, directions, np.ones((5000, 1)))
    refused("states", points, points, directions)
    refused("states", states["touchable"], points, directions)
    refused("directions: numbers", states, points, "north")
    other = states.copy()
    other["volume"][7] = len(detector.volumes)
    refused("element 7: the state is of another detector", other, points, directions)
    other = states.copy()
    other["touchable"][8] = detector.touchables
    refused("element 8", other, points, directions)
    # Volumes that exist, but not there.
    other = states.copy()
    other["volume"][9] = detector.volume("InnerLead").number
    refused("element 9", other, points, directions)
    with pytest.raises(navjit.UsageError):
        runtime.safety(states, points, -1)


def test_hostile_states_are_refused(runtime, detector):
    random = Random(3)
    points, directions = random_rays(1)
    refused = 0
    for _ in range(500):
        touchable = random.choice([0, 1, 5, 2**31, 2**40, 2**63, 2**64 - 2, 1000])
        volume = random.choice([0, 1, 17, 25, 26, 2**16, 2**31, 2**32 - 1])
        state = np.zeros(1, dtype=navjit.state_dtype)
        state["touchable"], state["volume"] = np.uint64(touchable), np.uint32(volume)
        for call in (
            lambda: runtime.step(state, points, directions, 1e-3),
            lambda: runtime.safety(state, points),
            lambda: detector.path(state[0]),
            lambda: detector.frame(navjit.State(touchable, volume)),
            lambda: runtime.navigator().step(state[0], points[0], directions[0], 1e-3),
        ):
            try:
                call()
            except navjit.UsageError:
                refused += 1
    assert refused > 1000
