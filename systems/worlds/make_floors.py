#!/usr/bin/env python3
"""Paints the floors of the worlds: coloured discs on black, one PNG per floor model.

    make_floors.py            writes models/<floor>/materials/<floor>.png
    make_floors.py --check    compares the pixels of the files with the table below; exit status 1 if they differ

Change the table, run the script, and the robot's camera sees the new floor. Needs Python 3, nothing else.
"""

import pathlib
import struct
import sys
import zlib

BLACK = (0, 0, 0)
RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)
YELLOW, CYAN, MAGENTA = (255, 255, 0), (0, 255, 255), (255, 0, 255)
LIME, ORANGE, VIOLET = (128, 255, 0), (255, 128, 0), (128, 0, 255)
AZURE, MINT, ROSE = (0, 128, 255), (0, 255, 128), (255, 0, 128)

PIXELS = 2000  # pictures are PIXELS x PIXELS: 4 mm a pixel on a floor of 8 m, 6 mm on 12 m

# floor: (side of the floor in m, radius of the patches in m, patches as (world x, world y, colour))
FLOORS = {
    "floor_basic": (
        8,
        0.2013,
        [(-1.49, 1.694, RED), (1.49, 1.694, GREEN), (0.0, 0.993, YELLOW), (-1.49, 0.204, CYAN), (1.49, 0.204, MAGENTA), (0.0, -0.497, BLUE)],
    ),
    "floor_ambiguous": (
        8,
        0.2013,
        [(-1.49, 1.694, RED), (1.49, 1.694, RED), (0.0, 0.993, RED), (-1.49, 0.204, CYAN), (1.49, 0.204, MAGENTA), (0.0, -0.497, BLUE)],
    ),
    "floor_open": (
        12,
        0.3065,
        [
            (-2.158, 3.065, LIME),
            (2.558, 2.984, BLUE),
            (-4.554, 1.475, ORANGE),
            (4.655, 1.474, GREEN),
            (-1.405, 0.952, MAGENTA),
            (1.492, 0.952, VIOLET),
            (-0.012, -1.247, AZURE),
            (-4.343, -1.548, MINT),
            (4.195, -1.847, ROSE),
            (-2.226, -2.939, YELLOW),
            (1.958, -3.074, CYAN),
        ],
    ),
}


def paint(side, radius, patches):
    """Returns the palette and the rows of palette indices, top row first.

    The picture lies on the floor like a map: top = +y, left = -x. A pixel belongs to a patch when its
    middle does.
    """
    palette = [BLACK] + sorted({colour for _, _, colour in patches})
    scale = PIXELS / side
    rows = [bytearray(PIXELS) for _ in range(PIXELS)]
    for x, y, colour in patches:
        column, row, reach = (x + side / 2) * scale, (side / 2 - y) * scale, radius * scale
        for r in range(int(row - reach), int(row + reach) + 1):
            for c in range(int(column - reach), int(column + reach) + 1):
                if (c + 0.5 - column) ** 2 + (r + 0.5 - row) ** 2 <= reach**2:
                    rows[r][c] = palette.index(colour)
    return palette, rows


def pack(rows):
    """The rows as PNG stores them: two pixels (4 bits each) a byte, each row as the difference to the one
    above (filter 2), which leaves little but zeros to compress."""
    data, above = bytearray(), bytes(PIXELS // 2)
    for row in rows:
        packed = bytes(left << 4 | right for left, right in zip(row[::2], row[1::2]))
        data.append(2)
        data += bytes((now - before) & 255 for now, before in zip(packed, above))
        above = packed
    return bytes(data)


def png(palette, data):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", PIXELS, PIXELS, 4, 3, 0, 0, 0)  # 4 bits a pixel, colours from a palette
    return (
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"PLTE", bytes(sum(palette, ()))) + chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b"")
    )


def same_picture(a, b):
    """Equal but for how the pixels are compressed, which may differ between versions of zlib."""

    def parts(image):
        at, found = 8, []
        while at < len(image):
            (size,) = struct.unpack(">I", image[at : at + 4])
            kind, body = image[at + 4 : at + 8], image[at + 8 : at + 8 + size]
            found.append((kind, zlib.decompress(body) if kind == b"IDAT" else body))
            at += 12 + size
        return found

    return parts(a) == parts(b)


def main():
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(__doc__)
    different = []
    for name, floor in FLOORS.items():
        file = pathlib.Path(__file__).resolve().parent / "models" / name / "materials" / (name + ".png")
        palette, rows = paint(*floor)
        image = png(palette, pack(rows))
        if not check:
            file.write_bytes(image)
            print(f"{name}: {len(image)} bytes")
        elif not file.exists() or not same_picture(image, file.read_bytes()):
            different.append(name)
    if different:
        sys.exit("not as painted: " + ", ".join(different))


if __name__ == "__main__":
    main()
