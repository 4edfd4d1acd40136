#!/usr/bin/env python3
"""Everything that a hand does to lights, in the real window: lights_test.py PROGRAM [unittest arguments]

Gizmos, typed values and garbage, several lights at once, undo to the start and redo to the end, the list, the
clipboard, 10,000 lights. What was done is read back from the saved file.
"""
import math
import os

import light_scenes
import window_case
from light_case import CTRL, SHIFT, LightCase
from window_case import read
from window_driver import RIGHT


class Lights(LightCase):
    # --- gizmos

    def test_each_axis_of_the_move_gizmo_reaches_the_file(self):
        window = self.open()
        self.pick(2)
        self.tool("w", 1)
        before = [0, 1.5, 0]
        for axis, name in enumerate("xyz"):
            handles = self.handles()
            start, center = handles[name], handles["center"]
            # On along the arrow; the one that points at the viewer only a little.
            goal = [start[i] + 0.6 * (start[i] - center[i]) for i in range(2)]
            self.drag_handle(start, goal, "Move 1 light")
            after = self.node("Bulb")["translation"]
            for other in range(3):
                if other == axis:
                    self.assertGreater(after[other], before[other] + 0.05, name)
                else:
                    self.assertAlmostEqual(after[other], before[other], 9, name)
            before = after
        # Each drag is one step.
        for _ in range(3):
            self.step("z", what="undo")
        self.wait_document(undo="")
        self.save()
        self.assertEqual(read(self.path), self.original)

    def test_rotating_scaling_snapping_and_giving_up(self):
        window = self.open()
        self.pick(6)
        self.tool("r", 3)
        handles = self.handles()
        start, center = handles["x"], handles["center"]
        self.drag_handle(start, [2 * start[i] - center[i] for i in range(2)], "Scale 1 light", hold=[CTRL])
        width = self.light("Window")[1]["widthM"]
        self.assertAlmostEqual(width / 0.6 * 10, round(width / 0.6 * 10), 6)  # steps of a tenth
        self.assertGreater(width, 0.9)
        self.tool("e", 2)
        start = self.handles()["y"]
        self.drag_handle(start, [start[0] + 40, start[1]], "Rotate 1 light", hold=[CTRL])
        _, y, _, w = self.node("Window")["rotation"]
        degrees = math.degrees(2 * math.atan2(y, w))
        self.assertAlmostEqual(degrees / 5, round(degrees / 5), 5)
        self.assertGreater(abs(degrees), 4)
        # Esc restores, and leaves no step.
        self.tool("w", 1)
        undo = window.state()["document"]["undo"]
        before = self.node("Window")
        start = self.handles()["x"]
        window.drag(start, [start[0] + 60, start[1]], release=False)
        window.wait(lambda s: s["document"]["undo"] == "Move 1 light" and "X +" in s["gizmo"]["label"], "the drag")
        window.key("Escape")
        window.wait(lambda s: not s["gizmo"]["dragging"], "the drag to end")
        window.screen.button(1, False)
        self.wait_document(undo=undo)
        self.assertEqual(self.node("Window"), before)

    def test_several_lights_move_together(self):
        window = self.open()
        self.pick(3, 4)
        self.tool("w", 1)
        start = self.handles()["y"]
        self.drag_handle(start, [start[0], start[1] - 50], "Move 2 lights")
        left, right = self.node("Spot left")["translation"], self.node("Spot right")["translation"]
        self.assertAlmostEqual(left[1], right[1], 9)
        self.assertGreater(left[1], 1.9)
        self.assertEqual((left[0], right[0]), (-1.5, 1.5))

    # --- picking

    def test_picking_in_the_picture(self):
        window = self.open()
        self.pick(2)
        center = self.handles()["center"]
        window.key("Escape")
        self.wait_document(selection=[])
        self.tool("q", 0)
        window.click(center)
        self.wait_document(selection=[2])
        x, y, w, h = window.state()["viewport"]
        window.drag([x + 20, y + 20], [x + w - 20, y + h - 20])
        self.wait_document(selection=[1, 2, 3, 4, 5, 6, 7])
        window.click(center, hold=[SHIFT])
        self.wait_document(selection=[1, 3, 4, 5, 6, 7])
        window.click([x + 30, y + h - 60])
        self.wait_document(selection=[])
        # A selection survives undo.
        self.pick(5)
        self.step("h", hold=[])
        self.step("z")
        self.wait_document(selection=[5], undo="")

    # --- values

    def test_typed_values_reach_the_file(self):
        window = self.open()
        self.pick(2)
        self.enter("intensity", "800 lm")
        self.enter("position.y", "150 cm + 1/2 m")
        self.enter("rangeM", "6 m")
        self.enter("temperatureK", "2.7k")
        self.enter("radiusM", "4 cm")
        light, extras = self.light("Bulb")
        self.assertEqual((extras["intensity"], extras["unit"]), (800, "lm"))
        self.assertEqual(self.node("Bulb")["translation"], [0, 2, 0])
        self.assertEqual(light["range"], 6)
        self.assertEqual(extras["temperatureK"], 2700)
        self.assertEqual(extras["radiusM"], 0.04)
        self.pick(3)
        self.enter("outerConeRad", "30 deg")
        light, extras = self.light("Spot left")
        self.assertAlmostEqual(light["spot"]["outerConeAngle"], 0.5235987755982988, 12)
        # The other light that shared it has kept its own.
        self.assertEqual(self.light("Spot right")[0]["spot"]["outerConeAngle"], 0.6)

    def test_garbage_is_refused_in_every_field(self):
        window = self.open()
        fields = ["intensity", "position.x", "rotation.y", "color"]
        own = {2: ["radiusM", "rangeM", "temperatureK", "rayEndBiasM"], 3: ["innerConeRad", "outerConeRad"],
               5: ["lengthM", "group.intensity", "group.exposureEv"],
               6: ["widthM", "heightM", "barnDoorAngleRad", "barnDoorLengthM"], 1: ["angularDiameterRad"]}
        for light, names in own.items():
            self.pick(light)
            window.settle()
            for field in (fields if light == 2 else []) + names:
                if field not in window.state()["places"]:
                    self.fail(f"light {light} has no field {field}")
                window.settle()
                folded = self.reveal(field)
                before = window.state()["notices"]
                self.enter(field, f"{field}!")
                state = window.wait(lambda s: any(f"{field}!" in text for text in s["notices"]), f"word of {field}")
                self.assertEqual(len(set(state["notices"]) - set(before)), 1, field)
                self.assertEqual(state["document"]["version"], 1, field)
                self.unfold(folded)
        self.assertFalse(window.state()["document"]["unsaved"])

    def test_mixed_values_typing_sets_dragging_offsets(self):
        window = self.open()
        self.pick(2, 5)
        self.enter("intensity", "*2")
        self.assertEqual(self.light("Bulb")[0]["intensity"], 80)
        place = window.wait_place("radiusM")
        middle = [place[0] + place[2] / 2, place[1] + place[3] / 2]
        self.drag_handle(middle, [middle[0] + 20, middle[1]], "Source radius of 2 lights")
        window.wait(lambda s: s["properties"]["dragging"] == "", "the drag to end")
        bulb, tube = self.light("Bulb")[1]["radiusM"], self.light("Tube")[1]["radiusM"]
        self.assertAlmostEqual(bulb, 0.1, 9)  # 20 pixels of half a centimetre
        self.assertAlmostEqual(tube, 0.13, 9)
        self.enter("radiusM", "5 cm")
        self.assertEqual(self.light("Bulb")[1]["radiusM"], 0.05)
        self.assertEqual(self.light("Tube")[1]["radiusM"], 0.05)

    # --- lights as a whole

    def test_everything_undone_and_redone_gives_the_same_bytes(self):
        window = self.open()
        viewport = window.state()["viewport"]
        window.move([viewport[0] + viewport[2] / 2, viewport[1] + viewport[3] * 0.8])
        window.settle()
        window.key("a", hold=[SHIFT])
        window.click("add.rect")
        window.wait(lambda s: s["document"]["lights"] == 8, "the new light")
        window.key("d", hold=[CTRL])
        window.wait(lambda s: s["document"]["lights"] == 9, "the duplicate")
        self.enter("intensity", "900")
        self.pick(3)
        self.step("h", hold=[], what="muting")
        self.pick(3, 4)
        self.step("g", what="grouping")
        self.reveal("group.exposureEv")
        self.enter("group.exposureEv", "-1")
        window.key("c", hold=[CTRL])
        self.step("v", what="pasting")
        self.wait_document(lights=11)
        self.pick(1)
        self.step("Delete", hold=[], what="deleting")
        self.wait_document(lights=10)
        self.pick(2)
        self.enter("name", "Lamp over the table")
        self.wait_document(undo="Rename 1 light")
        self.save()
        edited = read(self.path)
        while window.state()["document"]["undo"]:
            self.step("z", what="undo")
        self.save()
        self.assertEqual(read(self.path), self.original)
        while window.state()["document"]["redo"]:
            self.step("z", hold=[CTRL, SHIFT], what="redo")
        self.save()
        self.assertEqual(read(self.path), edited)

    def test_list_search_mute_solo_lock_rename(self):
        window = self.open()
        window.click("lights.search")
        window.type("spot")
        window.wait(lambda s: s["lightList"]["shown"] == 2, "the search")
        window.key("a", hold=[CTRL])
        window.key("BackSpace")
        window.wait(lambda s: s["lightList"]["shown"] == 7, "the whole list")
        window.key("Escape")
        window.click("mute.2")
        self.wait_document(undo="Mute 1 light")
        self.assertTrue(self.light("Bulb")[1]["muted"])
        window.click("solo.3")
        window.wait(lambda s: s["lightList"]["solo"] == [3], "solo")
        window.click("lock.2")
        window.wait(lambda s: s["lightList"]["locked"] == [2], "the lock")
        self.pick(7)
        window.key("F2")
        window.wait(lambda s: s["lightList"]["renaming"] == 7, "the name to take text")
        window.type("Halo")
        window.key("Return")
        self.wait_document(undo="Rename 1 light")
        self.assertTrue(self.node("Halo"))
        # What is no light on the clipboard is one message.
        window.key("F2")
        window.wait(lambda s: s["lightList"]["renaming"] == 7, "the name to take text")
        window.type("rubbish")
        window.key("a", hold=[CTRL])
        window.key("c", hold=[CTRL])
        window.key("Escape")
        window.key("v", hold=[CTRL])
        window.wait(lambda s: any("clipboard" in text for text in s["notices"]), "the message")
        self.assertEqual(window.state()["document"]["lights"], 7)

    def test_ten_thousand_lights(self):
        window = self.open(light_scenes.crowd, 10_000)
        self.assertEqual(window.state()["lightList"]["rows"], 10_000)
        window.click("lights.search")
        window.type("999")
        window.wait(lambda s: s["lightList"]["shown"] == 19, "the search")
        window.key("a", hold=[CTRL])
        window.key("BackSpace")
        window.key("Escape")
        x, y, w, h = window.state()["viewport"]
        window.drag([x + 20, y + 20], [x + w - 20, y + h - 20])
        window.wait(lambda s: len(s["document"]["selection"]) > 5000, "thousands to be selected")
        self.enter("intensity", "*2")
        window.wait(lambda s: s["document"]["undo"].startswith("Intensity of"), "the edit", 120)
        self.step("z", what="undo")
        self.save()
        self.assertEqual(read(self.path), self.original)


