"""What questions about arrays are answered with."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ._core import State

_outside = np.uint64(2**64 - 1)


def inside(states: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
    """Whether each state of an array is in the world."""
    return np.not_equal(states["touchable"], _outside)


class Step(NamedTuple):
    """The answer to one step, of Navigator.step()."""

    length: float
    """mm"""
    boundary: bool
    """Whether a boundary ended it, and not the limit alone."""
    next: State
    """Where the track is then: fully located."""


class Steps(NamedTuple):
    """The answers to a step of each track, of Runtime.step()."""

    length: npt.NDArray[np.float64]
    """mm, of shape (N,)"""
    boundary: npt.NDArray[np.bool_]
    """Whether a boundary ended it, and not the limit alone."""
    next: npt.NDArray[Any]
    """Where the tracks are then: states, fully located."""


class Trace(NamedTuple):
    """Every step of N rays, one ray after the other, of Runtime.trace()."""

    offset: npt.NDArray[np.int64]
    """Of shape (N + 1,): the steps of ray i are those from offset[i] on, below offset[i + 1]."""
    state: npt.NDArray[Any]
    """The state that each step was made in."""
    length: npt.NDArray[np.float64]
    """The length of each step, mm."""
    stuck: npt.NDArray[np.bool_]
    """Of shape (N,): whether a ray did not get out, which an invalid geometry can do."""

    @property
    def ray(self) -> npt.NDArray[np.int64]:
        """The number of the ray that each step is of."""
        return np.repeat(np.arange(len(self.offset) - 1), np.diff(self.offset))


class Scan(NamedTuple):
    """What N rays go through, of Runtime.scan(). All but the last are of shape (N,)."""

    length: npt.NDArray[np.float64]
    """The way in the world, mm."""
    radiation_lengths: npt.NDArray[np.float64]
    """The sum over all steps of the length by the material's radiation length."""
    unknown: npt.NDArray[np.float64]
    """The way in materials whose radiation length is not known, mm; not in radiation_lengths."""
    steps: npt.NDArray[np.int64]
    """How many there were."""
    stuck: npt.NDArray[np.bool_]
    """Whether a ray did not get out, which an invalid geometry can do."""
    by_material: npt.NDArray[np.float64]
    """Of shape (N, materials): the way in each material, mm; (N, 0) unless it was asked for."""
