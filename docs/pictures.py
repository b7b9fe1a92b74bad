"""Draws workspaces from the files that `verne workspace` writes, coloured by what limits them.

    verne workspace --kind platform -o platform.glb
    verne workspace --kind part --tool-length 50 -o part.glb
    python docs/pictures.py platform.glb part.glb

writes docs/platform.png and docs/part.png. Needs trimesh and matplotlib.
"""

import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import trimesh
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, MultipleLocator
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

ELEVATION, AZIMUTH = 20, -52
LIGHT = np.array([0.35, -0.75, 0.65]) / np.linalg.norm([0.35, -0.75, 0.65])


def read(path):
    """Corners of the triangles (mm, third axis up), their tags, and what the file says about itself."""
    scene = trimesh.load_scene(path, process=False)
    corners, tags = [], []
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        part = scene.geometry[name]
        x, y, z = trimesh.transform_points(part.vertices, transform).T * 1000
        corners.append(np.column_stack([x, -z, y])[part.faces])
        palette = part.metadata["palette"]
        tag = [swatch["name"] for swatch in palette].index(part.visual.material.name)
        tags.append(np.full(len(part.faces), tag))
    return np.concatenate(corners), np.concatenate(tags), palette, scene.metadata


def seams(corners, tags):
    """The edges between two tags."""
    edges = {}
    for triangle, tag in zip(np.round(corners, 1), tags):
        for a, b in ((0, 1), (1, 2), (2, 0)):
            edges.setdefault(frozenset((tuple(triangle[a]), tuple(triangle[b]))), []).append(tag)
    return [sorted(edge) for edge, sides in edges.items() if len(set(sides)) > 1 and len(edge) == 2]


def facing(normals):
    """Which triangles show their outer side."""
    elevation, azimuth = np.radians([ELEVATION, AZIMUTH])
    eye = [np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)]
    return normals @ eye > 0


def draw(path, picture):
    corners, tags, palette, about = read(path)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    seen = facing(normals)
    paint = np.array([swatch["rgb"] for swatch in palette]) / 255
    light = 0.62 + 0.38 * np.clip(normals @ LIGHT, 0, 1)
    colours = paint[tags] * light[:, None]

    figure = plt.figure(figsize=(7.6, 5.6), dpi=98)
    axes = figure.add_axes((-0.04, 0.0, 0.78, 1.0), projection="3d", proj_type="ortho", computed_zorder=False)
    axes.add_collection3d(Poly3DCollection(corners[seen], facecolors=colours[seen], edgecolors=colours[seen], linewidths=0.3))
    outline = seams(corners[seen], tags[seen])
    axes.add_collection3d(Line3DCollection(outline, colors="#222222", linewidths=0.7, zorder=3))
    least, greatest = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    # In the base frame y and z are shown reversed, so that z points down and the frame stays right-handed.
    base = about["frame"] == "base"
    names = ("x", "y", "z (down)") if base else ("x", "y", "z (up)")
    for axis, name, low, high in zip("xyz", names, least, greatest):
        getattr(axes, f"set_{axis}lim")(low, high)
        getattr(axes, f"set_{axis}label")(f"{name}, mm", labelpad=6)
        ticks = getattr(axes, f"{axis}axis")
        ticks.set_major_locator(MultipleLocator(200))
        ticks.set_pane_color((0.97, 0.97, 0.97))
        if base and axis != "x":
            ticks.set_major_formatter(FuncFormatter(lambda value, _: f"{0 - value:.0f}"))
    axes.tick_params(labelsize=7)
    axes.set_box_aspect(greatest - least, zoom=0.95)
    axes.view_init(ELEVATION, AZIMUTH)
    invented = "; dimensions invented" if about["machine"]["name"] == "verne" else ""
    request = ", ".join(f"{name} {value:g}" for name, value in about["request"].items() if name != "kind")
    figure.text(0.03, 0.95, f"{about['kind'].capitalize()} workspace of “{about['machine']['name']}”", fontsize=12)
    figure.text(0.03, 0.915, f"{request}; {len(corners)} triangles{invented}", fontsize=8, color="#555555")
    patches = [Patch(facecolor=colour, label=swatch["name"].replace("_", " ")) for colour, swatch in zip(paint, palette)]
    figure.legend(handles=patches, loc="center right", fontsize=7.5, frameon=False, title="limited by", title_fontsize=9)
    figure.savefig(picture)
    plt.close(figure)


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("files", nargs="+", type=pathlib.Path)
for file in parser.parse_args().files:
    target = pathlib.Path(__file__).parent / f"{file.stem}.png"
    draw(file, target)
    print(f"{target}: {target.stat().st_size // 1024} kB")
