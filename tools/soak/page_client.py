# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""The page's side of the connection to `palpable touch`: exchange of the token, and a WebSocket (RFC 6455) that sends text."""
import base64
import http.client
import json
import os
import socket
import struct


def let_in(host, port, token):
    """Exchanges the token of the printed address for the cookie, which several pages may use."""
    connection = http.client.HTTPConnection(host, port, timeout=10)
    connection.request("POST", "/session", token, {"Origin": f"http://{host}:{port}"})
    answer = connection.getresponse()
    cookie = answer.getheader("Set-Cookie")
    connection.close()
    if not cookie:
        raise RuntimeError(f"the page was not let in: {answer.status}")
    return cookie.split(";")[0]


class PagesAreFull(ConnectionError):
    """The session already has the maximum number of pages."""


class PageClient:
    """One open page. Errors of the socket are OSError."""

    def __init__(self, host, port, cookie):
        self._socket = socket.create_connection((host, port), timeout=10)
        key = base64.b64encode(os.urandom(16)).decode()
        self._socket.sendall((f"GET /socket HTTP/1.1\r\nHost: {host}:{port}\r\nOrigin: http://{host}:{port}\r\nCookie: {cookie}\r\n"
                              f"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n").encode())
        self._bytes = b""
        while b"\r\n\r\n" not in self._bytes:
            self._receive()
        head, self._bytes = self._bytes.split(b"\r\n\r\n", 1)
        if b" 101 " not in head.split(b"\r\n")[0]:
            self._socket.close()
            answer = head.split(b"\r\n")[0].decode(errors="replace")
            raise PagesAreFull(answer) if " 503 " in answer else ConnectionError(answer)

    def _receive(self):
        part = self._socket.recv(65536)
        if not part:
            raise ConnectionError("the program closed the connection")
        self._bytes += part

    def send(self, **message):
        self.send_frame(1, json.dumps(message).encode())

    def send_frame(self, opcode, payload):
        mask = os.urandom(4)
        head = bytes([0x80 | opcode])
        if len(payload) < 126:
            head += bytes([0x80 | len(payload)])
        else:
            head += bytes([0x80 | 126]) + struct.pack(">H", len(payload))
        pattern = (mask * (len(payload) // 4 + 1))[:len(payload)]
        masked = (int.from_bytes(payload, "big") ^ int.from_bytes(pattern, "big")).to_bytes(len(payload), "big")
        self._socket.sendall(head + mask + masked)

    def frames(self, wait_s):
        """The frames (opcode, payload) that arrive within this many seconds; pings are answered."""
        self._socket.settimeout(wait_s)
        try:
            self._receive()
        except TimeoutError:
            pass
        finally:
            self._socket.settimeout(10)
        found = []
        while frame := self._take():
            if frame[0] == 9:
                self.send_frame(10, frame[1])
            found.append(frame)
        return found

    def _take(self):
        if len(self._bytes) < 2:
            return None
        size, at = self._bytes[1] & 127, 2
        if size >= 126:
            at = 4 if size == 126 else 10
            size = int.from_bytes(self._bytes[2:at], "big")
        if len(self._bytes) < at + size:
            return None
        frame = self._bytes[0] & 15, self._bytes[at:at + size]
        self._bytes = self._bytes[at + size:]
        return frame

    def close(self, reset=False):
        """With `reset`, closes without a closing handshake, like a killed program."""
        if reset:
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self._socket.close()
