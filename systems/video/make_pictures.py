#!/usr/bin/env python3
"""Paints the pictures of denoising.iqr: a bright disc that moves in a circle, with noise on every pixel.

    make_pictures.py [FOLDER]   writes noisy_disc/*.png beside this script, or into FOLDER
    make_pictures.py --clean FOLDER   writes the same pictures without noise
    make_pictures.py --check    compares the files with what this script paints; exit status 1 if they differ

Needs Python 3, nothing else. The noise is a sequence of pseudo-random numbers that is the same everywhere.
"""

import math
import pathlib
import struct
import sys
import zlib

WIDTH, HEIGHT, PICTURES = 48, 36, 40
DISC, GROUND = (230, 200, 60), (40, 60, 90)  # colours of disc and ground
RADIUS = 7  # of the disc, pixels
FLIPPED = 0.15  # part of the pixels that are replaced by noise


def noise(seed=1):
    """Numbers from 0 to 1 (a linear congruential generator)."""
    while True:
        seed = (6364136223846793005 * seed + 1442695040888963407) % 2**64
        yield (seed >> 40) / 2**24


def paint(clean=False):
    """The pictures, as rows of (red, green, blue)."""
    random = noise()
    for number in range(PICTURES):
        angle = 2 * math.pi * number / PICTURES
        x, y = WIDTH / 2 + 12 * math.cos(angle), HEIGHT / 2 + 8 * math.sin(angle)
        rows = []
        for r in range(HEIGHT):
            rows.append([])
            for c in range(WIDTH):
                colour = DISC if math.hypot(c + 0.5 - x, r + 0.5 - y) < RADIUS else GROUND
                flip, level = next(random), next(random)
                rows[-1].append(colour if clean or flip >= FLIPPED else (int(255 * level),) * 3)
        yield rows


def png(rows):
    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    pixels = b"".join(b"\0" + bytes(channel for pixel in row for channel in pixel) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(pixels, 9)) + chunk(b"IEND", b"")


def pixels(file):
    """The pixels of a file that png() wrote, which other versions of zlib compress to other bytes."""
    start = file.index(b"IDAT") + 4
    (size,) = struct.unpack(">I", file[start - 8 : start - 4])
    return zlib.decompress(file[start : start + size])


def main(arguments):
    folder = pathlib.Path(__file__).parent / "noisy_disc"
    check, clean = "--check" in arguments, "--clean" in arguments
    for a in arguments:
        if not a.startswith("--"):
            folder = pathlib.Path(a)
    folder.mkdir(exist_ok=True)
    differs = False
    for number, rows in enumerate(paint(clean)):
        file = folder / f"{number:03}.png"
        if not check:
            file.write_bytes(png(rows))
        elif pixels(file.read_bytes()) != pixels(png(rows)):
            print(f"{file} differs")
            differs = True
    return differs


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
