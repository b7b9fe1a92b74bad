#!/usr/bin/env python3
"""Lists the changes between two interfaces that break what docs/stability.md promises: compatibility.py OLD... NEW. The
files are those of release/interface.py. It compares NEW with each OLD of the same series (0.1, 0.2, ..., 1, 2, ...), and
fails if there is a breaking change. A new series may break everything."""

import json
import sys
from collections.abc import Iterator
from pathlib import Path

METHODS = ("get", "put", "post", "delete", "patch", "head", "options")
Schema = dict | bool


def series(version: str) -> str:
    major, minor = version.split(".")[:2]
    return f"0.{minor}" if major == "0" else major


class Comparison:
    """Two OpenAPI documents. A request may get wider, an answer may get more fields."""

    def __init__(self, old: dict, new: dict) -> None:
        self.old, self.new = old, new
        self.seen: set[tuple[str, str, bool]] = set()

    @staticmethod
    def resolve(document: dict, node: dict) -> dict:
        while isinstance(node, dict) and "$ref" in node:
            target = document
            for part in node["$ref"].removeprefix("#/").split("/"):
                target = target[part.replace("~1", "/").replace("~0", "~")]
            node = target
        return node

    def changes(self) -> Iterator[str]:
        for path, item in self.old["paths"].items():
            for method in METHODS:
                if method not in item:
                    continue
                name = f"{method.upper()} {path}"
                other = self.new["paths"].get(path, {}).get(method)
                if other is None:
                    yield f"{name} is gone"
                else:
                    yield from self.operation(name, item[method], other)
        gone = self.codes(self.old) - self.codes(self.new)
        yield from (f"the problem {code} with status {status} is gone" for code, status in sorted(gone))

    def codes(self, document: dict) -> set[tuple[str, str]]:
        found = set()
        for item in document["paths"].values():
            for operation in item.values():
                for status, response in operation.get("responses", {}).items():
                    content = self.resolve(document, response).get("content", {})
                    codes = content.get("application/problem+json", {}).get("examples", [])
                    found |= {(code, status) for code in codes}
        return found

    def operation(self, name: str, old: dict, new: dict) -> Iterator[str]:
        parameters = [
            {(p["in"], p["name"]): p for p in (self.resolve(document, p) for p in operation.get("parameters", []))}
            for document, operation in ((self.old, old), (self.new, new))
        ]
        for key, parameter in parameters[0].items():
            if key not in parameters[1]:
                yield f"{name}: the parameter {key[1]} is gone"
                continue
            other = parameters[1][key]
            if other.get("required") and not parameter.get("required"):
                yield f"{name}: the parameter {key[1]} is required"
            yield from self.schema(f"{name}: {key[1]}", parameter.get("schema", {}), other.get("schema", {}), True)
        for key, parameter in parameters[1].items():
            if key not in parameters[0] and parameter.get("required"):
                yield f"{name}: the new parameter {key[1]} is required"
        bodies = [
            self.resolve(document, operation.get("requestBody", {}))
            for document, operation in ((self.old, old), (self.new, new))
        ]
        if bodies[1].get("required") and not bodies[0].get("required"):
            yield f"{name}: a body is required"
        yield from self.contents(name, bodies[0], bodies[1], True)
        for status, answer in old["responses"].items():
            answer = self.resolve(self.old, answer)
            if status not in new["responses"]:
                # Problems are compared by their codes.
                if status.startswith("2"):
                    yield f"{name}: the status {status} is gone"
            elif status.startswith("2"):
                other = self.resolve(self.new, new["responses"][status])
                yield from self.contents(f"{name}: {status}", answer, other, False)

    def contents(self, name: str, old: dict, new: dict, request: bool) -> Iterator[str]:
        for media, content in old.get("content", {}).items():
            if media not in new.get("content", {}):
                yield f"{name}: the media type {media} is gone"
            else:
                yield from self.schema(
                    name, content.get("schema", {}), new["content"][media].get("schema", {}), request)

    def schema(self, name: str, old: Schema, new: Schema, request: bool) -> Iterator[str]:
        """Changes of a schema: narrower in a request, wider in an answer."""
        if isinstance(old, bool) or isinstance(new, bool):
            return
        if "$ref" in old and "$ref" in new:
            pair = (old["$ref"], new["$ref"], request)
            if pair in self.seen:
                return
            self.seen.add(pair)
        old, new = self.resolve(self.old, old), self.resolve(self.new, new)
        types = [kinds if isinstance(kinds, list) else [kinds] for kinds in (old.get("type", []), new.get("type", []))]
        lost, gained = set(types[0]) - set(types[1]), set(types[1]) - set(types[0])
        # A whole number is a number.
        if request and gained == {"number"} and lost == {"integer"}:
            lost = gained = set()
        if (lost if request else gained) or bool(types[0]) != bool(types[1]):
            yield f"{name}: the type {types[0]} is now {types[1]}"
        if request and (removed := set(map(str, old.get("enum", []))) - set(map(str, new.get("enum", old.get("enum", []))))):
            yield f"{name}: {', '.join(sorted(removed))} is refused"
        if request and old.get("default") != new.get("default"):
            yield f"{name}: the default {old.get('default')} is now {new.get('default')}"
        for bound, narrower in (("minimum", lambda a, b: b > a), ("maximum", lambda a, b: b < a)):
            if request and bound in new and (bound not in old or narrower(old[bound], new[bound])):
                yield f"{name}: the {bound} {old.get(bound)} is now {new[bound]}"
        yield from self.properties(name, old, new, request)
        for part in ("items", "additionalProperties"):
            if isinstance(old.get(part), dict) and isinstance(new.get(part), dict):
                yield from self.schema(f"{name}[]", old[part], new[part], request)
        for part in ("allOf", "oneOf", "anyOf"):
            pair = old.get(part, []), new.get(part, [])
            if len(pair[0]) > len(pair[1]) if request else len(pair[0]) < len(pair[1]):
                yield f"{name}: {part} has {len(pair[1])} alternatives instead of {len(pair[0])}"
            for one, other in zip(*pair):
                yield from self.schema(name, one, other, request)

    def properties(self, name: str, old: dict, new: dict, request: bool) -> Iterator[str]:
        fields = old.get("properties", {}), new.get("properties", {})
        required = set(old.get("required", [])), set(new.get("required", []))
        for field, schema in fields[0].items():
            if field not in fields[1]:
                yield f"{name}: the field {field} is gone"
            else:
                yield from self.schema(f"{name}.{field}", schema, fields[1][field], request)
        for field in sorted(required[1] - required[0] if request else required[0] - required[1]):
            if request or field in fields[1]:
                yield f"{name}: the field {field} is {'required' if request else 'optional'}"


def names(old: dict, new: dict) -> Iterator[str]:
    """Commands, options and metrics that are gone."""
    for command, options in old["commands"].items():
        if command not in new["commands"]:
            yield f"{command} is gone"
            continue
        yield from (f"{command}: {option} is gone" for option in options if option not in new["commands"][command])
    for metric, kind in old["metrics"].items():
        if new["metrics"].get(metric) != kind:
            yield f"the metric {metric} ({kind}) is gone or of another kind"


def changes(old: dict, new: dict) -> list[str]:
    """The breaking changes between two interfaces."""
    return [*names(old, new), *Comparison(old["openapi"], new["openapi"]).changes()]


def main() -> None:
    *old, new = (json.loads(Path(name).read_text()) for name in sys.argv[1:])
    broken = [
        f"since {interface['version']}: {change}"
        for interface in old
        if series(interface["version"]) == series(new["version"])
        for change in changes(interface, new)
    ]
    print("\n".join(broken) or f"Nothing that {len(old)} released interfaces promise is broken.")
    sys.exit(bool(broken))


if __name__ == "__main__":
    main()
