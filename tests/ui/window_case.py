"""What the tests of the window share: one X server for all cases of a file, a home and a scene for each.

A test file ends with `main()`; it is started as `FILE PROGRAM [unittest arguments]` and skipped (exit code 77) where
there is no Xvfb.
"""
import json
import os
import shutil
import struct
import sys
import tempfile
import unittest

import window_driver
from window_driver import Screen, Window

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def read(path):
    """The bytes of a file."""
    with open(path, "rb") as file:
        return file.read()


def gltf_json(path):
    """The JSON of a .glb or .gltf file."""
    data = read(path)
    if data[:4] != b"glTF":
        return json.loads(data)
    (length,) = struct.unpack("<I", data[12:16])
    return json.loads(data[20:20 + length])


class WindowCase(unittest.TestCase):
    program = None
    screenSize = (1280, 720)
    size = (960, 540)  # of the window; small pictures are soon rendered

    @classmethod
    def setUpClass(cls):
        cls.screen = Screen(*cls.screenSize)
        cls.addClassCleanup(cls.screen.close)  # also where a subclass fails to set up

    def setUp(self):
        self.home = tempfile.mkdtemp(prefix="kilolux-home-")
        self.windows = []
        self.remember()

    def tearDown(self):
        for window in self.windows:
            window.close()
        shutil.rmtree(self.home, ignore_errors=True)

    def remember(self, **values):
        """Writes what a window finds as remembered from last time: small pictures, soon settled, and `values`."""
        values = {"meanFrames": 4, "mostPixels": 15000, **values}
        folder = os.path.join(self.home, "config", "kilolux")
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, "window.json"), "w") as file:
            json.dump(values, file)

    def copy_scene(self, name="cornell.glb"):
        path = os.path.join(self.home, name)
        shutil.copy(os.path.join(ROOT, "content", "scenes", name), path)
        return path

    def start(self, scene=None, size=None, arguments=(), environment=None):
        window = Window(self.program, self.screen, scene, self.home, size or self.size, arguments, environment)
        self.windows.append(window)
        return window

    def open_scene(self, name="cornell.glb", size=None):
        """A window with a copy of the scene, its picture shown; (window, path)."""
        path = self.copy_scene(name)
        window = self.start(path, size)
        window.wait_picture()
        window.settle()
        return window, path


def main():
    if not shutil.which("Xvfb"):
        print("no Xvfb")
        sys.exit(77)
    WindowCase.program = os.path.abspath(sys.argv.pop(1))
    unittest.main(verbosity=2)
