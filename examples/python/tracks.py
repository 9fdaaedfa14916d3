"""Tracks that are carried as arrays, with steps that physics limits: a toy of a simulation.

Usage: tracks.py [DETECTOR.gdml [TRACKS]]
"""

import sys

import numpy as np

import navjit

path = sys.argv[1] if len(sys.argv) > 1 else "detectors/shashlik.gdml"
count = int(float(sys.argv[2])) if len(sys.argv) > 2 else 2000
detector = navjit.read_gdml(path)
runtime = navjit.Runtime(detector)

random = np.random.default_rng(7)
directions = random.normal(size=(count, 3)) * [0.1, 0.1, 0] + [0, 0, 1]
directions /= np.linalg.norm(directions, axis=1, keepdims=True)
points = np.zeros((count, 3))
states = runtime.locate(points, directions)

# Radiation lengths by the number of the volume; 0 is one that is not known, as in a vacuum.
radiation_length = np.array([volume.material.radiation_length for volume in detector.volumes])
radiation_length[radiation_length == 0] = np.inf
interactions = np.zeros(len(detector.volumes), dtype=int)

for turn in range(1000):
    alive = navjit.inside(states)
    if not alive.any():
        break
    states, points, directions = states[alive], points[alive], directions[alive]
    # A track interacts after some radiation lengths; steps end there, or on a boundary.
    free_path = random.exponential(size=len(states)) * radiation_length[states["volume"]]
    length, boundary, after = runtime.step(states, points, directions, free_path)
    points += length[:, None] * directions
    np.add.at(interactions, states["volume"], ~boundary)
    # It scatters where it interacted: the state stays, the direction is new.
    scattered = directions + np.where(boundary, 0.0, 0.1)[:, None] * random.normal(size=points.shape)
    directions = scattered / np.linalg.norm(scattered, axis=1, keepdims=True)
    states = after

print(f"{turn} turns, {runtime.report()['steps']} steps")
for number in np.argsort(-interactions)[:5]:
    print(f"{interactions[number]:7} interactions in {detector.volumes[number].name}")
