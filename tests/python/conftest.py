"""What the tests of the Python package share. They run in the project's root."""

import numpy as np
import pytest

import navjit


@pytest.fixture(scope="session")
def detector():
    return navjit.read_gdml("detectors/shashlik.gdml")


@pytest.fixture(scope="session")
def runtime(detector):
    return navjit.Runtime(detector)


def random_rays(count, seed=1, spread=1.0):
    """Points near the origin, and directions that go everywhere."""
    random = np.random.default_rng(seed)
    directions = random.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return random.uniform(-spread, spread, size=(count, 3)), directions
