"""What tests of lights by hand share: a scene with a light of every type in the real window, picking, typing, dragging,
and reading back what was saved."""
import json
import os

import light_scenes
from window_case import WindowCase, read
from window_driver import WHEEL_DOWN, WHEEL_UP

CTRL, SHIFT = "Control_L", "Shift_L"
SECTIONS = ("Light", "Place", "Shape", "Shaping", "Profile", "Light function", "Colour", "Shadow", "Visibility")


class LightCase(WindowCase):
    size = (1280, 720)

    def open(self, make=light_scenes.every_type, *arguments, frames=1):
        self.remember(meanFrames=frames, mostPixels=20_000)  # what is rendered does not matter here
        self.path = make(os.path.join(self.home, "scene.gltf"), *arguments)
        self.original = read(self.path)
        self.window = self.start(self.path)
        self.window.wait_picture()
        self.window.settle()
        return self.window

    def wait_document(self, **values):
        """Until the document's state has these values."""
        return self.window.wait(lambda s: all(s["document"][key] == value for key, value in values.items()), values)

    def pick(self, *lights):
        """Selects lights by their rows."""
        for count, light in enumerate(lights):
            self.window.click(f"light.{light}", hold=[CTRL] if count else [])
        self.wait_document(selection=sorted(lights))

    def tool(self, key, number):
        self.window.key(key)
        self.window.wait(lambda s: s["tool"] == number, f"the tool {key}")
        self.window.settle()

    def save(self):
        self.window.key("s", hold=[CTRL])
        self.wait_document(unsaved=False)
        return json.loads(read(self.path))

    def node(self, name):
        return next(n for n in self.save()["nodes"] if n["name"] == name)

    def light(self, name):
        document = self.save()
        node = next(n for n in document["nodes"] if n["name"] == name)
        return document["extensions"]["KHR_lights_punctual"]["lights"][
            node["extensions"]["KHR_lights_punctual"]["light"]], node.get("extras", {}).get("kilolux", {})

    def reach(self, field):
        """Turns the wheel over the properties until a field of them can be seen."""
        for _ in range(30):
            x, y, w, h = self.window.wait_place(field)
            if 76 < y and y + h < self.size[1] - 30:
                return
            self.window.click((x + w / 2, self.size[1] / 2), button=WHEEL_DOWN if y > 76 else WHEEL_UP)
        self.fail(f"{field} cannot be reached")

    def enter(self, field, text):
        """Types into a field of the properties and ends with Enter."""
        self.reach(field)
        self.window.click(field)
        self.window.wait(lambda s: s["properties"].get("editing") == field, f"{field} to take text")
        self.window.settle()
        self.window.key("a", hold=[CTRL])
        self.window.type(text)
        self.window.key("Return")
        self.window.wait(lambda s: s["properties"].get("editing") == "", f"{field} to be left")

    def reveal(self, field):
        """Folds sections from above until the field stands within the window; those that were folded."""
        folded = []
        for section in SECTIONS:
            self.window.settle()
            places = self.window.state()["places"]
            if places[field][1] + places[field][3] <= self.size[1] - 30:
                break
            if f"section.{section}" in places:
                self.window.click(f"section.{section}")
                folded.append(section)
        self.window.settle()
        return folded

    def unfold(self, folded):
        for section in reversed(folded):
            self.window.click(f"section.{section}")
            self.window.settle()

    def handles(self):
        self.window.settle()
        return self.window.state()["gizmo"]["handles"]

    def drag_handle(self, start, goal, undo, **how):
        """Drags and waits for the step of that name to be done."""
        before = self.window.state()["document"]["version"]
        self.window.drag(start, goal, **how)
        self.window.wait(lambda s: s["document"]["version"] != before and s["document"]["undo"] == undo and
                         not s["gizmo"]["dragging"], undo)

    def step(self, key, hold=(CTRL,), what="a step"):
        before = self.window.state()["document"]["version"]
        self.window.key(key, hold=list(hold))
        self.window.wait(lambda s: s["document"]["version"] != before, what)
