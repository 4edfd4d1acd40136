"""Drives the real window under Xvfb with real X events: start, click, drag, key, type, screenshot, wait for a state.

Pointer and keys go through the X server by XTest (libXtst), so that the program gets them as from a person's hands.
What the window shows is read from the file of `kilolux edit --state`, and pictures from Xvfb's frame buffer.
"""
import ctypes
import ctypes.util
import json
import mmap
import os
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import zlib

LEFT, MIDDLE, RIGHT, WHEEL_UP, WHEEL_DOWN = 1, 2, 3, 4, 5
FRAMES_PER_EVENT = 3  # of ui/window.cpp

# Characters whose X name is not the character itself.
_KEYSYMS = {" ": "space", ".": "period", ",": "comma", "-": "minus", "+": "plus", "/": "slash", "_": "underscore",
            "*": "asterisk", "(": "parenleft", ")": "parenright", "'": "apostrophe", ":": "colon", "=": "equal",
            "#": "numbersign", "%": "percent", "\\": "backslash", "!": "exclam", "?": "question", "~": "asciitilde",
            "\"": "quotedbl", "<": "less", ">": "greater", "$": "dollar", "&": "ampersand", ";": "semicolon",
            "[": "bracketleft", "]": "bracketright", "{": "braceleft", "}": "braceright", "@": "at", "^": "asciicircum"}
_SHIFTED = set("_+*()':#%!?~\"<>$&{}@^") - set("'") | {":"}


class Timeout(AssertionError):
    pass


def wait_for(condition, what, timeout_s=180.0):
    """Polls until condition() is true and returns what it gave. The time only ends a test that would hang."""
    end = time.monotonic() + timeout_s
    while True:
        result = condition()
        if result:
            return result
        if time.monotonic() > end:
            raise Timeout(f"waited {timeout_s:.0f} s for {what}")
        time.sleep(0.01)


class Screen:
    """An X server of its own, with XTest."""

    def __init__(self, width=1280, height=720):
        self.folder = tempfile.mkdtemp(prefix="kilolux-ui-")
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-fbdir", self.folder,
             "-nolisten", "tcp", "-noreset"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise RuntimeError("Xvfb did not start")
        self.name = f":{number}"
        self.x11 = ctypes.CDLL("libX11.so.6")
        self.xtst = ctypes.CDLL("libXtst.so.6")
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.x11.XDefaultRootWindow.restype = ctypes.c_ulong
        self.x11.XStringToKeysym.restype = ctypes.c_ulong
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(self.name.encode()))
        if not self.display:
            raise RuntimeError(f"cannot open display {self.name}")

    def close(self):
        self.x11.XCloseDisplay(self.display)
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def flush(self):
        self.x11.XSync(self.display, 0)

    def move(self, x, y):
        self.xtst.XTestFakeMotionEvent(self.display, -1, int(x), int(y), ctypes.c_ulong(0))
        self.flush()

    def button(self, number, down):
        self.xtst.XTestFakeButtonEvent(self.display, number, int(down), ctypes.c_ulong(0))
        self.flush()

    def key(self, name, down):
        symbol = self.x11.XStringToKeysym(name.encode())
        code = self.x11.XKeysymToKeycode(self.display, ctypes.c_ulong(symbol))
        if not code:
            raise ValueError(f"no key '{name}'")
        self.xtst.XTestFakeKeyEvent(self.display, code, int(down), ctypes.c_ulong(0))
        self.flush()

    def _windows(self, window):
        root, parent = ctypes.c_ulong(), ctypes.c_ulong()
        children, count = ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        self.x11.XQueryTree(self.display, ctypes.c_ulong(window), ctypes.byref(root), ctypes.byref(parent),
                            ctypes.byref(children), ctypes.byref(count))
        found = [children[i] for i in range(count.value)]
        if count.value:
            self.x11.XFree(children)
        return found

    def _titled(self, title):
        for window in self._windows(self.x11.XDefaultRootWindow(self.display)):
            name = ctypes.c_char_p()
            if self.x11.XFetchName(self.display, ctypes.c_ulong(window), ctypes.byref(name)) and name.value:
                if name.value.decode() == title:
                    return window
        return None

    def titled(self, title):
        return wait_for(lambda: self._titled(title), f"a window '{title}'")

    def resize(self, title, width, height):
        window = self.titled(title)
        self.x11.XMoveResizeWindow(self.display, ctypes.c_ulong(window), 0, 0, width, height)
        self.flush()

    def close_window(self, title):
        """Asks the window to close, as a window manager does."""
        window = self._titled(title)
        protocols = self.x11.XInternAtom(self.display, b"WM_PROTOCOLS", 0)
        delete = self.x11.XInternAtom(self.display, b"WM_DELETE_WINDOW", 0)
        message = struct.pack("=iiQiiQQQiiQQQQQ", 33, 0, 0, 1, 0, 0, window, protocols, 32, 0, delete, 0, 0, 0, 0)
        event = ctypes.create_string_buffer(message, 192)
        self.x11.XSendEvent(self.display, ctypes.c_ulong(window), 0, ctypes.c_long(0), event)
        self.flush()

    def pixels(self):
        """(width, height, rows of BGRX bytes) of the whole screen."""
        with open(os.path.join(self.folder, "Xvfb_screen0"), "rb") as file:
            data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
            header = struct.unpack(">25I", data[:100])
            size, width, height, stride, colors = header[0], header[4], header[5], header[12], header[19]
            start = size + colors * 12
            rows = [data[start + y * stride:start + y * stride + width * 4] for y in range(height)]
            data.close()
        return width, height, rows


