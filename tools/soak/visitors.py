# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Simulated clients of the page: users, who move probes and change the scene, and one hostile program on the same machine."""
import math
import os
import random
import signal
import socket
import threading
import time

from page_client import PageClient, PagesAreFull

LAWS = ("proxy", "penalty", "proxy")


class Visitor(threading.Thread):
    """Repeats visit() until `stop`; failures are counted, and each kind is printed once."""

    def __init__(self, touch, stop, seed):
        super().__init__(daemon=True)
        self.touch, self.stop, self.random = touch, stop, random.Random(seed)
        self.messages = self.visits = 0
        self.faults = {}

    def run(self):
        while not self.stop.is_set():
            try:
                self.visit()
                self.visits += 1
            except PagesAreFull:
                # The hostile client has the fourth page, or the program has not yet noticed that a page was closed.
                self.stop.wait(0.5)
            except (OSError, ValueError) as fault:
                self.faults[str(fault)] = self.faults.get(str(fault), 0) + 1
                self.stop.wait(0.5)


class Person(Visitor):
    """Moves one probe, requests descriptions, and sometimes changes law, depth and material; disconnects after some minutes and returns."""

    def __init__(self, touch, stop, seed, probe, messages_per_s):
        super().__init__(touch, stop, seed)
        self.probe, self.messages_per_s = probe, messages_per_s

    def visit(self):
        page = PageClient(self.touch.host, self.touch.port, self.touch.cookie)
        end = time.monotonic() + self.random.uniform(60, 240)
        phase, serial, period_s = self.random.uniform(0, 6), 0, 0.02
        per_period = max(1, round(self.messages_per_s * period_s))
        due = time.monotonic()
        while due < end and not self.stop.is_set():
            due = max(due + period_s, time.monotonic() - 1)
            for _ in range(per_period):
                phase += 0.4 / self.messages_per_s
                page.send(type="pointer", probe=self.probe, x_m=0.03 * math.sin(3 * phase), y_m=0.03 * math.sin(2 * phase + self.probe),
                          press_m=0.002 * math.sin(11 * phase))
            self.messages += per_period
            if self.random.random() < period_s:
                serial += 1
                self.do_something(page, serial)
            while (left_s := due - time.monotonic()) > 0:
                for opcode, payload in page.frames(left_s):
                    if opcode == 8:
                        raise ConnectionError("closed: " + payload[2:].decode(errors="replace"))
        page.close(reset=self.random.random() < 0.3)

    def do_something(self, page, serial):
        """About once a second."""
        what = self.random.randrange(7)
        if what < 2:
            page.send(type="edit", serial=serial, label=0,
                      material={"stiffness_N_per_m": self.random.uniform(100, 900), "damping_Ns_per_m": None, "friction": self.random.uniform(0, 1),
                                "stickiness": None, "texture": None})
        elif what == 2:
            page.send(type="change", serial=serial, law=self.random.choice(LAWS), parameters=[], height_factor=self.random.uniform(0.5, 1.5))
        elif what == 3:
            page.send(type="save")
        elif what == 4:
            page.send(type="pause", paused=True)
            page.send(type="pause", paused=False)
        else:
            page.send(type="ask", serial=serial, what=self.random.choice(("scene", "position", "probe")), probe=0, x_m=0.01, y_m=0.0, press_m=0.0,
                      part=0)


class Neighbour(Visitor):
    """Sends requests without the secret, incomplete requests, damaged and too long messages; also stops the process for moments."""

    def visit(self):
        what = self.random.randrange(6)
        if what == 0:
            self.raw(os.urandom(self.random.randrange(1, 4000)))
        elif what == 1:
            self.raw(f"GET /socket HTTP/1.1\r\nHost: {self.touch.host}:{self.touch.port}\r\nUpgrade: websocket\r\n\r\n".encode())
        elif what == 2:
            self.raw(b"POST /session HTTP/1.1\r\nContent-Length: 4000\r\n\r\nhalf")
        elif what == 3:
            page = PageClient(self.touch.host, self.touch.port, self.touch.cookie)
            page.send_frame(1, self.random.choice((b"{", b"[" * 4000, b'{"type":"pointer","probe":77}', b"x" * 9000, b"\xff\xfe")))
            page.frames(0.2)
            page.close()
        elif what == 4:
            PageClient(self.touch.host, self.touch.port, self.touch.cookie).close(reset=True)
        else:
            # As a busy machine or a debugger does.
            os.kill(self.touch.process, signal.SIGSTOP)
            time.sleep(0.03)
            os.kill(self.touch.process, signal.SIGCONT)
        self.stop.wait(self.random.uniform(0.5, 2.0))

    def raw(self, data):
        with socket.create_connection((self.touch.host, self.touch.port), timeout=10) as connection:
            connection.sendall(data)
            connection.settimeout(0.3)
            try:
                connection.recv(4096)
            except (TimeoutError, ConnectionError):
                pass
        self.messages += 1
