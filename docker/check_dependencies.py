"""Checks that every dependency the manifests name has its row in docs/dependencies.md."""

import json
import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def main() -> None:
    named = set()
    crates = [ROOT / "Cargo.toml", *ROOT.glob("src/*/Cargo.toml"), ROOT / "tests/Cargo.toml"]
    for manifest in [*crates, *ROOT.glob("tests/*/Cargo.toml")]:
        tables = tomllib.loads(manifest.read_text())
        for table in (tables.get("workspace", {}), tables):
            for kind in ("dependencies", "dev-dependencies", "build-dependencies"):
                named |= set(table.get(kind, {}))
    packages = [ROOT / "src/viewer/package.json", ROOT / "clients/typescript/package.json"]
    for manifest in [*packages, *ROOT.glob("tests/*/package.json")]:
        package = json.loads(manifest.read_text())
        named |= set(package.get("dependencies", {})) | set(package.get("devDependencies", {}))
    told = set(re.findall(r"[@\w/.-]+", (ROOT / "docs/dependencies.md").read_text()))
    missing = {name for name in named if not name.startswith("verne-")} - told
    if missing:
        sys.exit(f"docs/dependencies.md says nothing of {', '.join(sorted(missing))}")
    print(f"{len(named)} direct dependencies")


if __name__ == "__main__":
    main()
