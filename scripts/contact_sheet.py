#!/usr/bin/env python3
"""Puts PNG pictures of one size (8 bits, RGB or RGBA) side by side on dark grey.

The standard library only, so that the demo asks nothing more of a machine than the program does.
"""
import argparse
import struct
import sys
import zlib

GAP = 8  # pixels around each picture
GREY = 32


def read_png(path):
    """(width, height, rows of RGB bytes)."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path}: not a PNG file")
    packed, at = b"", 8
    while at < len(data):
        (length,) = struct.unpack_from(">I", data, at)
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
            if depth != 8 or colour not in (2, 6) or interlace:
                raise ValueError(f"{path}: only 8-bit RGB and RGBA without interlacing")
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    n = 3 if colour == 2 else 4
    stride = width * n
    raw, rows, above = zlib.decompress(packed), [], bytes(stride)
    for y in range(height):
        begin = y * (stride + 1)
        above = unfilter(raw[begin], bytearray(raw[begin + 1 : begin + 1 + stride]), above, n)
        rows.append(bytes(above) if n == 3 else b"".join(above[i : i + 3] for i in range(0, stride, 4)))
    return width, height, rows


def unfilter(kind, row, above, n):
    """Undoes one of PNG's five predictors (ISO/IEC 15948, 9.2) in place; n bytes a pixel."""
    if kind == 1:
        for i in range(n, len(row)):
            row[i] = (row[i] + row[i - n]) & 255
    elif kind == 2:
        for i in range(len(row)):
            row[i] = (row[i] + above[i]) & 255
    elif kind == 3:
        for i in range(len(row)):
            row[i] = (row[i] + ((row[i - n] if i >= n else 0) + above[i]) // 2) & 255
    elif kind == 4:
        for i in range(len(row)):
            a, b, c = (row[i - n], above[i], above[i - n]) if i >= n else (0, above[i], 0)
            pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            row[i] = (row[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255
    return row


def write_png(path, width, rows):
    """Writes rows of RGB bytes."""

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + row for row in rows), 6)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b""))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sheet", metavar="OUT.png", help="the sheet to write")
    parser.add_argument("pictures", metavar="IN.png", nargs="+", help="the pictures, from left to right")
    arguments = parser.parse_args()
    pictures = [read_png(path) for path in arguments.pictures]
    width, height = pictures[0][:2]
    if any(picture[:2] != (width, height) for picture in pictures):
        print("contact_sheet: the pictures differ in size", file=sys.stderr)
        return 2
    gap = bytes([GREY]) * (3 * GAP)
    total = len(pictures) * (width + GAP) + GAP
    margin = [bytes([GREY]) * (3 * total)] * GAP
    rows = [gap + b"".join(rows[y] + gap for _, _, rows in pictures) for y in range(height)]
    write_png(arguments.sheet, total, margin + rows + margin)
    return 0


if __name__ == "__main__":
    sys.exit(main())
