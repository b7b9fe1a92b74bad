#!/usr/bin/env python3
"""Prints what docs/stability.md promises to keep, as JSON: interface.py VERNE METRICS. VERNE is the binary, and METRICS a
file of what /metrics says (docker/metrics writes it). The result has the OpenAPI document without texts and examples, the
commands with their options, which are also the settings, and the names of the metrics."""

import json
import re
import subprocess
import sys
from pathlib import Path

COMMAND = re.compile(r"^  ([a-z-]+)(?:  |$)")
OPTION = re.compile(r"^\s+(?:-\w, )?(--[a-z0-9-]+)")
METRIC = re.compile(r"^# TYPE (\S+) (\S+)", re.MULTILINE)
TEXTS = ("description", "summary", "title", "example")


def run(verne: str, *arguments: str) -> str:
    return subprocess.run([verne, *arguments], check=True, stdout=subprocess.PIPE, text=True).stdout


def commands(verne: str, path: tuple[str, ...] = ()) -> dict[str, list[str]]:
    """The options of a command and of those below it, by their names."""
    text = run(verne, *path, "--help")
    options = [match[1] for line in text.splitlines() if (match := OPTION.match(line))]
    found = {" ".join(("verne", *path)): options}
    below = text.split("\nCommands:\n", 1)[1].split("\n\n", 1)[0] if "\nCommands:\n" in text else ""
    for line in below.splitlines():
        if (match := COMMAND.match(line)) and match[1] != "help":
            found |= commands(verne, (*path, match[1]))
    return found


def without_texts(node: object, names_are_data: bool = False) -> object:
    """A document without what only people read. Below `properties` and the like, names are those of fields."""
    if isinstance(node, list):
        return [without_texts(item) for item in node]
    if not isinstance(node, dict):
        return node
    maps = ("properties", "schemas", "paths", "responses", "content", "parameters")
    kept = {name: value for name, value in node.items() if names_are_data or name not in TEXTS}
    # The names of a problem's examples are its codes.
    return {
        name: sorted(value) if name == "examples" and not names_are_data and isinstance(value, dict)
        else without_texts(value, not names_are_data and name in maps)
        for name, value in kept.items()
    }


def main() -> None:
    verne, metrics = sys.argv[1:]
    document = json.loads(run(verne, "openapi"))
    interface = {
        "version": document["info"]["version"],
        "commands": commands(verne),
        "metrics": {name: kind for name, kind in METRIC.findall(Path(metrics).read_text())},
        "openapi": without_texts(document),
    }
    print(json.dumps(interface, indent=1))


if __name__ == "__main__":
    main()
