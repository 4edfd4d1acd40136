#!/usr/bin/env python3
"""The panels that show why: views by keys and clicks, legends, what a pass wrote, the probe and its selection, the stored
picture with its split view, and the error against the live reference. KILOLUX_UI_PICTURES names a folder for screenshots.
"""
import os

from window_case import WindowCase, main
from window_driver import WHEEL_DOWN, wait_for


class Views(WindowCase):
    """One window for all of them, in order: each leaves it with the picture."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shared = cls("runTest")
        WindowCase.setUp(cls.shared)
        cls.addClassCleanup(WindowCase.tearDown, cls.shared)
        cls.window, _ = cls.shared.open_scene("cornell.glb", size=(1280, 720) if os.environ.get("KILOLUX_UI_PICTURES") else (960, 540))

    def setUp(self):
        pass

    def tearDown(self):
        pass

    def runTest(self):
        pass

    def picture(self, name):
        folder = os.environ.get("KILOLUX_UI_PICTURES")
        if folder:
            os.makedirs(folder, exist_ok=True)
            self.window.settle()
            self.window.screenshot(os.path.join(folder, name + ".png"))

    def wait_view(self, view):
        return self.window.wait(lambda s: s["viewPanel"].get("shown", "").startswith(view), f"view '{view}'")

    def wait_pixels(self, rect, color, what):
        """Until that part of the screen has the colour: the driver presents when it can."""
        wait_for(lambda: self.window.pixels(rect) == color, what)

    def pixel(self, u, v):
        x, y, w, h = self.window.state()["viewport"]
        return x + u * w, y + v * h

    def test_1_keys_and_clicks_choose_views(self):
        for key, view in (("5", "lights-in-range"), ("2", "illuminance"), ("9", "normal"), ("1", "final")):
            self.window.key(key)
            state = self.wait_view(view)
            self.assertEqual(state["view"], "" if view == "final" else view)
        self.window.click("tab.view")
        self.window.click("view.stops")
        state = self.wait_view("stops")
        self.assertEqual((state["viewPanel"]["low"], state["viewPanel"]["high"]), (-6.0, 6.0))
        self.window.move(self.pixel(0.5, 0.5))
        self.window.wait(lambda s: "pointer" in s["viewPanel"], "the value under the pointer", timeout_s=150)
        self.picture("view-stops")
        self.window.key("2")
        self.wait_view("illuminance")
        self.picture("view-illuminance")
        self.window.key("1")
        self.wait_view("final")

    def test_2_the_scale_can_be_typed(self):
        self.window.click("tab.view")
        self.window.key("5")
        self.wait_view("lights-in-range")
        self.window.click("view.high", times=2)
        self.window.key("a", hold=("Control_L",))
        self.window.type("8")
        self.window.key("Return")
        self.window.wait(lambda s: s["viewPanel"]["high"] == 8.0, "the scale to end at 8")
        self.window.click("view.ownScale")
        self.window.wait(lambda s: s["viewPanel"]["high"] == 64.0, "the view's own scale")
        self.window.key("1")
        self.wait_view("final")

    def test_3_a_row_of_the_times_shows_what_the_pass_wrote(self):
        self.window.click("tab.cost")
        self.window.click("cost.pass.shade_samples")
        self.wait_view("pass:shade_samples/litDiffuseOut")
        self.picture("cost-pass")
        self.window.click("cost.pass.shade_samples")
        self.wait_view("pass:shade_samples/litSpecularOut")
        # One that writes no image leads to a view of what it wrote, and nothing breaks.
        self.window.click("cost.pass.visible_list")
        self.wait_view("list-length")
        self.window.key("1")
        self.wait_view("final")
        self.picture("cost")

    def test_0_a_probed_pixel_lists_its_lights_and_selects_one(self):
        self.window.click("tab.probe")
        self.window.key("p")
        self.window.click(self.pixel(0.5, 0.35))
        # The pipeline of the probe is built at the first question.
        state = self.window.wait(lambda s: s["viewPanel"].get("probe", {}).get("lights"), "the lights of the pixel")
        probe = state["viewPanel"]["probe"]
        self.assertGreater(probe["lux"], 0.0)
        light = probe["lights"][0]
        self.window.click(f"probe.light.{light}")
        self.window.wait(lambda s: s["document"]["selection"] == [light], "the light to be selected")
        self.picture("probe")

    def test_5_a_stored_picture_is_shown_and_split(self):
        self.window.click("tab.view")
        self.window.wait(lambda s: s["picture"]["settled"], "the picture to settle")
        self.window.click("reference.store")
        self.window.key("9")
        self.window.wait(lambda s: s["picture"]["settled"] and s["picture"]["view"] == "normal", "the view to settle")
        self.wait_view("normal")
        x, y, w, h = self.window.state()["viewport"]
        left, right = (x + 0.2 * w, y + 0.6 * h, 8, 8), (x + 0.8 * w, y + 0.6 * h, 8, 8)
        self.window.move((x + 2, y + h - 2))
        self.window.settle()
        present = [self.window.pixels(left), self.window.pixels(right)]
        self.window.key("b")
        self.window.wait(lambda s: s["viewPanel"]["comparing"] == 1, "the stored picture")
        wait_for(lambda: self.window.pixels(right) != present[1], "another picture")
        stored = [self.window.pixels(left), self.window.pixels(right)]
        self.window.click("reference.split")
        self.window.wait(lambda s: s["viewPanel"]["comparing"] == 2, "the split view")
        self.window.settle()
        self.wait_pixels(left, stored[0], "the stored picture on the left")
        self.wait_pixels(right, present[1], "the present one on the right")
        self.picture("split")
        line = self.window.wait_place("reference.line")
        self.window.drag((line[0] + 2, y + 0.3 * h), (x + 0.9 * w, y + 0.3 * h))
        self.window.move((x + 2, y + h - 2))
        self.window.settle()
        self.wait_pixels(right, stored[1], "the line to be right of it")
        self.window.click("reference.split")
        self.window.key("1")
        self.wait_view("final")

    def test_6_the_error_is_measured_against_a_reference(self):
        self.window.click("tab.view")
        self.window.click("reference.live")
        state = self.window.wait(lambda s: s["viewPanel"].get("error"), "the error", timeout_s=150)
        self.assertGreater(state["viewPanel"]["error"]["flip"], 0.0)
        self.assertLess(state["viewPanel"]["error"]["flip"], 0.5)
        self.window.click("reference.map")
        self.window.wait(lambda s: s["viewPanel"]["comparing"] == 3, "the map of the error")
        self.picture("error")
        self.check_map(self.window.wait_place("reference.legend"))
        self.window.click("reference.map")
        self.check_presets()
        self.window.click("reference.stop")
        state = self.window.wait(lambda s: s["viewPanel"]["comparing"] == 0, "the picture")
        self.assertNotIn("error", state["viewPanel"], "what was measured is given up")

    def check_presets(self):
        """A preset is chosen by its row; each has a curve, whose error falls."""
        self.window.wait(lambda s: len(s["viewPanel"]["quality"]["curves"].get("high", [])) > 0, "a first point")
        self.window.wait_place("quality.plot")
        for preset in ("draft", "high"):
            x, y, w, h = self.window.wait_place(f"quality.{preset}")
            for _ in range(20):
                if y + h < self.shared.size[1] - 30:
                    break
                self.window.click((x + 40, self.shared.size[1] / 2), button=WHEEL_DOWN)
                x, y, w, h = self.window.wait_place(f"quality.{preset}")
            self.window.click((x + 20, y + h / 2))
            self.window.wait(lambda s: s["viewPanel"]["quality"]["preset"] == preset, f"the preset {preset}")
            state = self.window.wait(lambda s: s["picture"]["settled"] and
                                     s["viewPanel"]["quality"]["curves"].get(preset), f"a point of {preset}")
            for frames, seconds, error in state["viewPanel"]["quality"]["curves"][preset]:
                self.assertGreaterEqual(frames, 4)
                self.assertGreater(seconds, 0.0)
                self.assertGreater(error, 0.0)
        self.assertEqual(set(state["viewPanel"]["quality"]["curves"]), {"draft", "high"})
        self.picture("quality")

    def check_map(self, legend):
        """Every pixel of the map has a colour of its legend, and there are several."""
        x, y, w, h = (int(v) for v in self.window.state()["viewport"])
        left, top, width, height = (int(v) for v in legend)

        def colours():
            _, _, rows = self.window.screen.pixels()
            at = lambda px, py: tuple(rows[py][px * 4:px * 4 + 3])  # noqa: E731
            bar = [at(left + i, top + height // 2) for i in range(1, width - 1)]
            # A grid over the lower part, where no outline and no legend is.
            shown = [at(x + i * w // 24, y + j * h // 24) for i in range(1, 24) for j in range(13, 24)]
            far = max(min(sum(abs(a - b) for a, b in zip(c, d)) for d in bar) for c in shown)
            return far < 30 and len(set(shown)) > 10
        wait_for(colours, "a map in the legend's colours")

    def test_7_the_view_goes_to_a_file(self):
        self.window.click("tab.view")
        self.window.click("view.export")
        path = os.path.join(self.shared.home, "cornell-picture.png")
        self.window.wait(lambda s: any(path in n for n in s["notices"]), "the word that it is written")
        with open(path, "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")


if __name__ == "__main__":
    main()
