"""The material budget of a detector against pseudorapidity, from its centre.

Usage: material_budget.py [DETECTOR.gdml [RAYS]]
"""

import sys

import numpy as np

import navjit

# %% A detector
path = sys.argv[1] if len(sys.argv) > 1 else "detectors/barrel.gdml"
rays = int(float(sys.argv[2])) if len(sys.argv) > 2 else 20000
detector = navjit.read_gdml(path)
print(f"{path}: {len(detector.volumes)} volumes of {len(detector.materials)} materials")

# %% Rays from its centre, evenly in pseudorapidity and azimuth
random = np.random.default_rng(1)
eta = random.uniform(-3, 3, rays)
phi = random.uniform(0, 2 * np.pi, rays)
directions = np.stack([np.cos(phi) / np.cosh(eta), np.sin(phi) / np.cosh(eta), np.tanh(eta)], axis=1)

# %% What they go through
runtime = navjit.Runtime(detector)
scan = runtime.scan([0, 0, 0], directions, by_material=True)
assert not scan.stuck.any()

# %% The mean in bins of pseudorapidity
edges = np.linspace(-3, 3, 13)
bins = np.digitize(eta, edges) - 1
for i in range(12):
    here = bins == i
    print(f"{edges[i]:5.1f} to {edges[i + 1]:4.1f}: {scan.radiation_lengths[here].mean():8.3f} X0")

# %% Which materials it is
mean = scan.by_material.mean(axis=0)
for material in sorted(detector.materials, key=lambda m: -mean[m.number]):
    length = material.radiation_length
    budget = mean[material.number] / length if length > 0 else float("nan")
    print(f"{material.name:20} {mean[material.number]:10.3f} mm {budget:8.3f} X0")

# %% Where the time went
for scene in runtime.report()["scenes"][:3]:
    print(f"{100 * scene['share']:5.1f}% of the steps in {scene['volume']}, by {scene['binding']}")
