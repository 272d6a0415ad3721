"""Small tileable textures as indexed PNG: a field of numbers in [0, 1] and a ramp of linear colours.

The deflate stream is written as stored blocks, so that the bytes do not depend on which zlib is installed.
"""

import math
import random
import struct
import zlib


def srgb_byte(linear):
    """IEC 61966-2-1, rounded: base-colour textures are sRGB in glTF."""
    value = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
    return max(0, min(255, int(255 * value + 0.5)))


def ramp_palette(ramp):
    """256 sRGB entries along a ramp of (place, (r, g, b)) with places rising from 0 to 1, linear in between."""
    palette = bytearray()
    for entry in range(256):
        place = entry / 255
        for (low, dark), (high, light) in zip(ramp, ramp[1:]):
            if place <= high:
                t = (place - low) / (high - low)
                palette += bytes(srgb_byte(a + (b - a) * t) for a, b in zip(dark, light))
                break
    return bytes(palette)


def indexed_png(size, field, ramp):
    """field(x, y) for integer texels; the image is square."""
    rows = bytearray()
    for y in range(size):
        rows.append(0)  # filter: none
        rows += bytes(max(0, min(255, int(255 * field(x, y) + 0.5))) for x in range(size))
    stream = bytearray(b"\x78\x01")
    for start in range(0, len(rows), 65535):
        block = rows[start : start + 65535]
        stream += struct.pack("<BHH", start + 65535 >= len(rows), len(block), 0xFFFF ^ len(block)) + block
    stream += struct.pack(">I", zlib.adler32(rows))
    chunks = [
        (b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 3, 0, 0, 0)),
        (b"PLTE", ramp_palette(ramp)),
        (b"IDAT", bytes(stream)),
        (b"IEND", b""),
    ]
    png = b"\x89PNG\r\n\x1a\n"
    for kind, data in chunks:
        png += struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return png


def tileable_noise(size, cells, seed):
    """Value noise in [0, 1] on a torus of cells x cells lattice points, smoothly interpolated; rows of texels."""
    source = random.Random(seed)
    lattice = [[source.random() for _ in range(cells)] for _ in range(cells)]
    rows = []
    for y in range(size):
        v = y * cells / size
        j, fy = int(v), smooth(v - int(v))
        row = []
        for x in range(size):
            u = x * cells / size
            i, fx = int(u), smooth(u - int(u))
            top = lattice[j][i] * (1 - fx) + lattice[j][(i + 1) % cells] * fx
            bottom = lattice[(j + 1) % cells][i] * (1 - fx) + lattice[(j + 1) % cells][(i + 1) % cells] * fx
            row.append(top * (1 - fy) + bottom * fy)
        rows.append(row)
    return rows


def smooth(t):
    return t * t * (3 - 2 * t)


def asphalt(size=256):
    """Dark stone chips in bitumen, with broad worn patches. One repeat is meant for 4 m."""
    chips, grit, worn = (tileable_noise(size, n, seed) for n, seed in ((size // 2, 11), (size // 5, 12), (5, 13)))
    ramp = [(0.0, (0.018, 0.019, 0.021)), (0.6, (0.045, 0.046, 0.048)), (1.0, (0.11, 0.108, 0.102))]

    def field(x, y):
        return 0.45 * chips[y][x] + 0.25 * grit[y][x] + 0.4 * worn[y][x] - 0.05

    return ("asphalt", indexed_png(size, field, ramp))


def brick(size=256, columns=8, courses=24):
    """Running bond, each brick its own shade, pale joints. One repeat is meant for 2 m."""
    source = random.Random(21)
    shade = [[source.random() for _ in range(columns)] for _ in range(courses)]
    stain, grain = tileable_noise(size, 6, 22), tileable_noise(size, size // 2, 23)
    ramp = [(0.0, (0.16, 0.055, 0.035)), (0.5, (0.32, 0.13, 0.085)), (0.8, (0.46, 0.24, 0.17)), (1.0, (0.5, 0.46, 0.4))]

    def field(x, y):
        v = y * courses / size
        course = int(v)
        u = (x * columns / size + 0.5 * (course % 2)) % columns
        if v - course < 0.13 or u - int(u) < 0.045:
            return 0.86 + 0.12 * stain[y][x]
        return 0.62 * shade[course][int(u)] + 0.2 * stain[y][x] + 0.06 * grain[y][x]

    return ("brick", indexed_png(size, field, ramp))


def planks(size=256, boards=10):
    """Oak boards along v with offset butt joints and a grain. One repeat is meant for 2 m."""
    source = random.Random(31)
    shade = [source.random() for _ in range(boards)]
    joint = [source.random() for _ in range(boards)]
    streak, figure = tileable_noise(size, size // 2, 32), tileable_noise(size, 8, 33)
    ramp = [(0.0, (0.02, 0.012, 0.007)), (0.15, (0.1, 0.055, 0.028)), (1.0, (0.36, 0.22, 0.12))]

    def field(x, y):
        u = x * boards / size
        board = int(u)
        along = (y / size + joint[board]) % 1.0
        if u - board < 0.05 or along < 0.006:
            return 0.0
        grain = streak[(y // 24 + 7 * board) % size][x] + 0.6 * math.sin(6.283185 * (3 * figure[y][x] + u))
        return 0.34 + 0.36 * shade[board] + 0.16 * grain

    return ("planks", indexed_png(size, field, ramp))
