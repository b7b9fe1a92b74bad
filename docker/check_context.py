"""Checks that the image's build finds what it needs: check_context.py [DEPENDENCIES]

Copies the build context to a temporary directory: what .dockerignore leaves, by the rules of Docker's own client, and
of that what the Dockerfile's COPY lines take. Cargo must resolve the workspace there. DEPENDENCIES is the file that
cargo writes beside a binary (target/debug/verne.d): the copy must hold every file of this repository that it names.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from docker.utils.build import exclude_paths

ROOT = Path(__file__).resolve().parent.parent


def context() -> list[str]:
    """The files that Docker's client sends to the builder."""
    lines = (line.strip() for line in (ROOT / ".dockerignore").read_text().splitlines())
    patterns = [line for line in lines if line and not line.startswith("#")]
    return sorted(path for path in exclude_paths(str(ROOT), patterns) if (ROOT / path).is_file())


def copied_paths() -> list[list[str]]:
    """Of each COPY line that reads the context: its sources and its destination."""
    text = (ROOT / "docker/Dockerfile").read_text().replace("\\\n", " ")
    lines = re.findall(r"^COPY +(.+)$", text, re.MULTILINE)
    words = [line.split() for line in lines if "--from=" not in line]
    if odd := [line for line in words if any(re.search(r"^--|[*?\[$]", word) for word in line)]:
        sys.exit(f"check_context.py does not understand COPY {' '.join(odd[0])}")
    return words


def copy_to(directory: Path) -> None:
    files = context()
    for *sources, destination in copied_paths():
        for source in sources:
            found = [file for file in files if source == "." or Path(file).is_relative_to(source)]
            if not found:
                sys.exit(f"The Dockerfile copies {source}, which .dockerignore excludes.")
            for file in found:
                # A directory gives its files, a file keeps its name.
                name = Path(file).name if file == source else Path(file).relative_to(source)
                target = directory / destination / name
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / file, target)


def dependencies(file: Path) -> list[Path]:
    """The files and directories of this repository that a file of dependencies names."""
    named = re.findall(r"(?:\\ |\S)+", file.read_text().split(":", 1)[1])
    paths = [Path(name.replace("\\ ", " ")).resolve() for name in named]
    target = ROOT / "target"
    return [path.relative_to(ROOT) for path in paths if path.is_relative_to(ROOT) and not path.is_relative_to(target)]


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        copy = Path(name)
        copy_to(copy)
        resolved = subprocess.run(
            ["cargo", "metadata", "--locked", "--format-version", "1"],
            cwd=copy, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False,
        )
        if resolved.returncode:
            sys.exit(f"Cargo cannot resolve the workspace in the build context:\n{resolved.stderr}")
        for argument in sys.argv[1:]:
            named = dependencies(Path(argument))
            if not named:
                sys.exit(f"{argument} names no file of this repository.")
            if missing := [str(path) for path in named if not (copy / path).exists()]:
                sys.exit(f"The build context lacks what the binary is made of: {', '.join(missing)}")


if __name__ == "__main__":
    main()