class Screenshots(LightCase):
    """Every state of these panels, to be looked at: lights_test.py PROGRAM Screenshots, with FOLDER and SIZE set."""

    def test_pictures(self):
        folder = os.environ.get("FOLDER")
        if not folder:
            self.skipTest("FOLDER is not set")
        window = self.open()

        def shot(name):
            window.settle()
            window.screenshot(os.path.join(folder, f"lights-{name}-{self.size[1]}.png"))
        for name, key, number, light in (("move", "w", 1, 2), ("rotate", "e", 2, 3), ("scale", "r", 3, 6)):
            self.pick(light)
            self.tool(key, number)
            shot(name)
        self.pick(5)
        shot("group")
        self.pick(5, 2)
        window.click("history.fold")
        shot("mixed")
        window.click("light.3", button=RIGHT)
        shot("menu")
        window.key("Escape")
        window.key("F1")
        shot("keys")
        window.key("F1")
        x, y, w, h = window.state()["viewport"]
        window.move([x + w / 2, y + h * 0.7])
        window.settle()
        window.key("a", hold=[SHIFT])
        shot("add")


if __name__ == "__main__":
    if "SIZE" in os.environ:
        LightCase.size = LightCase.screenSize = tuple(int(v) for v in os.environ["SIZE"].split("x"))
    window_case.main()
