"""Reads mesh files with trimesh: closed, facing outwards, and of the right volume. PLY with meshio as well.

    python check_meshes.py [--volume MM3] [--tolerance REL] [--components N] FILE ...

GLB is in metres after its node's translation, the others in millimetres. Without --volume the files of one run
are compared with the first of them that is not empty. An empty mesh has no volume to compare: --volume 0 demands it.
Ends with 1 if anything is wrong.
"""

import argparse
import json
import pathlib
import sys

import meshio
import numpy as np
import trimesh

MILLIMETRES = {".glb": 1000.0, ".stl": 1.0, ".ply": 1.0, ".json": 1.0}


def read(path):
    """The file as one welded mesh in millimetres, or None if it holds no triangle."""
    if path.suffix == ".json":
        text = json.loads(path.read_text())
        vertices = np.reshape(np.asarray(text["positions"], float), (-1, 3))
        faces = np.reshape(np.asarray(text["indices"], int), (-1, 3))
        if len(faces) == 0:
            return None
        return trimesh.Trimesh(vertices, faces, process=False)
    if path.suffix == ".glb":
        scene = trimesh.load_scene(path)
        if not scene.geometry:
            return None
        for part in scene.geometry.values():
            if part.visual.material.name not in [swatch["name"] for swatch in part.metadata["palette"]]:
                raise ValueError("a material's name is not in the palette")
        mesh = scene.to_mesh()
        # Split along the creases for the sake of normals: weld what lies in one place.
        mesh.merge_vertices(merge_norm=True, merge_tex=True)
    else:
        mesh = trimesh.load_mesh(path)
        if path.suffix == ".ply":
            same_in_meshio(path, mesh)
        if len(getattr(mesh, "faces", ())) == 0:
            return None
        if path.suffix == ".stl":
            mesh.merge_vertices()
    mesh.apply_scale(MILLIMETRES[path.suffix])
    return mesh


def same_in_meshio(path, mesh):
    """Refuses a PLY file in which meshio and trimesh do not see the same, or whose comments do not cover the faces."""
    other = meshio.read(path)
    faces = np.reshape([cells.data for cells in other.cells], (-1, 3))
    seen = (np.reshape(mesh.vertices, (-1, 3)), np.reshape(mesh.faces, (-1, 3)))
    if not all(map(np.array_equal, (other.points, faces), seen)):
        raise ValueError("meshio and trimesh do not see the same")
    tags = other.point_data["tag"]
    for line in path.read_bytes().split(b"end_header")[0].decode().splitlines():
        if line.startswith("comment faces "):
            first, count, _, tag = line.split()[2:]
            # The tag of a vertex is the least of the faces around it.
            part, faces = faces[: int(count)], faces[int(count) :]
            if (tags[part] > int(tag)).any():
                raise ValueError(f"the faces from {first} on have a vertex of a greater tag than {tag}")
    if len(faces):
        raise ValueError("some faces have no tag")


def faults(mesh, wanted):
    """What is wrong with a mesh, as lines of text."""
    if not mesh.is_watertight:
        yield "is not watertight"
    if not mesh.is_winding_consistent:
        yield "faces now in, now out"
    if mesh.volume <= 0:
        yield f"encloses {mesh.volume:.9g} mm³: its triangles face inwards"
    if wanted.volume is not None and abs(mesh.volume - wanted.volume) > wanted.tolerance * abs(wanted.volume):
        yield f"encloses {mesh.volume:.9g} mm³ instead of {wanted.volume:.9g}"
    if wanted.components is not None and mesh.body_count != wanted.components:
        yield f"has {mesh.body_count} components instead of {wanted.components}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--volume", type=float, help="the volume wanted, mm³")
    parser.add_argument("--tolerance", type=float, default=1e-5, help="relative, of the volume (default 1e-5)")
    parser.add_argument("--components", type=int, help="the number of pieces wanted")
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    wanted = parser.parse_args()
    failed = False
    for path in wanted.files:
        mesh = read(path)
        if mesh is None:
            found = [] if not wanted.volume else [f"is empty instead of {wanted.volume:.9g} mm³"]
            print(f"{path}: empty")
        else:
            found = list(faults(mesh, wanted))
            wanted.volume = mesh.volume if wanted.volume is None else wanted.volume
            size = " × ".join(f"{extent:.6g}" for extent in mesh.extents)
            print(f"{path}: {len(mesh.faces)} triangles, {mesh.volume:.10g} mm³, {size} mm")
        for fault in found:
            print(f"  {path.name} {fault}")
        failed = failed or bool(found)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
