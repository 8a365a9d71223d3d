# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Measures the resources of a running touch, and reads its growing recording."""
import os
import struct

# docs/recording.md: time, period, written force, energy balance and flags of a tick.
TICK = struct.Struct("<8xdd120x3ddI12x")
CONTACT, PASSIVITY_ACTED, STALLED = 1, 16, 2048


class GrowingRecording:
    """Reads the complete chunks; the next call continues after them."""

    def __init__(self, path):
        self._file = open(path, "rb")
        self._at = 8
        self.ticks = self.further = self.scenes = 0
        self.missed = self.stalls = self.contact = 0

    def news(self):
        """Least and greatest energy, and greatest force, of the ticks since the last call; the counts accumulate."""
        least_J = most_J = most_N = 0.0
        while head := self._chunk_head():
            kind, size = head
            if kind == b"TICK":
                for _, dt_s, x, y, z, energy_J, flags in TICK.iter_unpack(self._file.read(size)):
                    self.ticks += 1
                    self.missed += dt_s > 0.002
                    self.contact += flags & CONTACT
                    self.stalls += bool(flags & STALLED)
                    least_J, most_J = min(least_J, energy_J), max(most_J, energy_J)
                    most_N = max(most_N, (x * x + y * y + z * z) ** 0.5)
            elif kind == b"MORE":
                self.further += size // 192
            elif kind == b"PROG":
                self.scenes += 1
            self._at += 12 + size
        return least_J, most_J, most_N

    def _chunk_head(self):
        self._file.seek(0, os.SEEK_END)
        end = self._file.tell()
        self._file.seek(self._at)
        head = self._file.read(12)
        if len(head) < 12:
            return None
        kind, size, _ = struct.unpack("<4sII", head)
        return (kind, size) if self._at + 12 + size <= end else None


def used_by(process):
    """Memory in MiB (resident, private), descriptors, threads, and processor seconds."""
    status = dict(line.split(":", 1) for line in open(f"/proc/{process}/status"))
    fields = open(f"/proc/{process}/stat").read().rsplit(")", 1)[1].split()
    mebibytes = lambda name: int(status[name].split()[0]) / 1024
    return {"resident_MiB": mebibytes("VmRSS"), "own_MiB": mebibytes("RssAnon"), "descriptors": len(os.listdir(f"/proc/{process}/fd")),
            "threads": int(status["Threads"]), "processor_s": (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")}
