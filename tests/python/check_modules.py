#!/usr/bin/env python3
"""Rejects import cycles between the modules of a crate, and imports against the order of the service's folders.

    check_modules.py [--root DIRECTORY] [--graph] [CRATE...]

The imports of a crate must form no cycle; rust_modules.py states what an import is. A folder of the service may import
only folders that stand before it in SERVICE_ORDER. No Rust file in src may have more than 300 lines, and no line more
than 120 characters.
"""

import argparse
import sys
import tomllib
from collections import deque
from pathlib import Path

from rust_modules import Crate

# Each folder of the service may import the folders to its left, and no others.
SERVICE_ORDER = ["wire", "limits", "telemetry", "operations", "http", "process"]

MOST_LINES = 300
MOST_CHARACTERS = 120


def shortest(edges, start, end):
    """The shortest way from one module to another, or nothing."""
    origin, queue = {start: None}, deque([start])
    while queue:
        module = queue.popleft()
        if module is end:
            way = []
            while module:
                way.append(module)
                module = origin[module]
            return way[::-1]
        for target in edges.get(module, ()):
            if target not in origin:
                origin[target] = module
                queue.append(target)
    return []


def cycles(edges):
    """For each import that lies on a cycle, the shortest such cycle; each cycle once, short ones first."""
    found = {}
    for module, targets in edges.items():
        for target in targets:
            if way := shortest(edges, target, module):
                first = min(range(len(way)), key=lambda i: repr(way[i]))
                way = way[first:] + way[:first]
                found[tuple(way)] = way
    return sorted(found.values(), key=lambda way: (len(way), repr(way)))


def crates(root):
    """Each member's name, the name of its library and the file of each target below src."""
    for member in tomllib.loads((root / "Cargo.toml").read_text())["workspace"]["members"]:
        directory = root / member
        if directory.parent == root / "src" and (directory / "Cargo.toml").exists():
            library = tomllib.loads((directory / "Cargo.toml").read_text())["package"]["name"].replace("-", "_")
            if (directory / "src/lib.rs").exists():
                yield directory.name, library, directory / "src/lib.rs"


def check_crate(name, library, file, root, graph):
    """The faults of a crate's imports."""
    crate = Crate(name, library, file)
    edges = crate.edges()
    found = cycles(edges)
    imports = sum(len(targets) for targets in edges.values())
    print(f"{name}: {len(crate.modules)} modules, {imports} imports, {len(found)} cycles")

    def at(module, target):
        file, line = edges[module][target]
        return f"    {file.relative_to(root)}:{line}: {module} -> {target}"

    every = [(module, target) for module, targets in edges.items() for target in targets]
    if graph:
        print(*sorted(at(*step) for step in every), sep="\n")
    for way in found:
        ring = [*way, way[0]]
        yield "\n".join([f"{name}: cycle {' -> '.join(map(repr, ring))}", *map(at, ring, ring[1:])])
    if name == "service":
        for folder in crate.root.children.keys() - set(SERVICE_ORDER):
            yield f"{name}: {folder} does not stand in SERVICE_ORDER"
        for module, target in every:
            here, there = module.folder(), target.folder()
            if {here, there} <= set(SERVICE_ORDER) and SERVICE_ORDER.index(here) < SERVICE_ORDER.index(there):
                yield f"{name}: {here} must not import {there}\n{at(module, target)}"


def check_files(root, names):
    """Files that are too long, and lines that are."""
    for file in sorted(root.glob("src/*/src/**/*.rs")):
        if names and file.relative_to(root).parts[1] not in names:
            continue
        lines = file.read_text().splitlines()
        if len(lines) > MOST_LINES:
            yield f"{file.relative_to(root)}: {len(lines)} lines, more than {MOST_LINES}"
        for number, line in enumerate(lines, 1):
            if len(line) > MOST_CHARACTERS:
                yield f"{file.relative_to(root)}:{number}: {len(line)} characters, more than {MOST_CHARACTERS}"


def main():
    parser = argparse.ArgumentParser(description="Checks the imports between modules, and the sizes of files.")
    parser.add_argument("--root", type=Path, help="directory of the workspace; else the current one")
    parser.add_argument("--graph", action="store_true", help="print every import")
    parser.add_argument("crate", nargs="*", help="name of a directory in src; else all of them")
    options = parser.parse_args()
    root = (options.root or Path.cwd()).resolve()
    faults = []
    for name, library, file in crates(root):
        if not options.crate or name in options.crate:
            faults += check_crate(name, library, file, root, options.graph)
    faults += check_files(root, options.crate)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
