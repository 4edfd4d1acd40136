#!/usr/bin/python3
"""Writes the scenes that the project ships: make.py [--out FOLDER] [scene...], all of them without names.
Needs Python 3 and numpy. The same bytes come out of every run."""
import argparse
import importlib
import os
import sys
import time

SCENES = ("cornell", "gallery", "night_market")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    sys.path.insert(0, here)
    sys.dont_write_bytecode = True
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default=os.path.join(here, "..", "scenes"))
    parser.add_argument("scene", nargs="*", choices=[[], *SCENES], help="all when none is named")
    arguments = parser.parse_args()
    os.makedirs(arguments.out, exist_ok=True)
    for name in arguments.scene or SCENES:
        start = time.monotonic()
        scene = importlib.import_module(name).build()
        size = scene.save(os.path.join(arguments.out, name + ".glb"))
        print(f"{name}: {size / 1e6:.2f} MB, {scene.triangle_count()} triangles, "
              f"{len(scene.lights())} lights, {len(scene.nodes)} nodes, {time.monotonic() - start:.1f} s")


if __name__ == "__main__":
    main()
