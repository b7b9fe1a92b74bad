#!/usr/bin/env python3
"""Tests of check_modules.py with small crates."""

import tempfile
import unittest
from pathlib import Path

from check_modules import check_crate, check_files


def faults(files, name="crate"):
    """The faults of a crate with these files."""
    with tempfile.TemporaryDirectory() as directory:
        root = Path(directory)
        source = root / "src" / name / "src"
        for path, text in files.items():
            (source / path).parent.mkdir(parents=True, exist_ok=True)
            (source / path).write_text(text)
        found = [*check_crate(name, "verne_crate", source / "lib.rs", root, False), *check_files(root, [])]
        return [fault.splitlines()[0] for fault in found]


class Cycles(unittest.TestCase):
    def test_an_import_of_the_importer_is_a_cycle(self):
        for way_back in [
            "use crate::a::A;",
            "use super::a::{self, A};",
            "use crate::{a::{A, C}, c};",
            "use crate::A;",
            "fn f() { crate::a::f() }",
            "use crate::a; fn f() { a::f() }",
            "use super::*; fn f() -> A {}",
            '#[serde(with = "crate::a::f")] struct S;',
        ]:
            files = {"lib.rs": "mod a; mod b; pub use a::A;", "a.rs": "use crate::b::B; pub struct A; pub fn f() {}"}
            found = faults({**files, "b.rs": f"{way_back} pub struct B;"})
            self.assertEqual(found, ["crate: cycle a -> b -> a"], way_back)

    def test_tests_comments_strings_and_visibilities_are_no_imports(self):
        for harmless in [
            "#[cfg(test)] mod tests { use crate::a::A; }",
            "#[cfg(test)] use crate::a::A;",
            "/// See [`A`](crate::a::A).",
            "/* use /* nested */ crate::a::A; */",
            "const C: (&str, char) = (\"crate::a::A\", '\"');",
            'const C: &str = r#"" use crate::a::A; "#;',
            "pub(in crate::a) struct C;",
            "use std::a::A;",
        ]:
            files = {"lib.rs": "mod a; mod b;", "a.rs": "use crate::b::B; pub struct A;"}
            self.assertEqual(faults({**files, "b.rs": f"{harmless}\npub struct B;"}), [], harmless)

    def test_a_parent_that_only_re_exports_its_children_imports_nothing(self):
        children = {"a/b.rs": "use super::C; pub struct B;", "a/c.rs": "pub struct C;"}
        parent = "mod b; mod c; pub use b::B; pub use c::C;"
        self.assertEqual(faults({"lib.rs": "mod a;", "a.rs": parent, **children}), [])
        parent = "mod b; pub use b::B; pub struct C(B);"
        self.assertEqual(faults({"lib.rs": "mod a;", "a.rs": parent, **children}), ["crate: cycle a -> a::b -> a"])


class Order(unittest.TestCase):
    def test_a_folder_of_the_service_imports_only_those_before_it(self):
        files = {"lib.rs": "mod http; mod wire;", "http.rs": "mod page; pub struct H;", "wire.rs": "pub struct W;"}
        self.assertEqual(faults({**files, "http/page.rs": "use crate::wire::W;"}, "service"), [])
        found = faults({**files, "http/page.rs": "", "wire.rs": "use crate::http::H;"}, "service")
        self.assertEqual(found, ["service: wire must not import http"])
        self.assertEqual(faults({"lib.rs": "mod misc {}"}, "service"), ["service: misc does not stand in SERVICE_ORDER"])


class Sizes(unittest.TestCase):
    def test_long_files_and_lines_are_rejected(self):
        self.assertEqual(faults({"lib.rs": "\n" * 300 + "/" * 120}), ["src/crate/src/lib.rs: 301 lines, more than 300"])
        self.assertEqual(faults({"lib.rs": "/" * 121}), ["src/crate/src/lib.rs:1: 121 characters, more than 120"])


if __name__ == "__main__":
    unittest.main(buffer=True)
