#!/usr/bin/env python3
"""Work on files that takes long, and other programs of the desktop: saving on a slow disk, opening that is cancelled,
a file dropped onto the window, minimising and restoring. files_test.py PROGRAM [unittest arguments]
"""
import json
import os
import shutil
import struct
import subprocess
import unittest
import zlib

import light_scenes
from window_case import ROOT, WindowCase, gltf_json, main, read
from window_driver import LEFT, wait_for
from x_messages import XMessages

CTRL = "Control_L"


def png(side, shade):
    """A plain grey picture."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    row = b"\0" + bytes([shade]) * side
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(row * side)) + chunk(b"IEND", b""))


def many_textures(path, count):
    """A scene whose import takes seconds: `count` large pictures."""
    light_scenes.every_type(path)
    with open(path) as file:
        document = json.load(file)
    folder = os.path.dirname(path)
    picture = png(4096, 128)
    for name in ("images", "textures", "materials"):
        document[name] = []
    for i in range(count):
        with open(os.path.join(folder, f"picture{i}.png"), "wb") as file:
            file.write(picture)
        document["images"].append({"uri": f"picture{i}.png"})
        document["textures"].append({"source": i})
        document["materials"].append({"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}})
        primitive = document["meshes"][0]["primitives"][0]
        document["meshes"][0]["primitives"].append(dict(primitive, material=i))
    with open(path, "w") as file:
        json.dump(document, file)
    return path


class Saving(WindowCase):
    def open_on_slow_disk(self):
        """A window whose disk is slow while the file `self.gate` is there, with an unsaved change."""
        library = os.path.join(self.home, "slow_disk.so")
        compiler = shutil.which("cc")
        if not compiler:
            self.skipTest("no C compiler")
        subprocess.run([compiler, "-shared", "-fPIC", "-o", library, os.path.join(ROOT, "tests", "ui", "slow_disk.c"),
                        "-ldl"], check=True)
        self.gate = os.path.join(self.home, "gate")
        self.path = light_scenes.every_type(os.path.join(self.home, "scene.gltf"))
        self.original = read(self.path)
        window = self.start(self.path, environment={"LD_PRELOAD": library, "SLOW_DISK": self.gate})
        window.wait_picture()
        window.click("light.2")
        window.key("h")
        window.wait(lambda s: s["document"]["unsaved"], "the change")
        return window

    def close_gate(self):
        with open(self.gate, "w"):
            pass

    def muted(self, name):
        node = next(n for n in gltf_json(self.path)["nodes"] if n.get("name") == name)
        return node.get("extras", {}).get("kilolux", {}).get("muted", False)

    def test_work_goes_on_while_the_scene_is_saved(self):
        window = self.open_on_slow_disk()
        self.close_gate()
        window.key("s", hold=[CTRL])
        window.wait(lambda s: s["saving"] and "activity.cancelSave" in s["places"], "the progress of saving")
        # The window answers, and what is changed meanwhile stays a change.
        window.click("light.7")
        window.key("h")
        window.wait(lambda s: s["document"]["undo"] == "Mute 1 light" and s["document"]["selection"] == [7], "an edit")
        self.assertTrue(window.state()["saving"])
        self.assertEqual(read(self.path), self.original)
        os.remove(self.gate)
        state = window.wait(lambda s: not s["saving"], "the save")
        self.assertTrue(state["document"]["unsaved"])
        self.assertTrue(self.muted("Bulb"))
        self.assertFalse(self.muted("Ring"))
        window.kill()
        window = self.start(self.path)
        window.click("recover.yes")
        state = window.wait_picture()
        self.assertTrue(state["document"]["unsaved"])
        window.key("s", hold=[CTRL])
        window.wait(lambda s: not s["document"]["unsaved"] and not s["saving"], "the save")
        self.assertTrue(self.muted("Ring"))

    def test_a_save_is_cancelled(self):
        window = self.open_on_slow_disk()
        self.close_gate()
        window.key("s", hold=[CTRL])
        window.click("activity.cancelSave")
        os.remove(self.gate)
        window.wait(lambda s: not s["saving"] and any("cancelled" in n for n in s["notices"]), "the end of the save")
        self.assertEqual(read(self.path), self.original)
        self.assertTrue(window.state()["document"]["unsaved"])
        window.key("s", hold=[CTRL])
        window.wait(lambda s: not s["document"]["unsaved"], "the next save")
        self.assertTrue(self.muted("Bulb"))

    def test_leaving_waits_for_the_save_without_holding_the_window(self):
        window = self.open_on_slow_disk()
        self.close_gate()
        window.screen.close_window("Kilolux")
        window.click("unsaved.save")
        window.wait(lambda s: s["saving"] and s["question"] == "", "saving")
        frames = window.state()["frames"]
        window.wait(lambda s: s["frames"] > frames + 3, "the window to be drawn")
        os.remove(self.gate)
        self.assertEqual(window.process.wait(60), 0)
        self.assertTrue(self.muted("Bulb"))

    def test_a_folder_that_takes_no_file_is_told_and_nothing_is_lost(self):
        window = self.open_on_slow_disk()
        os.chmod(self.path, 0o444)
        if os.access(self.path, os.W_OK):  # who may do everything needs another obstacle
            os.remove(self.path)
            os.mkdir(self.path)
        window.key("s", hold=[CTRL])
        window.wait(lambda s: any("scene.gltf" in n and "Saved" not in n for n in s["notices"]) or
                    s["question"] == "changedOnDisk", "the reason")
        self.assertTrue(window.state()["document"]["unsaved"])


class Opening(WindowCase):
    def test_opening_is_cancelled_and_the_open_scene_stays(self):
        window, path = self.open_scene()
        slow = many_textures(os.path.join(self.home, "slow.gltf"), 150)
        window.key("o", hold=[CTRL])
        window.wait(lambda s: s["question"] == "open", "the folder list")
        window.click("dialog.entry.slow.gltf", times=2)
        window.click("activity.cancel")
        state = window.wait(lambda s: not s["opening"], "the end of opening")
        self.assertEqual(state["document"]["path"], path)
        self.assertFalse(any("slow" in n for n in state["notices"]), "who cancels needs not be told")
        # The import ends as well: the second one after it, of a scene that is soon read, finds nobody at work.
        window.wait(lambda s: s["picture"]["settled"], "rest")
        threads = os.path.join("/proc", str(window.process.pid), "task")

        def importing():
            for task in os.listdir(threads):
                try:
                    with open(os.path.join(threads, task, "stat")) as file:
                        if file.read().rsplit(")", 1)[1].split()[0] == "R":
                            return True
                except FileNotFoundError:
                    continue
            return False
        wait_for(lambda: not any(importing() for _ in range(20)), "the import to end")
        self.assertTrue(os.path.exists(slow))

    def test_the_preparation_of_a_picture_is_cancelled(self):
        path = self.copy_scene("night_market.glb")
        # With warm caches the preparation may end before the click comes: then it is begun anew.
        def prepared(s):
            return s["document"] and s["picture"] and s["picture"]["number"] > 0
        for _ in range(20):
            window = self.start(path)
            state = window.wait(lambda s: "activity.close" in s["places"] or prepared(s), "the preparation")
            frames = state["frames"] + 2  # a window's first frame has its sizes still to find
            state = window.wait(lambda s: s["frames"] >= frames or prepared(s), "the sizes")
            if "activity.close" in state["places"]:
                x, y, width, height = state["places"]["activity.close"]
                window.click((x + width / 2, y + height / 2))
                state = window.wait(lambda s: s["document"] is None or prepared(s), "the scene to be closed")
                if state["document"] is None:
                    break
            window.kill()
        self.assertIsNone(state["document"])
        window.wait(lambda s: s["activity"] == "", "the preparation to end")
        window.click("first.open")
        window.wait(lambda s: s["question"] == "open", "the folder list")


class Desktop(WindowCase):
    def setUp(self):
        super().setUp()
        self.messages = XMessages(self.screen)

    def tearDown(self):
        self.messages.close()
        super().tearDown()

    def test_a_file_is_dropped_onto_the_window(self):
        path = self.copy_scene()
        other = light_scenes.every_type(os.path.join(self.home, "with space.gltf"))
        window = self.start()
        target = self.screen.titled("Kilolux")
        window.wait_place("first.open")
        self.messages.drop(target, path, 300, 200)
        window.wait(lambda s: s["document"] and s["document"]["path"] == path, "the dropped scene")
        window.wait_picture()
        # Onto an edited scene: it asks first.
        window.click("light." + str(self.first_light(window)))
        window.key("h")
        window.wait(lambda s: s["document"]["unsaved"], "the edit")
        self.messages.drop(target, other, 300, 200)
        window.wait(lambda s: s["question"] == "unsaved", "the question")
        window.click("unsaved.discard")
        window.wait(lambda s: s["document"] and s["document"]["path"] == other, "the other scene")
        # What is no scene is told.
        text = os.path.join(self.home, "note.txt")
        with open(text, "w") as file:
            file.write("hello")
        self.messages.drop(target, text, 300, 200)
        window.wait(lambda s: any("note.txt" in n for n in s["notices"]), "the message")
        self.assertEqual(window.state()["document"]["path"], other)

    def first_light(self, window):
        window.settle()
        return min(int(n.split(".")[1]) for n in window.state()["places"] if n.startswith("light.") and
                   n.split(".")[1].isdigit())

    def test_minimised_it_rests_and_a_button_let_go_meanwhile_is_up(self):
        path = light_scenes.every_type(os.path.join(self.home, "scene.gltf"))
        self.remember(meanFrames=100_000)
        window = self.start(path)
        window.wait_picture()
        target = self.screen.titled("Kilolux")
        x, y, w, h = window.state()["viewport"]
        start = (x + 0.2 * w, y + 0.85 * h)
        window.drag(start, (start[0] + 60, start[1] - 40), release=False)
        self.messages.minimise(target)
        number = window.state()["picture"]["number"]
        self.screen.button(LEFT, False)

        wait_for(window.rests, "the window to rest", 60)
        self.messages.restore(target)
        window.wait(lambda s: s["picture"]["number"] > number, "a picture after it came back")
        # Moving the pointer draws no rectangle on: the button is up.
        selection = window.state()["document"]["selection"]
        window.move((x + 0.9 * w, y + 0.1 * h))
        window.settle()
        window.click("light.3")
        window.wait(lambda s: s["document"]["selection"] == [3], "a click to be one")
        self.assertNotEqual(selection, [3])


if __name__ == "__main__":
    main()
