#!/usr/bin/env python3
"""Menus, pickers, switches and keys of the window, and what they change in pixels: hands_test.py PROGRAM [arguments]"""
from light_case import LightCase
from window_case import gltf_json, main
from window_driver import RIGHT, wait_for

CTRL, SHIFT = "Control_L", "Shift_L"


class Colours(LightCase):
    def test_a_colour_is_picked_as_one_step(self):
        window = self.open()
        self.pick(2)
        window.click("color.swatch")
        window.wait_place("color.picker")
        x, y, w, h = window.state()["places"]["color.picker"]
        # From the top left of the square, white, towards its top right, the hue's full strength.
        window.drag((x + 0.1 * w, y + 0.1 * h), (x + 0.7 * w, y + 0.1 * h))
        self.wait_document(undo="Tint of 1 light")
        window.key("Escape")
        window.settle()
        picked = self.light("Bulb")[0]["color"]
        self.assertNotEqual(picked, [1, 0.8, 0.5])
        self.assertGreater(max(picked) - min(picked), 0.3)
        self.step("z", what="undo")
        self.wait_document(undo="")


class Menus(LightCase):
    def menu(self, row, choice):
        self.window.click(row, button=RIGHT)
        self.window.wait_place(choice)
        self.window.click(choice)
        self.window.settle()

    def test_every_item_of_a_lights_menu(self):
        window = self.open()
        self.menu("light.2", "menu.rename")
        window.wait(lambda s: s["lightList"]["renaming"] == 2, "the name to take text")
        window.type("Lamp")
        window.key("Return")
        self.wait_document(undo="Rename 1 light")
        eye = window.state()["camera"]["eye"]
        self.menu("light.2", "menu.frame")
        window.wait(lambda s: s["camera"]["eye"] != eye, "the framing")
        framed = window.state()["camera"]["eye"]
        self.menu("light.2", "menu.look")
        window.wait(lambda s: s["camera"]["eye"] != framed, "the look through the light")
        window.key("l")
        window.wait(lambda s: s["camera"]["eye"] == framed, "the way back")
        self.menu("light.2", "menu.mute")
        self.wait_document(undo="Mute 1 light", selection=[2])
        self.menu("light.3", "menu.solo")
        window.wait(lambda s: s["lightList"]["solo"] == [3] and "status.solo" in s["places"], "solo, and a word of it")
        self.menu("light.3", "menu.lock")
        window.wait(lambda s: s["lightList"]["locked"] == [3], "the lock")
        window.click("light.3", button=RIGHT)
        window.click("menu.groups")
        window.click("menu.group")
        self.wait_document(undo="Group 1 light")
        self.menu("light.3", "menu.unique")
        self.wait_document(undo="Make 1 light unique")
        self.menu("light.3", "menu.copy")
        self.menu("light.3", "menu.paste")
        self.wait_document(lights=8, undo="Paste 1 light")
        self.menu("light.3", "menu.duplicate")
        self.wait_document(lights=9)
        # Solo and lock forget a light that is gone.
        self.menu("light.3", "menu.delete")
        self.wait_document(lights=8, undo="Delete 1 light")
        state = window.wait(lambda s: s["lightList"]["solo"] == [] and s["lightList"]["locked"] == [], "to be forgotten")
        self.assertNotIn("status.solo", state["places"])

    def test_a_groups_menu_and_two_groups_dissolved_in_one_step(self):
        window = self.open()
        group = next(n for n in window.state()["places"] if n.startswith("group.") and n.split(".")[1].isdigit())
        self.menu(group, "menu.members")
        self.wait_document(selection=[5])
        self.menu(group, "menu.soloGroup")
        window.wait(lambda s: s["lightList"]["solo"] == [5], "solo")
        self.menu(group, "menu.soloGroup")
        window.wait(lambda s: s["lightList"]["solo"] == [], "no solo")
        self.pick(6)
        self.step("g", what="a second group")
        self.pick(5, 6)
        self.step("g", hold=[CTRL, SHIFT], what="dissolving")
        self.wait_document(undo="Dissolve 2 groups")
        self.step("z", what="undo")
        self.wait_document(undo="Group 1 light")
        self.menu(group, "menu.dissolve")
        self.wait_document(undo="Dissolve 'Key'")


