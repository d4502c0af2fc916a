#!/usr/bin/env python3
"""The comparison of pictures: versions of cairo write the same picture differently, and every change of a picture is found."""
import base64
import itertools
import re
import unittest
import zlib

import pictures


def chunk(kind, data):
    return len(data).to_bytes(4, "big") + kind + data + zlib.crc32(kind + data).to_bytes(4, "big")


def png(rows):
    """A PNG with these rows of greys."""
    head = len(rows[0]).to_bytes(4, "big") + len(rows).to_bytes(4, "big") + bytes([8, 0, 0, 0, 0])
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + bytes(r) for r in rows))) + chunk(b"IEND", b"")


def image(rows):
    return "data:image/png;base64," + base64.b64encode(png(rows)).decode()


IMAGE = image([[0, 255], [255, 0]])
HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
# Parts of the same picture, as two versions write them.
CAIRO_1_16 = f"""{HEAD} width="651pt" height="324pt" viewBox="0 0 651 324" version="1.1">
<defs>
<g>
<symbol overflow="visible" id="glyph0-0"><path style="stroke:none;" d="M 0.5 1.75 Z M 0.5 1.75 "/></symbol>
<symbol overflow="visible" id="glyph0-1"><path style="stroke:none;" d="M 7.5 -0.5 L 6.3125 0 Z M 7.5 -0.5 "/></symbol>
<symbol overflow="visible" id="glyph0-2"><path style="stroke:none;" d="M 1 -6.25 L 2.90625 0 Z M 1 -6.25 "/></symbol>
</g>
<clipPath id="clip0">
  <path d="M 63 57 L 633 57 L 633 286.5 Z M 63 57 "/>
</clipPath>
<image id="image0" width="2" height="2" xlink:href="{IMAGE}"/>
<pattern id="pattern1" patternUnits="userSpaceOnUse" width="2" height="2" patternTransform="matrix(0.75,0,0,0.75,63,46.5)"><use xlink:href="#image0"/></pattern>
</defs>
<g id="surface2">
<rect x="0" y="0" width="651" height="324" style="fill:rgb(100%,100%,100%);fill-opacity:1;stroke:none;"/>
<g style="fill:rgb(0%,0%,0%);fill-opacity:1;">
  <use xlink:href="#glyph0-1" x="9" y="16.5"/>
  <use xlink:href="#glyph0-2" x="17.256226" y="16.5"/>
</g>
<path style=" stroke:none;fill-rule:nonzero;fill:url(#pattern1);" d="M 63 46.5 L 633 46.5 L 633 190.5 Z M 63 46.5 "/>
<g clip-path="url(#clip0)" clip-rule="nonzero">
<path style="fill:none;stroke-width:1.6;stroke:rgb(0%,44.705882%,69.803922%);stroke-opacity:1;" d="M 84 382 L 96.880208 77.239583 " transform="matrix(0.75,0,0,0.75,0,0)"/>
</g>
<path style=" stroke:none;fill-rule:nonzero;fill:rgb(25%,32%,45%);fill-opacity:1;" d="M 615.375 190.5 C 615.375 193 611.625 193 611.625 190.5 "/>
</g>
</svg>"""
CAIRO_1_18 = f"""{HEAD} width="651" height="324" viewBox="0 0 651 324">
<defs>
<g>
<g id="glyph-0-0"><path d="M 7.5 -0.5 L 6.3125 0 Z M 7.5 -0.5 "/></g>
<g id="glyph-0-1"><path d="M 1 -6.25 L 2.90625 0 Z M 1 -6.25 "/></g>
</g>
<image id="source-1" x="0" y="0" width="2" height="2" xlink:href="{IMAGE}"/>
<clipPath id="clip-0">
<path clip-rule="nonzero" d="M 63 46.5 L 633 46.5 L 633 190.5 Z M 63 46.5 "/>
</clipPath>
<clipPath id="clip-1">
<path clip-rule="nonzero" d="M 63 57 L 633 57 L 633 286.5 Z M 63 57 "/>
</clipPath>
</defs>
<rect x="-65.1" y="-32.4" width="781.2" height="388.8" fill="rgb(100%, 100%, 100%)" fill-opacity="1"/>
<g fill="rgb(0%, 0%, 0%)" fill-opacity="1">
<use xlink:href="#glyph-0-0" x="9" y="16.5"/>
<use xlink:href="#glyph-0-1" x="17.256227" y="16.5"/>
</g>
<g clip-path="url(#clip-0)">
<use xlink:href="#source-1" transform="matrix(0.75, 0, 0, 0.75, 63, 46.5)"/>
</g><g clip-path="url(#clip-1)">
<path fill="none" stroke-width="1.6" stroke="rgb(0%, 44.705882%, 69.803922%)" stroke-opacity="1" d="M 84 382 L 96.880208 77.239583 " transform="matrix(0.75, 0, 0, 0.75, 0, 0)"/>
</g>
<path fill-rule="nonzero" fill="rgb(25%, 32%, 45%)" fill-opacity="1" d="M 615.375 190.5 C 615.375 193 611.625 193 611.625 190.5 "/>
</svg>"""


