"""Tests of release/compatibility.py: it names each change that breaks the promise, and none that keeps it."""

import copy
import json
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).parents[2] / "release"))
from compatibility import changes, series  # noqa: E402
from interface import without_texts  # noqa: E402

DOCUMENT = json.loads((Path(__file__).parents[2] / "openapi/openapi.json").read_text())
INTERFACE = {
    "version": "0.1.0",
    "commands": {"verne": [], "verne ik": ["--x", "--machine"]},
    "metrics": {"verne_computations": "counter"},
    "openapi": without_texts(DOCUMENT),
}


class Compatibility(unittest.TestCase):
    def setUp(self) -> None:
        self.new = copy.deepcopy(INTERFACE)
        self.paths = self.new["openapi"]["paths"]
        self.schemas = self.new["openapi"]["components"]["schemas"]

    def found(self) -> list[str]:
        return changes(INTERFACE, self.new)

    def test_nothing_is_broken_if_nothing_changes(self) -> None:
        self.assertEqual(self.found(), [])

    def test_additions_keep_the_promise(self) -> None:
        self.new["commands"]["verne ik"].append("--new")
        self.new["commands"]["verne new"] = []
        self.new["metrics"]["verne_new"] = "gauge"
        self.paths["/new"] = {}
        self.paths["/ik"]["get"]["parameters"].append({"in": "query", "name": "new", "schema": {"type": "number"}})
        self.schemas["Solution"]["properties"]["new"] = {"type": "number"}
        self.schemas["Solution"]["required"].append("new")
        self.schemas["Unchecked"]["enum"].append("new")
        self.schemas["WorkspaceRequest"]["properties"]["new"] = {"type": "number"}
        self.assertEqual(self.found(), [])

    def test_what_is_gone_is_named(self) -> None:
        del self.new["commands"]["verne ik"][0]
        self.new["metrics"] = {}
        del self.paths["/jobs/{id}"]["delete"]
        parameters = self.paths["/fk"]["get"]["parameters"]
        parameters[:] = [parameter for parameter in parameters if parameter["name"] != "tool_length"]
        del self.schemas["Solution"]["properties"]["residual"]
        found = "\n".join(self.found())
        for change in (
            "verne ik: --x is gone",
            "the metric verne_computations (counter) is gone",
            "DELETE /jobs/{id} is gone",
            "GET /fk: the parameter tool_length is gone",
            "the field residual is gone",
        ):
            self.assertIn(change, found)

    def test_a_narrower_request_is_named(self) -> None:
        request = self.schemas["WorkspaceRequest"]
        request["properties"]["new"] = {"type": "number"}
        request.setdefault("required", []).append("new")
        request["properties"]["tolerance"]["default"] = 7
        self.paths["/fk"]["get"]["parameters"].append({"in": "query", "name": "new", "required": True})
        found = "\n".join(self.found())
        for change in ("the field new is required", "is now 7", "the new parameter new is required"):
            self.assertIn(change, found)

    def test_a_wider_answer_is_named(self) -> None:
        self.schemas["Solution"]["properties"]["residual"]["type"] = ["number", "null"]
        self.schemas["Solution"]["required"].remove("working")
        found = "\n".join(self.found())
        self.assertIn("the type ['number'] is now ['number', 'null']", found)
        self.assertIn("the field working is optional", found)

    def test_a_code_that_is_gone_is_named(self) -> None:
        for item in self.paths.values():
            for operation in item.values():
                for response in operation["responses"].values():
                    examples = response.get("content", {}).get("application/problem+json", {}).get("examples", [])
                    if "queue_full" in examples:
                        examples.remove("queue_full")
        self.assertEqual(self.found(), ["the problem queue_full with status 503 is gone"])

    def test_series(self) -> None:
        self.assertEqual([series(version) for version in ("0.1.3", "0.2.0", "1.2.3")], ["0.1", "0.2", "1"])


if __name__ == "__main__":
    unittest.main()
