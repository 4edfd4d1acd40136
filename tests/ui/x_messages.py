"""What other programs of the desktop send to a window: a file dropped onto it, by the XDND protocol, version 5, and a
window manager's minimising and restoring. Raw messages by libX11, as no such program runs under Xvfb."""
import ctypes
import struct
import time
import urllib.parse

CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31
ATOM = 4
NORMAL_STATE, ICONIC_STATE = 1, 3


class XMessages:
    """Over a connection of its own, so that its events are nobody else's."""

    def __init__(self, screen):
        self.x11 = screen.x11
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(screen.name.encode()))
        root = ctypes.c_ulong(self.x11.XDefaultRootWindow(self.display))
        self.x11.XCreateSimpleWindow.restype = ctypes.c_ulong
        self.window = self.x11.XCreateSimpleWindow(self.display, root, -10, -10, 1, 1, 0, ctypes.c_ulong(0), ctypes.c_ulong(0))

    def close(self):
        self.x11.XCloseDisplay(self.display)

    def atom(self, name):
        return self.x11.XInternAtom(self.display, name.encode(), 0)

    def send(self, target, kind, data):
        """A client message of 5 words."""
        words = list(data) + [0] * (5 - len(data))
        event = struct.pack("=iiQiiQQQiiqqqqq", CLIENT_MESSAGE, 0, 0, 1, 0, 0, target, self.atom(kind), 32, 0, *words)
        self.x11.XSendEvent(self.display, ctypes.c_ulong(target), 0, ctypes.c_long(0),
                            ctypes.create_string_buffer(event, 192))
        self.x11.XSync(self.display, 0)

    def set_property(self, target, name, kind, width, data, count):
        self.x11.XChangeProperty(self.display, ctypes.c_ulong(target), ctypes.c_ulong(self.atom(name)),
                                 ctypes.c_ulong(kind), width, 0, data, count)

    def next_event(self, until):
        """The next event as bytes; fails when none has come until then, which only a hanging program makes happen."""
        event = ctypes.create_string_buffer(192)
        while self.x11.XPending(self.display) == 0:
            if time.monotonic() > until:
                raise AssertionError("the window does not answer the drop")
            time.sleep(0.005)
        self.x11.XNextEvent(self.display, event)
        return event.raw

    def answer_selection(self, event, text):
        """Gives the dropped text to who asks for it."""
        requestor, selection, target, prop, when = struct.unpack("=5Q", event[40:80])
        self.x11.XChangeProperty(self.display, ctypes.c_ulong(requestor), ctypes.c_ulong(prop), ctypes.c_ulong(target), 8, 0,
                                 text, len(text))
        notify = struct.pack("=iiQiiQQQQQQ", SELECTION_NOTIFY, 0, 0, 1, 0, 0, requestor, selection, target, prop, when)
        self.x11.XSendEvent(self.display, ctypes.c_ulong(requestor), 0, ctypes.c_long(0),
                            ctypes.create_string_buffer(notify, 192))
        self.x11.XSync(self.display, 0)

    def drop(self, target, path, x, y):
        """Drops a file at that place of the screen and waits until the window has taken it."""
        text = ("file://" + urllib.parse.quote(path) + "\r\n").encode()
        uris, copy = self.atom("text/uri-list"), self.atom("XdndActionCopy")
        self.x11.XSetSelectionOwner(self.display, ctypes.c_ulong(self.atom("XdndSelection")), ctypes.c_ulong(self.window),
                                    ctypes.c_ulong(0))
        self.send(target, "XdndEnter", [self.window, 5 << 24, uris])
        self.send(target, "XdndPosition", [self.window, 0, int(x) << 16 | int(y), 0, copy])
        until, status, finished = time.monotonic() + 60, self.atom("XdndStatus"), self.atom("XdndFinished")
        while True:
            event = self.next_event(until)
            kind = struct.unpack("=i", event[:4])[0]
            if kind == SELECTION_REQUEST:
                self.answer_selection(event, text)
            if kind != CLIENT_MESSAGE:
                continue
            message, words = struct.unpack("=Q", event[40:48])[0], struct.unpack("=5q", event[56:96])
            if message == status:
                if not words[1] & 1:
                    raise AssertionError("the window takes no files")
                self.send(target, "XdndDrop", [self.window, 0, 0])
            if message == finished:
                return

    # --- as a window manager does

    def _set_state(self, target, state):
        words = (ctypes.c_long * 2)(state, 0)
        self.set_property(target, "WM_STATE", self.atom("WM_STATE"), 32, words, 2)

    def minimise(self, target):
        self._set_state(target, ICONIC_STATE)
        self.x11.XUnmapWindow(self.display, ctypes.c_ulong(target))
        self.x11.XSync(self.display, 0)

    def restore(self, target):
        self._set_state(target, NORMAL_STATE)
        self.x11.XMapWindow(self.display, ctypes.c_ulong(target))
        self.x11.XSync(self.display, 0)
