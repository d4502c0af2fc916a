"""Compares a drawn picture with the one that is kept, whichever version of cairo drew each of them.

In an SVG, each path, letter and image counts, in their order, with colours, widths and coordinates: versions write them in other words. In a
PNG, each pixel counts; versions round the edges of long lines differently. In a GIF, the size and the number of frames count.
The letters are those of DejaVu Sans, which ./tools/setup installs.
"""
import base64
import itertools
import re
import shutil
import xml.etree.ElementTree as ElementTree
import zlib

NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
ROUNDING = 0.01  # of the coordinates of an SVG, in points, and of its colours, in percent
SHADE = 16  # the largest change of a pixel of a PNG, of 255
EDGES = 0.0005  # the share of its pixels that may change so little
USUAL = {("stroke", "none"), ("fill-rule", "nonzero"), ("clip-rule", "nonzero")}  # only some versions write them


def check(test, drawn, kept, remedy, rewrite=False):
    """Fails the test when the pictures in two files differ. With `rewrite`, the kept one becomes the drawn one instead."""
    found = difference(drawn, kept) if kept.exists() else "there is none"
    if found and rewrite:
        kept.parent.mkdir(exist_ok=True)
        shutil.copy(drawn, kept)
    elif found:
        test.fail(f"{kept.name}: {found}\n{remedy}")


def difference(drawn, kept):
    """What differs in two files of one format, or None."""
    if drawn.suffix != kept.suffix:
        return f"a {drawn.suffix} is drawn"
    of = {".svg": svg_difference, ".png": png_difference, ".gif": gif_difference}[kept.suffix]
    return of(drawn.read_bytes(), kept.read_bytes())


def svg_difference(drawn, kept):
    for a, b in itertools.zip_longest(shapes(drawn), shapes(kept), fillvalue="nothing"):
        numbers = zip(*(map(float, NUMBER.findall(line)) for line in (a, b)))
        if NUMBER.sub("0", a) != NUMBER.sub("0", b) or any(abs(x - y) > ROUNDING for x, y in numbers):
            return f"drawn is\n  {a}\nand not\n  {b}"
    return None


def shapes(svg):
    """A line for each path, letter and image of a file of cairo, in the order in which they are drawn."""
    root = ElementTree.fromstring(svg)
    named = {f"#{element.get('id')}": element for element in root.iter()}
    for element in root.iter():
        element.tag = element.tag.split("}")[-1]
        attributes = [(name.split("}")[-1], value) for name, value in element.attrib.items() if name not in ("id", "style")]
        attributes += re.findall(r"([\w-]+):([^;]+)", element.get("style", ""))
        element.attrib = dict(pair for name, value in attributes if (pair := (name, " ".join(value.replace(",", " ").split()))) not in USUAL)

    def meant(url):
        return named[url.removeprefix("url(").removesuffix(")")]

    def line(what, look):
        return f"{what}: " + "; ".join(f"{name} {value}" for name, value in sorted(look.items()))

    def image(source, area, transform):
        pixels_of = pixels(base64.b64decode(source.get("href").split()[-1]))[0]
        return line("image", {"area": area, "transform": transform, "pixels": f"{len(pixels_of)} rows {zlib.crc32(b''.join(pixels_of))}"})

    def drawn(element, above):
        look = above | element.attrib
        if "clip-path" in element.attrib:
            look["clip-path"] = above.get("clip-path", "") + meant(look["clip-path"])[0].get("d")
        if element.tag == "g":
            for child in element:
                yield from drawn(child, look)
        elif element.tag == "rect":  # the ground; before 1.18 it is as large as the page, from then on larger
            x, y, width, height = (float(look.pop(name)) for name in ("x", "y", "width", "height"))
            left, top, right, bottom = map(float, root.get("viewBox").split())
            yield line("ground", look | {"d": f"{max(x, left)} {max(y, top)} {min(x + width, right)} {min(y + height, bottom)}"})
        elif element.tag == "path" and "url" in look.get("fill", ""):  # an image, before 1.18
            pattern = meant(look["fill"])
            yield image(meant(pattern[0].get("href")), look["d"], pattern.get("patternTransform"))
        elif element.tag == "path":
            yield line("path", look)
        elif element.tag == "use" and meant(look["href"]).tag == "image":
            yield image(meant(look["href"]), look["clip-path"], look["transform"])
        elif element.tag == "use":
            outlines = [path.get("d", "") for path in meant(look.pop("href")).iter("path")]
            yield line("letter", look | {"d": " ".join(outlines)})
        elif element.tag != "defs":
            raise ValueError(f"cannot compare the element '{element.tag}' of an SVG")

    yield f"page: {root.get('viewBox')}"
    for child in root:
        yield from drawn(child, {})


def png_difference(drawn, kept):
    if drawn == kept:
        return None
    (a, channels), (b, _) = pixels(drawn), pixels(kept)
    sizes = [(len(rows[0]) // channels, len(rows)) for rows in (a, b)]
    if sizes[0] != sizes[1]:
        return "{} x {} pixels are drawn and not {} x {}".format(*sizes[0], *sizes[1])
    changes = [
        max(abs(p - q) for p, q in zip(one[x : x + channels], other[x : x + channels]))
        for one, other in zip(a, b)
        if one != other
        for x in range(0, len(one), channels)
    ]
    count = sum(change > 0 for change in changes)
    if max(changes, default=0) > SHADE or count > EDGES * sizes[0][0] * sizes[0][1]:
        return f"{count} of {sizes[0][0]} x {sizes[0][1]} pixels differ, the most by {max(changes)} of 255"
    return None


def pixels(png):
    """The rows of a picture, bytes for each, and the number of bytes per pixel."""
    data, at = b"", 8
    while at < len(png):
        size, kind = int.from_bytes(png[at : at + 4], "big"), png[at + 4 : at + 8]
        if kind == b"IHDR":
            width, channels = int.from_bytes(png[at + 8 : at + 12], "big"), {0: 1, 2: 3, 4: 2, 6: 4}[png[at + 17]]
        if kind == b"IDAT":
            data += png[at + 8 : at + 8 + size]
        at += 12 + size
    data, stride, rows, above = zlib.decompress(data), width * channels, [], bytes(width * channels)
    for start in range(0, len(data), stride + 1):
        kind, row = data[start], bytearray(data[start + 1 : start + 1 + stride])
        for i in range(stride) if kind else []:
            a, b, c = (row[i - channels], above[i], above[i - channels]) if i >= channels else (0, above[i], 0)
            near = sorted((abs(a + b - c - v), n) for n, v in enumerate((a, b, c)))[0][1] if kind == 4 else 0
            row[i] = (row[i] + (0, a, b, (a + b) // 2, (a, b, c)[near])[kind]) & 255
        rows.append(above := bytes(row))
    return rows, channels


def gif_difference(drawn, kept):
    if drawn[6:10] != kept[6:10]:
        return "a film of another size is drawn"
    return None if frames(drawn) == frames(kept) else f"{frames(drawn)} frames are drawn and not {frames(kept)}"


def frames(gif):
    """The number of frames of a film."""

    def after_colours(at, flags):
        return at + (3 << (flags % 8 + 1) if flags & 0x80 else 0)

    count, at = 0, after_colours(13, gif[10])
    while gif[at] != 0x3B:
        if gif[at] == 0x2C:
            count, at = count + 1, after_colours(at + 10, gif[at + 9]) + 1
        else:  # an extension
            at += 2
        while gif[at]:
            at += gif[at] + 1
        at += 1
    return count
