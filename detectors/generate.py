#!/usr/bin/env python3
"""Writes the sample detectors beside this file. The output is always the same, to the byte."""

import pathlib

import absorber
import argon
import barrel
import scenes
import shashlik


def main():
    here = pathlib.Path(__file__).resolve().parent
    for module in (shashlik, barrel, absorber, scenes, argon):
        path = here / f"{module.__name__}.gdml"
        path.write_text(module.build(), encoding="utf-8")
        print(f"{path.name}: {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
