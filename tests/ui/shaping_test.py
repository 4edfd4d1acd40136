#!/usr/bin/env python3
"""What shapes light, by hand in the real window: shaping_test.py PROGRAM [unittest arguments]

Every handle is dragged and its value looked up in the saved file; profiles come from the browser, presets, masks and
channels from the rows.
"""
import os

import light_scenes
import window_case
from light_case import CTRL, LightCase

# Light, then its handles in files' words.
HANDLES = {
    1: ("Bulb", ["radiusM", "rangeM"]),
    2: ("Spot", ["radiusM", "outerConeRad", "innerConeRad", "rangeM"]),
    3: ("Tube", ["lengthM", "radiusM"]),
    4: ("Window", ["widthM", "heightM"] + [f"barnDoor{side}{what}" for side in ("Left", "Right", "Top", "Bottom")
                                         for what in ("LengthM", "AngleRad")]),
    5: ("Ring", ["widthM"]),
}


class Shaping(LightCase):
    def open(self, make=light_scenes.shaped, *arguments):
        return super().open(make, *arguments)

    def dots(self):
        self.window.settle()
        return self.window.state()["handles"]["dots"]

    def begin(self, light):
        """Selects a light; its place in the picture."""
        self.pick(light)
        self.tool("w", 1)
        center = self.handles()["center"]
        self.tool("q", 0)
        return center

    def goal(self, field, start, center):
        """Off the light, or for an angle aside of the way there."""
        away = [start[i] - center[i] for i in range(2)]
        length = max(1.0, (away[0] ** 2 + away[1] ** 2) ** 0.5)
        away = [28 * part / length for part in away]
        if field.endswith("AngleRad") or field.endswith("ConeRad"):
            return [start[0] - away[1] + 8, start[1] + away[0] + 8]
        return [start[0] + away[0], start[1] + away[1]]

    def value(self, name, field):
        """Of the saved file."""
        definition, extras = self.light(name)
        pair = "barnDoorAngleRad" if field.endswith("AngleRad") else "barnDoorLengthM"
        words = {"rangeM": definition.get("range"), "outerConeRad": definition.get("spot", {}).get("outerConeAngle"),
                 "innerConeRad": definition.get("spot", {}).get("innerConeAngle")}
        if field in extras:
            return extras[field]
        if field.startswith("barnDoor") and pair in extras:
            return extras[pair]
        return words.get(field)

    def click(self, place):
        self.reach(place)
        self.window.click(place)

    def drag_dot(self, field, center, **how):
        start = self.dots()[field]
        before = self.window.state()["document"]["version"]
        self.window.drag(start, self.goal(field, start, center), **how)
        self.window.wait(lambda s: s["document"]["version"] != before, f"{field} to be dragged")
        return start

    def test_every_handle_is_dragged_into_the_file(self):
        window = self.open()
        for light, (name, fields) in HANDLES.items():
            center = self.begin(light)
            if light == 4:
                self.click("doors.flaps")
            self.assertEqual(sorted(self.dots()), sorted(fields), name)
            for field in fields:
                before = self.value(name, field)
                self.drag_dot(field, center, release=False)
                label = window.wait(lambda s: s["handles"].get("label"), f"{field} to say its value")["handles"]["label"]
                window.screen.button(1, False)
                window.wait(lambda s: not s["handles"].get("label"), f"{field} to be let go")
                after = self.value(name, field)
                self.assertGreater(abs(after - before), 0.005 * (before + 0.01), f"{name} {field}")
                shown = float([word for word in label.split() if word[0].isdigit() or word[0] == "-"][0])
                if field.endswith("Rad"):
                    after *= 57.29577951308232
                self.assertAlmostEqual(shown, after, delta=2e-3 * abs(after) + 1e-3, msg=f"{name} {field}: {label}")

    def test_esc_restores_ctrl_snaps_and_a_drag_is_one_step(self):
        window = self.open()
        center = self.begin(4)
        version = window.state()["document"]["version"]
        start = self.drag_dot("widthM", center, release=False)
        window.key("Escape")
        window.wait(lambda s: s["document"]["undo"] == "", "the drag to be given up")
        window.screen.button(1, False)
        dot = self.dots()["widthM"]
        self.assertLess(abs(dot[0] - start[0]) + abs(dot[1] - start[1]), 2.0)
        self.assertNotEqual(window.state()["document"]["version"], version)
        self.drag_dot("widthM", center, hold=[CTRL])
        window.wait(lambda s: not s["handles"].get("label"), "the dot to be let go")
        width = self.value("Window", "widthM")
        self.assertAlmostEqual(width / 0.1, round(width / 0.1), delta=1e-6)
        self.assertNotAlmostEqual(width, 0.8)
        self.step("z", what="undo")
        self.assertEqual(window.state()["document"]["undo"], "")
        self.save()
        with open(self.path, "rb") as file:
            self.assertEqual(file.read(), self.original)

    def test_a_profile_from_the_browser(self):
        window = self.open()
        self.pick(1)
        for section in ("Place", "Shape", "Shaping"):
            window.click(f"section.{section}")
            window.settle()
        window.click("profiles.browse")
        window.wait_place("profiles.globe.ies")
        window.settle()
        window.click("profiles.globe.ies")
        window.wait_place("profiles.plot")
        window.settle()
        self.assertIn("intensity", window.state()["places"])
        window.click("profiles.use")
        window.wait(lambda s: s["document"]["undo"].startswith("IES profile"), "the profile to be used")
        # Its candela stand in place of the light's own, until the light is to have one again.
        window.wait(lambda s: "intensity.profile" in s["places"] and "intensity" not in s["places"], "its candela")
        self.click("iesIntensity")
        window.wait(lambda s: "intensity.profile" not in s["places"] and "intensity" in s["places"], "the light's own")
        self.step("z", what="undo")
        document = self.save()
        node = next(n for n in document["nodes"] if n["name"] == "Bulb")
        self.assertIn("EXT_lights_ies", node["extensions"])
        self.assertEqual(document["extensions"]["EXT_lights_ies"]["lights"][0]["uri"], "profiles/globe.ies")
        self.assertTrue(os.path.exists(os.path.join(self.home, "profiles", "globe.ies")))

    def test_a_preset_and_channels(self):
        window = self.open()
        self.pick(5)
        window.click("preset")
        window.wait_place("preset.LED bulb, 8.5 W")
        window.settle()
        window.click("preset.LED bulb, 8.5 W")
        window.wait(lambda s: s["document"]["undo"].startswith("LED bulb"), "the preset")
        definition, extras = self.light("Ring")
        self.assertEqual((extras["intensity"], extras["unit"], extras["temperatureK"]), (806, "lm", 2700))
        self.assertEqual(definition["type"], "point")
        for section in ("Light", "Place", "Shape", "Shaping", "Profile", "Light function", "Colour", "Shadow"):
            window.click(f"section.{section}")
            window.settle()
        window.click("channels.3")
        window.wait(lambda s: s["document"]["undo"].startswith("Channels"), "the channel")
        self.assertEqual(self.light("Ring")[1]["channels"], 5)

    def test_doors_are_one_pair_or_four_flaps(self):
        window = self.open()
        center = self.begin(4)
        pair = {"barnDoorAngleRad", "barnDoorLengthM"}
        self.assertEqual(set(self.dots()), {"widthM", "heightM"} | pair)
        self.drag_dot("barnDoorAngleRad", center)
        window.wait(lambda s: not s["handles"].get("label"), "the dot to be let go")
        angle = self.value("Window", "barnDoorAngleRad")
        self.assertNotAlmostEqual(angle, 0.7, delta=0.01)
        self.click("doors.flaps")
        window.wait(lambda s: "barnDoorLeftAngleRad" in s["places"] and not pair & set(s["places"]), "a row for each flap")
        self.enter("barnDoorLeftAngleRad", "20")
        self.enter("barnDoorTopLengthM", "0.5")
        _, extras = self.light("Window")
        self.assertAlmostEqual(extras["barnDoorLeftAngleRad"], 0.3490658503988659)
        self.assertEqual(extras["barnDoorTopLengthM"], 0.5)
        # Flaps that differ cannot stand as one pair: the longest one says what all become.
        self.click("doors.pair")
        window.wait(lambda s: pair <= set(s["places"]), "one pair of rows")
        _, extras = self.light("Window")
        self.assertEqual({name for name in extras if name.startswith("barnDoor")}, pair)
        self.assertEqual((extras["barnDoorAngleRad"], extras["barnDoorLengthM"]), (angle, 0.5))

    def test_dots_of_several_lights_move_together_and_can_be_put_away(self):
        window = self.open()
        self.begin(1)
        self.pick(1, 2)
        self.assertEqual(set(self.dots()), {f"{light}.{field}" for light in (1, 2) for field in ("radiusM", "rangeM")})
        start = self.dots()["2.rangeM"]
        window.drag(start, (start[0] + 40, start[1] + 30))
        window.wait(lambda s: s["document"]["undo"] == "Range of 2 lights", "both ranges to be dragged")
        bulb, spot = self.value("Bulb", "rangeM"), self.value("Spot", "rangeM")
        self.assertGreater(abs(bulb - 1.0), 0.02)
        self.assertAlmostEqual(bulb - 1.0, spot - 1.5, places=6)
        window.key("g")
        window.wait(lambda s: not s["handles"]["dots"], "the dots to be put away")
        self.tool("w", 1)
        self.assertNotIn("handles", window.state()["gizmo"])
        window.click("top.gizmos")
        window.wait(lambda s: s["handles"]["dots"] and s["gizmo"].get("handles"), "dots and gizmo")
        self.step("z", what="undo")
        self.save()
        with open(self.path, "rb") as file:
            self.assertEqual(file.read(), self.original)

    def test_channels_of_meshes_and_rows_of_the_dome(self):
        window = self.open()
        window.wait_place("mesh.search")
        self.click("mesh.0.3")
        window.wait(lambda s: s["document"]["undo"] == "Channels of Floor", "the mesh's channel")
        self.click("scene.domeVisible")
        window.wait(lambda s: s["document"]["undo"] == "Dome in the picture", "the dome to be hidden")
        self.enter("scene.domeNit", "30")
        self.enter("scene.fillNit", "2")
        self.enter("scene.domeRotationRad", "90")
        document = self.save()
        floor = next(n for n in document["nodes"] if n["name"] == "Floor")
        self.assertEqual(floor["extras"]["kilolux"]["meshChannels"], 5)
        dome = document["scenes"][0]["extras"]["kilolux"]
        self.assertEqual((dome["domeVisible"], dome["domeNit"], dome["fillNit"]), (False, 30, 2))
        self.assertAlmostEqual(dome["domeRotationRad"], 1.5707963267948966)


if __name__ == "__main__":
    window_case.main()
