#!/usr/bin/env python3
"""The window itself: opening, the camera, exposure, undo, saving, recovery, sizes, leaving."""
import json
import os
import subprocess

from window_case import WindowCase, gltf_json, main, read
from window_driver import MIDDLE, RIGHT, WHEEL_UP, wait_for

CTRL, SHIFT, ALT = "Control_L", "Shift_L", "Alt_L"


def exposure(path):
    return gltf_json(path)["scenes"][0].get("extras", {}).get("kilolux", {}).get("exposureEv100")


class Opening(WindowCase):
    def test_first_run_tells_what_to_do_and_opens_a_typed_path(self):
        path = self.copy_scene()
        window = self.start()
        window.click("first.open")
        window.wait(lambda s: s["question"] == "open", "the folder list")
        window.settle()
        window.type(path)
        window.key("Return")
        state = window.wait_picture()
        self.assertEqual(state["document"]["path"], path)
        x, y, w, h = state["viewport"]
        self.assertGreater(sum(window.pixels((x + 0.25 * w, y + 0.25 * h, 0.5 * w, 0.5 * h))), 60)

    def test_a_bad_file_is_named_and_the_open_scene_stays(self):
        window, path = self.open_scene()
        bad = os.path.join(self.home, "bad.glb")
        with open(bad, "w") as file:
            file.write("no scene")
        window.key("o", hold=[CTRL])
        window.wait(lambda s: s["question"] == "open", "the folder list")
        window.click("dialog.entry.bad.glb", times=2)
        state = window.wait(lambda s: any("bad.glb" in n for n in s["notices"]), "the error")
        self.assertEqual(state["document"]["path"], path)
        window.click("notice.close")
        window.wait(lambda s: not s["notices"], "the error to close")


class CameraMoves(WindowCase):
    def test_fly_orbit_dolly_pan_and_frame(self):
        window, _ = self.open_scene()
        x, y, w, h = window.state()["viewport"]
        middle = (x + w / 2, y + h / 2)
        eye = window.state()["camera"]["eye"]

        window.click(middle, button=WHEEL_UP, times=3)
        state = window.wait(lambda s: s["camera"]["eye"] != eye, "the dolly")
        distance = state["camera"]["pivotM"]

        eye = state["camera"]["eye"]
        window.drag(middle, (middle[0] + 60, middle[1]), hold=[ALT])
        state = window.wait(lambda s: s["camera"]["eye"] != eye, "the orbit")
        self.assertAlmostEqual(state["camera"]["pivotM"], distance, places=9)

        eye = state["camera"]["eye"]
        window.drag(middle, (middle[0], middle[1] + 40), button=MIDDLE)
        state = window.wait(lambda s: s["camera"]["eye"] != eye, "the pan")

        eye = state["camera"]["eye"]
        window.drag(middle, (middle[0] + 5, middle[1]), button=RIGHT, release=False)
        tool = state["tool"]
        window.key("w")
        window.screen.button(RIGHT, False)
        state = window.wait(lambda s: s["camera"]["eye"] != eye, "the flight")
        self.assertEqual(state["tool"], tool, "letters choose no tool while flying")

        eye = state["camera"]["eye"]
        window.key("f")
        window.wait(lambda s: s["camera"]["eye"] != eye, "the framing")
        window.wait_picture()
        self.assertFalse(window.state()["document"]["unsaved"], "moving the camera is no edit")

    def test_at_rest_it_settles_and_uses_no_processor(self):
        window, _ = self.open_scene()
        window.wait(lambda s: s["picture"]["settled"], "the picture to settle")

        wait_for(window.rests, "rest", 20)