def write_png(path, width, rows):
    """8-bit RGB from rows of BGRX bytes."""
    lines = bytearray()
    for row in rows:
        line = bytearray(width * 3)
        line[0::3], line[1::3], line[2::3] = row[2:width * 4:4], row[1:width * 4:4], row[0:width * 4:4]
        lines += b"\0" + line

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(bytes(lines), 9)) + chunk(b"IEND", b""))


class Window:
    """One run of the program with a home of its own."""

    def __init__(self, program, screen, scene=None, home=None, size=(1280, 720), arguments=(), environment=None):
        self.screen = screen
        self.ownsHome = home is None
        self.home = home or tempfile.mkdtemp(prefix="kilolux-home-")
        self.stateFile = os.path.join(self.home, "state.json")
        if os.path.exists(self.stateFile):
            os.remove(self.stateFile)
        variables = dict(os.environ, DISPLAY=screen.name, XDG_CONFIG_HOME=os.path.join(self.home, "config"),
                           XDG_STATE_HOME=os.path.join(self.home, "state"), **(environment or {}))
        self.log = open(os.path.join(self.home, "log"), "a+")
        command = [program, "edit", "--state", self.stateFile, "--size", f"{size[0]}x{size[1]}", *arguments]
        self.process = subprocess.Popen(command + ([scene] if scene else []), env=variables,
                                        stdout=self.log, stderr=self.log)
        self.wait(lambda s: True, "the window")

    # --- what it shows

    def state(self):
        try:
            with open(self.stateFile) as file:
                return json.load(file)
        except (FileNotFoundError, json.JSONDecodeError):
            return None

    def wait(self, condition, what, timeout_s=180.0):
        """Until condition(state) holds; returns the state."""
        def look():
            if self.process.poll() is not None:
                self.log.seek(0)
                raise AssertionError(f"the program ended with {self.process.returncode} while waiting for {what}:\n"
                                     + self.log.read()[-2000:])
            state = self.state()
            return state if state and condition(state) else None
        try:
            return wait_for(look, what, timeout_s)
        except Timeout as error:
            state = self.state() or {}
            state.pop("places", None), state.pop("frameMs", None)
            raise Timeout(f"{error}; the state is {json.dumps(state)[:2000]}") from None

    def wait_picture(self):
        """Until a picture of the document as it is now is shown."""
        return self.wait(lambda s: s["document"] and s["picture"] and
                         s["picture"]["version"] == s["document"]["version"], "a picture")

    def wait_place(self, name):
        self.wait(lambda s: name in s["places"], f"the place '{name}'")
        self.settle()
        return self.state()["places"][name]

    def settle(self):
        """Until the frames that the events so far called for have been drawn. Pictures call for frames as well, and
        may come faster than these are drawn: then so many later ones do."""
        frames = self.wait(lambda s: True, "a state")["frames"] + FRAMES_PER_EVENT + 1
        self.wait(lambda s: s["framesDue"] == 0 or s["frames"] >= frames, "the window to come to rest")

    def rests(self):
        """Looks for half a second whether the program uses less than a twentieth of a processor."""
        def ticks():
            with open(f"/proc/{self.process.pid}/stat") as file:
                fields = file.read().rsplit(")", 1)[1].split()
            return int(fields[11]) + int(fields[12])  # of user and system
        before = ticks()
        time.sleep(0.5)
        return ticks() - before <= 0.025 * os.sysconf("SC_CLK_TCK")

    def screenshot(self, path, rect=None):
        width, height, rows = self.screen.pixels()
        x, y, w, h = (int(v) for v in (rect or (0, 0, width, height)))
        write_png(path, w, [row[x * 4:(x + w) * 4] for row in rows[y:y + h]])

    def pixels(self, rect):
        """The mean colour (red, green, blue; 0 to 255) of a part of the screen."""
        width, height, rows = self.screen.pixels()
        x, y, w, h = (int(v) for v in rect)
        part = b"".join(row[x * 4:(x + w) * 4] for row in rows[y:y + h])
        return [sum(part[channel::4]) / max(w * h, 1) for channel in (2, 1, 0)]

    # --- hands

    def _position(self, at):
        if isinstance(at, str):
            x, y, w, h = self.wait_place(at)
            return x + w / 2, y + h / 2
        return at

    def _events(self, action):
        """Runs the action and waits until the program has seen the keys, buttons and wheel steps of it."""
        before = self.state()["events"]
        count = action()
        self.wait(lambda s: s["events"] >= before + count, f"{count} events to arrive")

    def move(self, at):
        self.screen.move(*self._position(at))

    def click(self, at, button=LEFT, hold=(), times=1, ends=False):
        """At a place's name or a position in pixels. `hold`: keys that are down meanwhile. `ends`: the program may
        end by it, nothing is waited for."""
        position = self._position(at)

        def act():
            self.screen.move(*position)
            for key in hold:
                self.screen.key(key, True)
            for _ in range(times):
                self.screen.button(button, True)
                self.screen.button(button, False)
            for key in reversed(list(hold)):
                self.screen.key(key, False)
            wheel = button in (WHEEL_UP, WHEEL_DOWN)
            return 2 * len(hold) + (times if wheel else 2 * times)
        if ends:
            act()
            return
        self._events(act)
        self.settle()

    def drag(self, start, end, button=LEFT, steps=8, hold=(), release=True, pause_s=0.02):
        position, goal = self._position(start), self._position(end)

        def act():
            self.screen.move(*position)
            for key in hold:
                self.screen.key(key, True)
            time.sleep(pause_s)
            self.screen.button(button, True)
            for step in range(1, steps + 1):
                time.sleep(pause_s)
                t = step / steps
                self.screen.move(position[0] + (goal[0] - position[0]) * t, position[1] + (goal[1] - position[1]) * t)
            time.sleep(pause_s)
            if release:
                self.screen.button(button, False)
            for key in reversed(list(hold)):
                self.screen.key(key, False)
            return 2 * len(hold) + (2 if release else 1)
        self._events(act)
        self.settle()

    def key(self, name, hold=()):
        """One key by its X name ('z', 'Tab', 'Escape', 'F1'); `hold`: modifiers, as 'Control_L'."""
        def act():
            for key in hold:
                self.screen.key(key, True)
            self.screen.key(name, True)
            self.screen.key(name, False)
            for key in reversed(list(hold)):
                self.screen.key(key, False)
            return 2 * len(hold) + 2
        self._events(act)
        self.settle()

    def type(self, text):
        def act():
            count = 0
            for before, character in zip(" " + text, text):
                # GLFW takes a key's second press within 20 ms for an echo of the first, when it finds both waiting.
                time.sleep(0.025 if before.lower() == character.lower() else 0.003)
                shift = character.isupper() or character in _SHIFTED
                if shift:
                    self.screen.key("Shift_L", True)
                name = _KEYSYMS.get(character, character)
                self.screen.key(name, True)
                self.screen.key(name, False)
                if shift:
                    self.screen.key("Shift_L", False)
                count += 4 if shift else 2
            return count
        self._events(act)
        self.settle()

    def resize(self, width, height):
        self.screen.resize("Kilolux", width, height)

    # --- ends

    def quit(self):
        """Closes the window and returns the exit code."""
        self.screen.close_window("Kilolux")
        return self.process.wait(30)

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def close(self):
        if self.process.poll() is None:
            self.kill()
        self.log.close()
        if self.ownsHome:
            shutil.rmtree(self.home, ignore_errors=True)
