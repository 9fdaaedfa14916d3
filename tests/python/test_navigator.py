"""The navigator of single points."""

import numpy as np
import pytest

import navjit


def test_local_and_global(detector, runtime):
    navigator = runtime.navigator()
    point = np.array([1000.0, 500.0, 12600.0])
    state = navigator.locate(point)
    rotation, translation = detector.frame(state)
    local = navigator.to_local(state, point)
    np.testing.assert_allclose(local, rotation @ (point - translation), atol=1e-9)
    np.testing.assert_allclose(navigator.to_global(state, local), point, atol=1e-9)


def test_normals_point_out(detector, runtime):
    navigator = runtime.navigator()
    state = detector.state_at([])
    low, high = detector.world.extent
    np.testing.assert_array_equal(navigator.normal(state, [high[0], 0, 0]), [1, 0, 0])
    np.testing.assert_array_equal(navigator.normal(state, [0, low[1], 0]), [0, -1, 0])


def test_relocation_after_a_displacement(runtime):
    navigator = runtime.navigator()
    direction = (0, 0, 1)
    state = navigator.locate((0, 0, 0), direction)
    safety = navigator.safety(state, (0, 0, 0))
    assert navigator.safety(state, (0, 0, 0), enough=1.0) == pytest.approx(1.0, abs=1e-6)
    moved = (0, 0, safety / 2)
    assert navigator.relocate(state, moved, direction) == state
    far = (1000.0, 500.0, 12600.0)
    assert navigator.relocate(state, far, direction) == navigator.locate(far, direction)


def test_a_limit_ends_a_step(runtime):
    navigator = runtime.navigator()
    state = navigator.locate((0, 0, 0), (0, 0, 1))
    step = navigator.step(state, (0, 0, 0), (0, 0, 1), limit=1.5)
    assert step.length == 1.5 and not step.boundary and step.next == state
    length, boundary, after = step
    assert length == 1.5 and not boundary and after == state


def test_bad_calls_leave_it_as_it_was(runtime):
    navigator = runtime.navigator()
    state = navigator.locate((0, 0, 0), (0, 0, 1))
    right = navigator.step(state, (0, 0, 0), (0, 0, 1))
    for call in (
        lambda: navigator.locate((0, np.nan, 0)),
        lambda: navigator.step(state, (0, 0, 0), (0, 0, 2)),
        lambda: navigator.step(state, (0, 0), (0, 0, 1)),
        lambda: navigator.step(navjit.State(), (0, 0, 0), (0, 0, 1)),
        lambda: navigator.step(navjit.State(1, 2**31), (0, 0, 0), (0, 0, 1)),
        lambda: navigator.step(5, (0, 0, 0), (0, 0, 1)),
        lambda: navigator.step(np.zeros(3), (0, 0, 0), (0, 0, 1)),
        lambda: navigator.safety(state, (0, 0, 0), -1),
    ):
        with pytest.raises(navjit.UsageError):
            call()
    assert navigator.step(state, (0, 0, 0), (0, 0, 1)) == right
