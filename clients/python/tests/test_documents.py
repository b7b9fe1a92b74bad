"""The package agrees with the OpenAPI document, and its README with the package."""

from __future__ import annotations

import dataclasses
import doctest
import importlib.metadata
import inspect
import io
import json
import re
import tomllib
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import verne
from verne.answers import atlas, error_budget, fitting, job, machine, solution, toolpath, workspace

PACKAGE = Path(__file__).parents[1]
ROOT = PACKAGE.parents[1]
SCHEMAS: dict[str, Any] = json.loads((ROOT / "openapi" / "openapi.json").read_text())["components"]["schemas"]
# Dataclasses whose schema has another name.
NAMES = {
    "Deviation": "DeviationObject",
    "ErrorBudgetResult": "ErrorBudgetAnswer",
    "ForwardResult": "Answer",
    "FrameSetup": "Setup",
    "InverseResult": "Answer",
    "JobStatus": "Job",
    "Turning": "TurningObject",
    "WorkspaceLinks": "Links",
}
# Fields that the package leaves out on purpose.
LEFT_OUT = {"ForwardResult": {"free"}, "FamilySummary": {"links"}}


def schema(name: str) -> tuple[set[str], set[str]]:
    """All fields and the fields that are always present."""
    whole = SCHEMAS[name]
    if "oneOf" in whole:
        # Kinds of answers share one class.
        shared = set.intersection(*(set(kind["required"]) for kind in whole["oneOf"]))
        return {field for kind in whole["oneOf"] for field in kind["properties"]}, shared
    properties: set[str] = set()
    required: set[str] = set()
    parts = whole.get("allOf", [whole])
    for part in parts:
        # A part that may be null has no field that is always present.
        for choice in part.get("oneOf", [part]):
            choice = SCHEMAS[choice["$ref"].rsplit("/", 1)[1]] if "$ref" in choice else choice
            properties |= set(choice.get("properties", {}))
            required |= set(choice.get("required", [])) if "oneOf" not in part else set()
    return properties, required


def dataclasses_of(*modules: ModuleType) -> list[Any]:
    found = [kind for module in modules for kind in vars(module).values() if dataclasses.is_dataclass(kind)]
    return list(dict.fromkeys(found))


@pytest.mark.parametrize(
    "kind",
    dataclasses_of(atlas, error_budget, fitting, job, machine, solution, toolpath, workspace),
    ids=lambda kind: kind.__name__,
)
def test_a_dataclass_has_the_fields_of_its_schema(kind: Any) -> None:
    properties, required = schema(NAMES.get(kind.__name__, kind.__name__))
    fields = {
        # ``from`` is a word of Python.
        field.name.removesuffix("_"): field.default is dataclasses.MISSING
        and field.default_factory is dataclasses.MISSING
        for field in dataclasses.fields(kind)
    }
    assert fields.keys() | LEFT_OUT.get(kind.__name__, set()) == properties
    assert {name for name, mandatory in fields.items() if mandatory} <= required


def test_the_clients_have_the_same_operations() -> None:
    def public(kind: type) -> set[str]:
        return {name.removeprefix("a") for name in vars(kind) if not name.startswith("_")}

    assert public(verne.Client) == public(verne.AsyncClient)
    jobs = (
        "Job",
        "WorkspaceJob",
        "FamilyJob",
        "DexterityJob",
        "ErrorMapJob",
        "ToolpathJob",
        "PlacementJob",
        "OriginsJob",
    )
    for name in jobs:
        assert public(getattr(verne, name)) == public(getattr(verne, f"Async{name}"))


def test_the_package_has_the_version_of_the_service() -> None:
    manifest = tomllib.loads((ROOT / "Cargo.toml").read_text())
    assert importlib.metadata.version("verne") == manifest["workspace"]["package"]["version"]


def test_a_method_has_the_documentation_of_its_operation() -> None:
    signature = inspect.signature(verne.Client().ik)
    assert list(signature.parameters)[:3] == ["x", "y", "z"]
    assert signature.return_annotation == "InverseResult"
    assert inspect.getdoc(verne.AsyncClient.ik) == inspect.getdoc(verne.Client.ik)


def test_the_readme_prints_what_it_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    # As a reader would in the root of the repository.
    monkeypatch.chdir(ROOT)
    text = re.sub("^```.*", "", (PACKAGE / "README.md").read_text(), flags=re.MULTILINE)
    examples = doctest.DocTestParser().get_doctest(text, {}, "README.md", str(PACKAGE / "README.md"), 0)
    report = io.StringIO()
    result = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(examples, out=report.write)
    assert result.attempted > 0
    assert result.failed == 0, report.getvalue()
