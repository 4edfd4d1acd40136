#!/usr/bin/python3
"""Writes the scenes and profiles that the project ships: make.py [--out FOLDER] [--ies FOLDER] [scene...], all
of them without names. A name that ends in a number is its module's layout of that seed or so many lights: hidden_lights_7,
crowd_10000. Needs Python 3 and numpy. The same bytes come out of every run."""
import argparse
import importlib
import os
import re
import sys
import time

NUMBERED = ("hidden_lights", "crowd")
SCENES = ("cornell", "gallery", "night_market", "half_hidden", "sun_room", "motion", "sampler", "courtyard",
          "moving_lights", "passing", "switched_on", "thin", "glossy", "crowd_1000",
          *(f"hidden_lights_{seed}" for seed in range(1, 6)))


def numbered(name):
    return re.fullmatch(f"({'|'.join(NUMBERED)})_(\\d+)", name)


def scene_name(text):
    if text not in SCENES and not numbered(text):
        raise argparse.ArgumentTypeError(f"'{text}' is none of {', '.join(SCENES)} and no {'_N or '.join(NUMBERED)}_N")
    return text


def build(name):
    found = numbered(name)
    if found:
        return importlib.import_module(found[1]).build(int(found[2]))
    return importlib.import_module(name).build()


def write_profiles(folder):
    os.makedirs(folder, exist_ok=True)
    for name, profile in importlib.import_module("profiles").profiles().items():
        with open(os.path.join(folder, name), "w", encoding="ascii", newline="") as file:
            file.write(profile.text())


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    sys.path.insert(0, here)
    sys.dont_write_bytecode = True
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default=os.path.join(here, "..", "scenes"))
    parser.add_argument("--ies", help="folder of the photometric profiles; content/ies when no scene is named")
    parser.add_argument("scene", nargs="*", type=scene_name, help="all when none is named")
    arguments = parser.parse_args()
    os.makedirs(arguments.out, exist_ok=True)
    if arguments.ies or not arguments.scene:
        write_profiles(arguments.ies or os.path.join(here, "..", "ies"))
    for name in arguments.scene or SCENES:
        start = time.monotonic()
        scene = build(name)
        size = scene.save(os.path.join(arguments.out, name + ".glb"))
        print(f"{name}: {size / 1e6:.2f} MB, {scene.triangle_count()} triangles, "
              f"{len(scene.lights())} lights, {len(scene.nodes)} nodes, {time.monotonic() - start:.1f} s")


if __name__ == "__main__":
    main()
