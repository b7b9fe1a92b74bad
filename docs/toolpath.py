"""Draws the path of a program: `python3 docs/toolpath.py dome.glb > dome.svg`. The file is one of /toolpath/{id}/path."""

import json
import math
import struct
import sys

WIDTH, HEIGHT, BORDER = 860, 420, 24
# The view: turned about z, then seen from above by this angle.
TURN, RISE = math.radians(-35), math.radians(38)
SHADES = 12


def read(path):
    """Feed and rapid segments as pairs of points (m, y up), and a colour (0 to 1) for each point of a feed segment."""
    data = open(path, "rb").read()
    length = struct.unpack_from("<I", data, 12)[0]
    document, start = json.loads(data[20:20 + length]), 28 + length

    def values(number):
        accessor = document["accessors"][number]
        view = document["bufferViews"][accessor["bufferView"]]
        kind = {5123: "H", 5125: "I", 5126: "f"}[accessor["componentType"]]
        item = kind * {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        offset = start + view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        step = view.get("byteStride", struct.calcsize("<" + item))
        return [struct.unpack_from("<" + item, data, offset + i * step) for i in range(accessor["count"])]

    parts = {}
    for part in document["meshes"][0]["primitives"]:
        points = values(part["attributes"]["POSITION"])
        numbers = [number for number, in values(part["indices"])]
        colours = values(part["attributes"]["COLOR_0"]) if "COLOR_0" in part["attributes"] else None
        parts[document["materials"][part["material"]]["name"]] = (points, colours, list(zip(numbers[::2], numbers[1::2])))
    return parts


def project(point):
    """A point as seen from the side: x to the right, y down."""
    x, up, back = point
    x, back = x * math.cos(TURN) - back * math.sin(TURN), x * math.sin(TURN) + back * math.cos(TURN)
    return x, back * math.sin(RISE) - up * math.cos(RISE)


def svg_colour(colour):
    """The sRGB colour of a linear one, in a few shades so that segments of one shade are one path."""
    shaded = [round(value / 65535 * SHADES) / SHADES for value in colour]
    srgb = [12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055 for v in shaded]
    return "#" + "".join(f"{round(255 * v):02x}" for v in srgb)


def main():
    parts = read(sys.argv[1])
    flat = {name: [project(point) for point in points] for name, (points, _, _) in parts.items()}
    xs, ys = zip(*(point for points in flat.values() for point in points))
    scale = min((WIDTH - 2 * BORDER) / (max(xs) - min(xs)), (HEIGHT - 2 * BORDER) / (max(ys) - min(ys)))
    left = (WIDTH - scale * (max(xs) + min(xs))) / 2
    top = (HEIGHT - scale * (max(ys) + min(ys))) / 2
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" fill="none" stroke-width="1.7">')
    print(f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#39414d"/>')
    for name, (_, colours, segments) in sorted(parts.items(), reverse=True):
        lines, last = {}, None
        for a, b in segments:
            colour = svg_colour(colours[b]) if colours else "#9aa5b1"
            line = lines.setdefault(colour, [])
            (xa, ya), (xb, yb) = flat[name][a], flat[name][b]
            if last != (colour, a):
                line.append(f"M{left + scale * xa:.1f} {top + scale * ya:.1f}")
            line.append(f"L{left + scale * xb:.1f} {top + scale * yb:.1f}")
            last = (colour, b)
        style = "" if colours else ' stroke-dasharray="3 4" stroke-width="0.8"'
        for colour, line in lines.items():
            print(f'<path stroke="{colour}"{style} d="{"".join(line)}"/>')
    print("</svg>")


if __name__ == "__main__":
    main()