class Documents(WindowCase):
    def test_exposure_undo_redo_and_save(self):
        window, path = self.open_scene()
        original = read(path)
        before = window.state()["exposure"]
        place = window.wait_place("top.exposure")
        middle = (place[0] + place[2] / 2, place[1] + place[3] / 2)
        window.drag(middle, (middle[0] + 50, middle[1]))
        state = window.wait(lambda s: s["exposure"] != before, "the exposure")
        self.assertEqual(state["document"]["undo"], "Exposure")
        dragged = state["exposure"]
        window.key("s", hold=[CTRL])
        window.wait(lambda s: not s["document"]["unsaved"], "the save")
        self.assertAlmostEqual(exposure(path), dragged, places=5)

        window.key("z", hold=[CTRL])
        state = window.wait(lambda s: s["document"]["unsaved"], "the undo")
        self.assertAlmostEqual(state["exposure"], before, places=5, msg="one drag is one step")
        window.click("top.save")
        window.wait(lambda s: not s["document"]["unsaved"], "the save")
        self.assertEqual(read(path), original, "everything undone gives the first bytes")

        window.key("z", hold=[CTRL, SHIFT])
        state = window.wait(lambda s: s["document"]["unsaved"], "the redo")
        self.assertAlmostEqual(state["exposure"], dragged, places=5)

    def test_views_are_kept_named_looked_through_and_dropped(self):
        window, path = self.open_scene()
        state = window.state()
        first, (x, y, w, h) = state["camera"]["eye"], state["viewport"]
        window.click("top.views")
        window.click("view.name")
        window.settle()
        window.type("Door")
        window.click("view.keep")
        window.wait(lambda s: s["document"]["bookmarks"] == 1, "the bookmark")
        window.key("Escape")
        window.settle()
        window.key("s", hold=[CTRL])
        window.wait(lambda s: not s["document"]["unsaved"], "the save")
        kept = gltf_json(path)["scenes"][0]["extras"]["kilolux"]["bookmarks"]
        self.assertEqual([view["name"] for view in kept], ["Door"])

        window.click((x + w / 2, y + h / 2), button=WHEEL_UP, times=3)
        window.wait(lambda s: s["camera"]["eye"] != first, "the dolly")
        window.click("top.views")
        window.wait_place("view.keep")
        window.settle()
        place = next(n for n in window.state()["places"] if n.startswith("view.") and n.endswith(".drop"))
        window.click(place[:-len(".drop")])
        window.wait(lambda s: max(abs(a - b) for a, b in zip(s["camera"]["eye"], first)) < 1e-6, "the kept view")
        window.click("top.views")
        window.click(place)
        window.wait(lambda s: s["document"]["bookmarks"] == 0, "the bookmark to go")
        window.key("Escape")
        window.settle()
        window.key("z", hold=[CTRL])
        window.wait(lambda s: s["document"]["bookmarks"] == 1, "the undo")

    def test_killed_it_recovers_what_was_not_saved(self):
        window, path = self.open_scene()
        original = read(path)
        place = window.wait_place("top.exposure")
        middle = (place[0] + place[2] / 2, place[1] + place[3] / 2)
        window.drag(middle, (middle[0] + 50, middle[1]))
        dragged = window.wait(lambda s: s["document"]["unsaved"], "the edit")["exposure"]
        window.kill()
        self.assertEqual(read(path), original)

        window = self.start(path)
        window.wait(lambda s: s["question"] == "recover", "the question")
        window.click("recover.yes")
        state = window.wait_picture()
        self.assertTrue(state["document"]["unsaved"])
        self.assertAlmostEqual(state["exposure"], dragged, places=5)
        window.kill()

        window = self.start(path)
        window.wait(lambda s: s["question"] == "recover", "the question again")
        window.click("recover.no")
        state = window.wait_picture()
        self.assertFalse(state["document"]["unsaved"])

    def test_leaving_asks_about_unsaved_changes(self):
        window, path = self.open_scene()
        place = window.wait_place("top.exposure")
        middle = (place[0] + place[2] / 2, place[1] + place[3] / 2)
        window.drag(middle, (middle[0] + 50, middle[1]))
        edited = window.wait(lambda s: s["document"]["unsaved"], "the edit")["exposure"]
        window.screen.close_window("Kilolux")
        window.click("unsaved.cancel")
        window.wait(lambda s: s["question"] == "", "the answer")
        window.screen.close_window("Kilolux")
        window.click("unsaved.save", ends=True)
        self.assertEqual(window.process.wait(30), 0)
        self.assertAlmostEqual(exposure(path), edited, places=5)

        window = self.start(path)
        window.wait_picture()
        self.assertEqual(window.quit(), 0, "nothing to ask, nothing to recover")

    def test_saving_as_a_file_that_is_there_asks_and_a_question_given_up_stays_so(self):
        window, path = self.open_scene()
        other = os.path.join(self.home, "other.glb")
        with open(other, "w", encoding="utf-8") as file:
            file.write("precious")
        place = window.wait_place("top.exposure")
        middle = (place[0] + place[2] / 2, place[1] + place[3] / 2)
        window.drag(middle, (middle[0] + 50, middle[1]))
        window.wait(lambda s: s["document"]["unsaved"], "the change")

        def save_as():
            window.key("s", hold=[CTRL, SHIFT])
            window.wait(lambda s: s["question"] == "saveAs", "the folder list")
            window.click("dialog.entry.other.glb")
            window.click("dialog.ok")
            window.wait(lambda s: s["question"] == "replace", "the question")
        save_as()
        window.click("replace.cancel")
        window.wait(lambda s: s["question"] == "", "the end of the question")
        self.assertEqual(read(other), b"precious")
        # Leaving is given up in the middle: the next saving must not leave.
        window.key("q", hold=[CTRL])
        window.wait(lambda s: s["question"] == "unsaved", "the question")
        window.click("unsaved.cancel")
        save_as()
        window.click("replace.yes")
        state = window.wait(lambda s: not s["document"]["unsaved"], "the save")
        self.assertEqual(state["document"]["path"], other)
        self.assertNotEqual(read(other), b"precious")

    def test_changed_on_disk(self):
        window, path = self.open_scene()
        place = window.wait_place("top.exposure")
        middle = (place[0] + place[2] / 2, place[1] + place[3] / 2)
        window.drag(middle, (middle[0] + 50, middle[1]))
        window.wait(lambda s: s["document"]["unsaved"], "the edit")
        edits = os.path.join(self.home, "edits.json")
        with open(edits, "w") as file:
            json.dump([{"set": {"exposureEv100": 3}}], file)
        subprocess.run([self.program, "edit", path, "--do", edits], check=True)
        other = read(path)
        window.wait(lambda s: s["changedOnDisk"], "the notice")
        window.key("s", hold=[CTRL])
        window.wait(lambda s: s["question"] == "changedOnDisk", "the question")
        window.click("disk.cancel")
        self.assertEqual(read(path), other)
        window.key("s", hold=[CTRL])
        window.click("disk.saveAs")
        window.wait(lambda s: s["question"] == "saveAs", "the name")
        window.key("a", hold=[CTRL])
        window.type("other.glb")
        window.key("Return")
        state = window.wait(lambda s: not s["document"]["unsaved"], "the save")
        self.assertTrue(state["document"]["path"].endswith("other.glb"))
        self.assertEqual(read(path), other)