class Svg(unittest.TestCase):
    def test_what_two_versions_draw_is_the_same(self):
        self.assertIsNone(pictures.svg_difference(CAIRO_1_16, CAIRO_1_18))
        self.assertEqual([shape.split(":")[0] for shape in pictures.shapes(CAIRO_1_18)], "page ground letter letter image path path".split())

    def test_every_change_is_found(self):
        changes = [
            ("0 0 651 324", "0 0 651 330"),  # the page
            ("M 84 382", "M 84 383"),
            ("96.880208", "96.9"),
            ("L 96.880208 77.239583 ", ""),
            (r"(stroke-width\W+)1.6", r"\g<1>1.7"),  # a line
            ("44.705882", "44.8"),
            (r"(stroke-opacity\W+)1", r"\g<1>0.5"),
            ("25%", "26%"),
            ("100%", "99%"),  # colours
            ("M 615.375", "M 616"),
            ("C 615.375", "L 615.375"),  # an area
            ("17.256", "18.256"),
            ("7.5 -0.5 L", "7.5 -0.6 L"),  # a letter's place and shape
            (re.escape(IMAGE), image([[0, 255], [255, 9]])),
            (re.escape(IMAGE), image([[0, 255]])),
            (r"75, ?63", "75,64"),  # an image
            ("L 633 190.5", "L 634 190.5"),
            ("L 633 286.5", "L 634 286.5"),  # the areas to which an image and a line are clipped
        ]
        for svg, (old, new) in itertools.product((CAIRO_1_16, CAIRO_1_18), changes):
            with self.subTest(old=old[:60], new=new[:60]):
                changed, count = re.subn(old, new, svg, count=1)
                self.assertEqual(count, 1)
                for kept in (CAIRO_1_16, CAIRO_1_18):
                    self.assertIsNotNone(pictures.svg_difference(changed, kept))

    def test_another_letter_is_found(self):
        for svg, one, other in ((CAIRO_1_16, "#glyph0-2", "#glyph0-1"), (CAIRO_1_18, "#glyph-0-1", "#glyph-0-0")):
            self.assertIn("letter", pictures.svg_difference(svg.replace(one, other), CAIRO_1_16))

    def test_missing_and_moved_shapes_are_found(self):
        for svg in (CAIRO_1_16, CAIRO_1_18):
            area = next(line for line in svg.splitlines() if "615.375" in line)
            without = svg.replace(area, "")
            self.assertIn("nothing", pictures.svg_difference(without, svg))
            self.assertIn("nothing", pictures.svg_difference(svg, without))
            ground = next(line for line in svg.splitlines() if "<rect" in line)
            self.assertIsNotNone(pictures.svg_difference(without.replace(ground, ground + area), svg))

    def test_what_cannot_be_compared_is_refused(self):
        with self.assertRaisesRegex(ValueError, "circle"):
            list(pictures.shapes(CAIRO_1_18.replace("<rect", '<circle r="1"/><rect')))


class Png(unittest.TestCase):
    WHITE = [[255] * 100 for _ in range(40)]

    def changed(self, width, height, by):
        return png([[255 - by if x < width and y < height else 255 for x in range(100)] for y in range(40)])

    def test_two_rounded_edges_are_the_same(self):
        self.assertIsNone(pictures.png_difference(self.changed(2, 1, 16), png(self.WHITE)))

    def test_changes_of_colour_and_size_are_found(self):
        self.assertIn("1 of 100 x 40 pixels differ, the most by 17", pictures.png_difference(self.changed(1, 1, 17), png(self.WHITE)))
        self.assertIn("3 of 100 x 40 pixels differ", pictures.png_difference(self.changed(3, 1, 1), png(self.WHITE)))
        self.assertIn("100 x 40 pixels are drawn and not 100 x 39", pictures.png_difference(png(self.WHITE), png(self.WHITE[1:])))

    def test_all_filters_of_rows_are_read(self):
        rows = [[(7 * x * y + x) % 256 for x in range(9)] for y in range(5)]
        data = b""
        for y, row in enumerate(rows):  # filter y: none, left, above, mean, Paeth
            above = rows[y - 1] if y else [0] * 9
            data += bytes([y])
            for x, v in enumerate(row):
                a, b, c = (row[x - 1], above[x], above[x - 1]) if x else (0, above[x], 0)
                paeth = min((a, b, c), key=lambda v: abs(a + b - c - v))
                data += bytes([(v - (0, a, b, (a + b) // 2, paeth)[y]) % 256])
        plain = png(rows)
        at = plain.index(b"IDAT") - 4
        self.assertEqual(pictures.pixels(plain[:at] + chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b"")), ([bytes(r) for r in rows], 1))


class Gif(unittest.TestCase):
    def test_frames_are_counted_and_not_what_looks_like_one(self):
        frame = b"\x21\xf9\x04\0\0\0\0\0" + b"\x2c" + bytes(8) + b"\0" + b"\x02" + b"\x05\x21\xf9\x04\x2c\x3b" + b"\0"
        film = b"GIF89a" + b"\2\0\1\0" + b"\x80\0\0" + bytes(6) + 3 * frame
        self.assertEqual(pictures.frames(film + b";"), 3)
        self.assertIsNone(pictures.gif_difference(film + b";", film.replace(b"\x04\x2c\x3b\0", b"\x04\x2c\x3c\0") + b";"))
        self.assertEqual(pictures.gif_difference(film + frame + b";", film + b";"), "4 frames are drawn and not 3")
        self.assertEqual(pictures.gif_difference(film + b";", film.replace(b"\2\0\1\0", b"\3\0\1\0") + b";"), "a film of another size is drawn")


if __name__ == "__main__":
    unittest.main()
