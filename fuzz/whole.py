# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Tests whether the counts, sizes and checksums in a file agree with its bytes, according to the specification of its format. Written
independently of the readers of this project, which are compared with it."""
import io
import re
import struct
import zipfile
import zlib


def contradiction(path):
    """The contradiction in the file; empty if there is none, or if its format states no counts, sizes or checksums."""
    judge = JUDGES.get(path.suffix)
    data = path.read_bytes()
    try:
        return judge(data) if judge else ""
    except (struct.error, IndexError, ValueError, OverflowError):
        return "it is cut off or its head is damaged"


def png(data):
    at = 8
    while True:
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 4:at + 8 + size]
        if len(body) < 4 + size:
            return "a chunk is cut off"
        # A reader may ignore chunks whose name begins with a small letter (PNG, 5.4).
        if kind[0] < 97 and zlib.crc32(body) != struct.unpack_from(">I", data, at + 8 + size)[0]:
            return "a checksum is wrong"
        if kind == b"IEND":
            return ""
        at += 12 + size


def recording(data):
    at = 8
    while at < len(data):
        kind, size, expected = struct.unpack_from("<4sII", data, at)
        body = data[at + 12:at + 12 + size]
        if len(body) < size or zlib.crc32(body) != expected:
            return "a checksum is wrong, or a chunk is cut off"
        if kind == b"HEAD" and at > 8:
            return "there is a second header"
        at += 12 + size
        if kind == b"END ":
            return "" if at == len(data) else "more follows its end"
    return "its end is missing"


def archive(data):
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as members:
            # Members compressed by a method that is not implemented here have checksums of their own.
            for member in members.infolist():
                if member.compress_type in (0, 8):
                    members.open(member).read()
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError) as fault:
        return f"its archive is damaged ({fault})"
    return ""


def stl(data):
    return "" if len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0] else "its count of triangles is not its size's"


def glb(data):
    return "" if struct.unpack_from("<I", data, 8)[0] == len(data) else "its stated length is not its size"


def pfm(data):
    head = re.match(rb"P([Ff])\s+(\d+)\s+(\d+)\s+[-+0-9.eE]+\s", data)
    needed = head and int(head[2]) * int(head[3]) * (12 if head[1] == b"F" else 4)
    return "" if not head or len(data) - head.end() >= needed else "its picture is cut off"


def ply(data):
    head, _, body = data.partition(b"end_header\n")
    counts = dict(re.findall(rb"element (vertex|face) (\d+)", head))
    if b"binary" not in head or head.count(b"property") != 4 or len(counts) != 2:
        return ""
    needed = 12 * int(counts[b"vertex"])
    at = needed
    for _ in range(int(counts[b"face"])):
        at += 1 + 4 * body[at]
    return "" if at <= len(body) else "its counts are more than its size holds"


JUDGES = {".png": png, ".rec": recording, ".palp": archive, ".npz": archive, ".stl": stl, ".glb": glb, ".pfm": pfm, ".ply": ply}