class Sizes(WindowCase):
    screenSize = (3840, 2160)

    def test_from_320x240_to_4k(self):
        self.remember(meanFrames=2)
        window, _ = self.open_scene(size=(320, 240))
        for width, height in ((320, 240), (1280, 720), (3840, 2160), (500, 900), (960, 540)):
            window.resize(width, height)
            state = window.wait(
                lambda s: s["viewport"][0] + s["viewport"][2] <= width and s["places"] and
                s["viewport"][1] + s["viewport"][3] <= height and s["viewport"][3] > 0.4 * height and
                abs(s["picture"]["width"] * s["viewport"][3] - s["picture"]["height"] * s["viewport"][2]) <
                0.02 * s["picture"]["width"] * s["viewport"][3], f"{width}x{height}")
            self.assertGreater(state["viewport"][2], 150)

    def test_text_grows_with_the_screen(self):
        window = self.start(size=(3840, 2160))
        self.assertEqual(window.state()["uiScale"], 2.0)


class Keys(WindowCase):
    def test_tab_hides_the_panels_and_is_remembered(self):
        window, path = self.open_scene()
        narrow = window.state()["viewport"][2]
        window.key("Tab")
        state = window.wait(lambda s: not s["panels"], "hidden panels")
        self.assertGreater(state["viewport"][2], narrow)
        self.assertEqual(window.quit(), 0)
        window = self.start(path)
        window.wait(lambda s: not s["panels"], "panels as they were left")
        window.key("Tab")
        window.wait(lambda s: s["panels"], "panels shown")

    def test_columns_are_dragged_and_remembered(self):
        window, path = self.open_scene()
        x, _, w, _ = window.state()["viewport"]
        place = window.wait_place("edge.left")
        at = (place[0] + place[2] / 2, place[1] + place[3] / 2)
        window.drag(at, (at[0] - 40, at[1]))
        window.wait(lambda s: abs(s["viewport"][0] - (x - 40)) < 3, "the wider viewport")
        self.assertEqual(window.quit(), 0)
        window = self.start(path)
        window.wait(lambda s: s["document"] and abs(s["viewport"][0] - (x - 40)) < 3, "the width as it was left")


if __name__ == "__main__":
    main()
