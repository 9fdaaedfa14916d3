"""Particle transport through detectors, with navigators written while it runs.

Reads a detector (GDML, ROOT), answers where points are, how far it is to the next boundary and what comes
next, for arrays of numpy, and makes navigators for the detector's hot volumes meanwhile. Lengths are
mm, directions of unit length, densities g/cm3. The guide is docs/python.md.

>>> import navjit
>>> detector = navjit.read_gdml("detectors/shashlik.gdml")
>>> runtime = navjit.Runtime(detector)
>>> states = runtime.locate([[0, 0, 0], [0, 0, 1e9]])
>>> [bool(navjit.inside(states)[0]), bool(navjit.inside(states)[1])]
[True, False]
"""

from ._core import (
    Detector,
    Error,
    GeometryError,
    Material,
    Navigator,
    ParseError,
    Placement,
    Runtime,
    State,
    UsageError,
    Volume,
    __version__,
    read_gdml,
    read_root,
    state_dtype,
)
from .results import Scan, Step, Steps, Trace, inside

__all__ = [
    "Detector",
    "Error",
    "GeometryError",
    "Material",
    "Navigator",
    "ParseError",
    "Placement",
    "Runtime",
    "Scan",
    "State",
    "Step",
    "Steps",
    "Trace",
    "UsageError",
    "Volume",
    "__version__",
    "inside",
    "read_gdml",
    "read_root",
    "state_dtype",
]
