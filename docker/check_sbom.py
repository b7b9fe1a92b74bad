"""Checks that the bills of materials in target/sbom are CycloneDX's JSON, whole in themselves, and name what the crates in
the binary and the page depend on directly, as cargo and package.json tell it. check_sbom.py [TARGET]"""

import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def bill(name: str) -> dict[str, str]:
    """The components of a bill by their names, with their versions; of one that is there twice, both."""
    content = json.loads((ROOT / "target/sbom" / name).read_text())
    if content["bomFormat"] != "CycloneDX" or not re.fullmatch(r"1\.\d", content["specVersion"]):
        sys.exit(f"{name} is no bill of CycloneDX")
    components = [content["metadata"]["component"], *content["components"]]
    references = [component["bom-ref"] for component in components]
    if len(set(references)) != len(references):
        sys.exit(f"{name} has a component twice")
    named = {reference for entry in content["dependencies"] for reference in [entry["ref"], *entry["dependsOn"]]}
    if unknown := named - set(references):
        sys.exit(f"{name} has no component for {', '.join(sorted(unknown))}")
    versions: dict[str, str] = {}
    for component in components:
        full = "/".join(part for part in [component.get("group"), component["name"]] if part)
        versions[full] = f"{versions.get(full, '')} {component['version']}".strip()
    return versions


def binary(target: str) -> set[tuple[str, str]]:
    """What the crates of the workspace that are in the binary name themselves, without macros."""
    options = ["--locked", f"--target={target}", "--edges=normal,no-proc-macro", "--prefix=none"]

    def tree(*arguments: str) -> str:
        command = ["cargo", "tree", *arguments, *options]
        return subprocess.run(command, cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE).stdout

    crates = set(re.findall(r"^(verne-\S+) v", tree("-p", "verne-service"), re.MULTILINE))
    packages = [argument for crate in sorted(crates) for argument in ("-p", crate)]
    found = set(re.findall(r"^(\S+) v(\S+)", tree(*packages, "--depth=1"), re.MULTILINE))
    # The bill is its own.
    return {("verne" if name == "verne-service" else name, version) for name, version in found}


def packages(directory: str) -> set[tuple[str, str]]:
    """What an npm package names itself."""
    package = json.loads((ROOT / directory / "package.json").read_text())
    return {(name, "") for kind in ("dependencies", "devDependencies") for name in package.get(kind, {})}


def main() -> None:
    target = sys.argv[1] if len(sys.argv) > 1 else "x86_64-unknown-linux-gnu"
    page, client = packages("src/viewer"), packages("clients/typescript")
    for name, direct in (("verne.json", binary(target)), ("viewer.json", page), ("client.json", client)):
        versions = bill(name)
        missing = {
            dependency
            for dependency, version in direct
            if dependency not in versions or (version and version not in versions[dependency].split())
        }
        if missing or len(direct) < 5:
            sys.exit(f"{name} says nothing of {', '.join(sorted(missing)) or 'anything'}")
        print(f"{name}: {len(direct)} direct dependencies among {len(versions)} names")


if __name__ == "__main__":
    main()
