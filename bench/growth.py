#!/usr/bin/env python3
"""How the time of a step grows with the daughters of a volume and with the depth of the tree.

Writes detectors of its own, runs bench_transport on each, prints Markdown:
bench/growth.py build/release/bin/bench_transport [--rays N] [--repetitions N]
"""

import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "detectors"))
from gdml_writer import Gdml, common_materials, place  # noqa: E402

EDGE = 1000.0  # of the volume whose daughters are counted, mm


def daughters(count):
    """A box with `count` smaller ones: a lattice with as many sites, each box somewhere in its own,
    turned or not, of three sizes."""
    gdml = Gdml(f"{count} daughters")
    common_materials(gdml)
    per_side = 1
    while per_side ** 3 < count:
        per_side += 1
    pitch = EDGE / per_side
    rng = random.Random(count)
    for size in range(3):
        edge = pitch * (0.25 + 0.1 * size)
        gdml.solid("box", f"Box{size}_s", x=edge, y=edge * 0.8, z=edge * 0.6)
        gdml.volume(f"Box{size}", "Lead", f"Box{size}_s")
    sites = [(i, j, k) for i in range(per_side) for j in range(per_side) for k in range(per_side)]
    placed = []
    for n, site in enumerate(rng.sample(sites, count)):
        # The box's diagonal is at most 0.64 of the pitch.
        at = [(i + 0.5) * pitch - EDGE / 2 + rng.uniform(-0.17, 0.17) * pitch for i in site]
        turn = [rng.uniform(0, 360) for _ in range(3)] if n % 2 else None
        placed.append(place(f"box{n}", f"Box{n % 3}", at, turn))
    gdml.solid("box", "Mother_s", x=EDGE, y=EDGE, z=EDGE)
    gdml.volume("Mother", "Air", "Mother_s", placed)
    gdml.solid("box", "World_s", x=EDGE + 200, y=EDGE + 200, z=EDGE + 200)
    gdml.volume("World", "Air", "World_s", [place("mother", "Mother")])
    return gdml.text("World")


def nest(depth):
    """Boxes in one another, `depth` of them, each a little off the centre of the one around it."""
    gdml = Gdml(f"{depth} levels")
    common_materials(gdml)
    inside = []
    for level in range(depth, 0, -1):
        edge = EDGE * (1 - 0.9 * (level - 1) / depth)
        gdml.solid("box", f"Box{level}_s", x=edge, y=edge, z=edge)
        gdml.volume(f"Box{level}", "Air", f"Box{level}_s", inside)
        off = EDGE * 0.9 / depth * 0.2
        inside = [place(f"box{level}", f"Box{level}", (off, -off, off / 2) if level > 1 else None)]
    gdml.solid("box", "World_s", x=EDGE + 200, y=EDGE + 200, z=EDGE + 200)
    gdml.volume("World", "Air", "World_s", inside)
    return gdml.text("World")


def measure(options, text):
    with tempfile.TemporaryDirectory() as folder:
        detector, figures = pathlib.Path(folder, "detector.gdml"), pathlib.Path(folder, "out.json")
        detector.write_text(text, encoding="utf-8")
        subprocess.run([options.bench_transport, detector, "--count", str(options.rays),
                        "--repetitions", str(options.repetitions), "--json", figures],
                       check=True, stdout=subprocess.DEVNULL)
        engines = {e["name"]: e for e in json.loads(figures.read_text())["engines"]}
    peers = {n: e for n, e in engines.items() if n.startswith("VecGeom")}
    best = min(peers, key=lambda n: sum(sorted(peers[n]["ns_per_ray"])), default=None)
    return engines["navjit generic"], engines["navjit specialised"], best and engines[best], best


def table(options, what, values, make):
    print(f"| {what} | navjit generic, ns/step | specialised, ns/step | generic / specialised "
          "| VecGeom's best, ns/step |\n|--:|--:|--:|--:|--:|")
    for value in values:
        generic, specialised, peer, name = measure(options, make(value))
        peer_text = f"{peer['ns_per_step']:.0f} ({name.split()[1]})" if peer else "-"
        print(f"| {value} | {generic['ns_per_step']:.0f} | {specialised['ns_per_step']:.0f} | "
              f"{specialised['speed_up_over_generic']:.2f} | {peer_text} |", flush=True)
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bench_transport")
    parser.add_argument("--rays", type=int, default=20000)
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--daughters", default="1,2,4,8,16,32,64,128,256,512,1000,3000,10000")
    parser.add_argument("--depths", default="1,2,4,8,16,32,60")
    options = parser.parse_args()
    table(options, "daughters", [int(n) for n in options.daughters.split(",")], daughters)
    table(options, "levels below the world", [int(n) for n in options.depths.split(",")], nest)


if __name__ == "__main__":
    main()