class Switches(LightCase):
    def floor(self):
        x, y, w, h = self.window.state()["viewport"]
        return self.window.pixels((x + 0.45 * w, y + 0.8 * h, 0.1 * w, 0.1 * h))

    def settled(self):
        self.window.wait_picture()
        self.window.wait(lambda s: s["picture"]["settled"], "rest")
        self.window.move((2, 700))
        self.window.settle()

    def test_solo_shows_in_the_picture_and_undoes_itself(self):
        window = self.open(frames=12)  # one alone is noisy
        self.settled()
        all_lights = sum(self.floor())
        window.click("solo.7")
        window.wait(lambda s: s["lightList"]["solo"] == [7], "solo")
        wait_for(lambda: sum(self.floor()) < 0.88 * all_lights, "the other lights to go out")
        self.settled()
        alone = sum(self.floor())
        self.assertFalse(window.state()["document"]["unsaved"], "a view is no edit")
        window.click("solo.7")
        wait_for(lambda: sum(self.floor()) > 1.1 * alone, "the other lights to come back")

    def test_a_locked_light_is_not_picked_and_stays_locked_the_next_time(self):
        window = self.open()
        self.pick(2)
        center = self.handles()["center"]
        window.key("Escape")
        self.tool("q", 0)
        window.click("lock.2")
        window.wait(lambda s: s["lightList"]["locked"] == [2], "the lock")
        window.click(center)
        self.wait_document(selection=[])
        # Its outline does not answer the pointer either.
        x, y = center
        before = window.pixels((x - 14, y - 14, 28, 28))
        window.move((x, y))
        window.settle()
        wait_for(lambda: window.pixels((x - 14, y - 14, 28, 28)) == before, "an outline that stays thin")
        self.assertEqual(window.quit(), 0)
        self.window = window = self.start(self.path)
        window.wait(lambda s: s["document"] and s["lightList"].get("locked") == [2], "the lock as it was left")
        window.wait_picture()
        window.click("lock.2")
        window.wait(lambda s: s["lightList"]["locked"] == [], "no lock")
        window.click(center)
        self.wait_document(selection=[2])


class Keys(LightCase):
    def test_help_is_there_without_a_scene_and_esc_closes_it_alone(self):
        window = self.start()
        window.wait_place("first.open")
        window.key("F1")
        window.wait(lambda s: s["help"], "the keys")
        window.key("Escape")
        window.wait(lambda s: not s["help"], "the keys to go")
        window.close()
        window = self.open()
        self.pick(2)
        window.key("F1")
        window.wait(lambda s: s["help"], "the keys")
        window.key("Delete")
        window.key("Escape")
        state = window.wait(lambda s: not s["help"], "the keys to go")
        self.assertEqual(state["document"]["selection"], [2])
        self.assertEqual(state["document"]["lights"], 7, "nothing is worked at below the list")

    def test_the_probes_key_leads_to_its_tab_and_esc_ends_picking(self):
        window = self.open()
        self.pick(2)
        window.key("Tab")
        window.wait(lambda s: not s["panels"], "no panels")
        window.key("p")
        window.wait(lambda s: s["panels"] and "probe.pick" in s["places"] and s["viewPanel"]["picking"], "the probe's tab")
        window.key("Escape")
        state = window.wait(lambda s: not s["viewPanel"]["picking"], "picking to end")
        self.assertEqual(state["document"]["selection"], [2], "Esc was for the picking")

    def test_garbage_in_the_fields_of_other_panels(self):
        window = self.open()
        window.click("tab.view")
        window.key("5")
        window.wait(lambda s: s["picture"]["view"] == "lights-in-range" and "view.high" in s["places"], "the view")
        high = window.state()["viewPanel"]["high"]
        for text in ("nan", "-1e999", "abc", "1e5000", "--"):
            window.click("view.high", times=2)
            window.key("a", hold=[CTRL])
            window.type(text)
            window.key("Return")
            window.settle()
            state = window.state()
            self.assertGreater(state["viewPanel"]["high"], state["viewPanel"]["low"], text)
        self.assertLess(abs(window.state()["viewPanel"]["high"]), 1e300)
        self.assertGreater(high, 0)
        window.key("1")
        window.click("lights.search")
        window.type("%s{}")
        window.wait(lambda s: s["lightList"]["shown"] == 0, "no match")
        window.key("a", hold=[CTRL])
        window.key("BackSpace")
        window.key("Escape")
        place = window.wait_place("top.exposure")
        window.click((place[0] + place[2] / 2, place[1] + place[3] / 2), times=2)
        window.key("a", hold=[CTRL])
        window.type("1e99")
        window.key("Return")
        window.settle()
        self.assertLessEqual(abs(window.state()["exposure"]), 40.0)
        self.assertEqual(window.state()["notices"], [], "a number out of range is brought into it")
        self.step("z", what="undo")
        window.key("o", hold=[CTRL])
        window.wait(lambda s: s["question"] == "open", "the folder list")
        window.type("no such file?.glb")
        window.key("Return")
        window.wait(lambda s: any("no such file" in n for n in s["notices"]), "the reason")
        self.assertEqual(window.state()["document"]["path"], self.path)
        self.assertTrue(gltf_json(self.path)["nodes"])


if __name__ == "__main__":
    main()
