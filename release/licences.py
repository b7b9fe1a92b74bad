#!/usr/bin/env python3
"""Prints the licences of other authors' packages in the binary for TARGET: licences.py TARGET. These are the crates that
docker/sbom lists, and the npm packages whose code is in the viewer. For each it prints the texts that the package
contains; a package without a text names its licence."""

import importlib.machinery
import importlib.util
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TEXTS = re.compile(r"(?i)^(licen[cs]e|copying|notice|unlicense|copyright)")


def linked_packages(target: str) -> list[dict]:
    """The crates in the binary, without this project's."""
    loader = importlib.machinery.SourceFileLoader("sbom", str(ROOT / "docker/sbom"))
    sbom = importlib.util.module_from_spec(importlib.util.spec_from_loader("sbom", loader))
    # No file beside docker/sbom.
    sys.dont_write_bytecode = True
    loader.exec_module(sbom)
    command = ["cargo", "metadata", "--format-version=1", "--locked", f"--filter-platform={target}"]
    metadata = json.loads(subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout)
    used = sbom.linked(metadata)
    return [package for package in metadata["packages"] if package["id"] in used and package["source"]]


def viewer_packages() -> list[Path]:
    """The npm packages that the viewer and its client need at run time."""
    packages = []
    for directory in ("src/viewer", "clients/typescript"):
        lock = json.loads((ROOT / directory / "package-lock.json").read_text())
        for path, entry in lock["packages"].items():
            if path.startswith("node_modules/") and not entry.get("dev") and not entry.get("link"):
                packages.append(ROOT / directory / path)
    return packages


def texts(directory: Path) -> list[str]:
    files = sorted(path for path in directory.iterdir() if path.is_file() and TEXTS.match(path.name))
    return [path.read_text(errors="replace").replace("\r\n", "\n").strip() for path in files]


def main() -> None:
    # A text that many packages contain is printed once, below the names of all of them.
    packages_of: dict[str, list[str]] = {}
    for package in linked_packages(sys.argv[1]):
        name = f"{package['name']} {package['version']} ({package['license'] or 'see the text'})"
        for text in texts(Path(package["manifest_path"]).parent) or ["The package contains no text."]:
            packages_of.setdefault(text, []).append(name)
    for directory in viewer_packages():
        package = json.loads((directory / "package.json").read_text())
        name = f"{package['name']} {package['version']} ({package.get('license', 'see the text')}, npm)"
        for text in texts(directory) or ["The package contains no text."]:
            packages_of.setdefault(text, []).append(name)
    print("verne contains these packages of other authors, under these licences.")
    for text, names in sorted(packages_of.items(), key=lambda item: item[1]):
        print("\n" + "=" * 80)
        print("\n".join(sorted(set(names))))
        print("-" * 80)
        print(text)


if __name__ == "__main__":
    main()
