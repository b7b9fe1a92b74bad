"""The modules of a Rust crate and the imports between them, read from its source.

A module imports another one if its code names an item that the other one defines: in a `use`, or by a path in an
expression or type. A name that a parent re-exports belongs to the module that defines it; the re-export itself is no
import. `#[cfg(test)]` items, comments and strings do not count, except the paths in serde's attributes. Method calls
do not count either: their types are not known here.
"""

import re
from collections import defaultdict

TOKEN = re.compile(
    r"""
    (?P<space>\s+ | //[^\n]*)
  | (?P<comment>/\*)
  | (?P<raw>(?:b|c|br|cr)?r(?P<hashes>\#*)".*?"(?P=hashes))
  | (?P<string>[bc]?"(?:[^"\\]|\\.)*")
  | (?P<character>b?'(?:[^'\\\n]|\\(?:u\{[^}]*\}|x..|.))')
  | (?P<lifetime>'\w+)
  | (?P<word>(?:r\#)?[A-Za-z_]\w*)
  | (?P<number>\d[\w]*)
  | (?P<mark>::|.)
    """,
    re.VERBOSE | re.DOTALL,
)
WORD = re.compile(r"[A-Za-z_]\w*$")
DEFINING = {"fn", "struct", "enum", "union", "trait", "type", "const", "static", "mod", "macro_rules"}
SERDE_PATHS = {"with", "default", "serialize_with", "deserialize_with", "skip_serializing_if", "schema_with"}
OPENING, CLOSING = {"{": 1, "(": 1, "[": 1}, {"}": 1, ")": 1, "]": 1}


def tokens_of(text):
    """The words and marks of a source text with their lines; the paths in serde's attributes become words."""
    tokens, at, line = [], 0, 1
    while at < len(text):
        found = TOKEN.match(text, at)
        kind, piece = found.lastgroup, found[0]
        if kind == "hashes":
            kind = "raw"
        end = found.end()
        if kind == "comment":
            end, depth = at + 2, 1
            while depth and end < len(text):
                mark = text[end : end + 2]
                depth += {"/*": 1, "*/": -1}.get(mark, 0)
                end += 2 if mark in ("/*", "*/") else 1
            piece = text[at:end]
        elif kind == "word":
            tokens.append((piece.removeprefix("r#"), line))
        elif kind == "mark":
            tokens.append((piece, line))
        elif kind in ("string", "raw", "character", "number", "lifetime"):
            before = [word for word, _ in tokens[-2:]]
            if kind == "string" and before[1:] == ["="] and before[0] in SERDE_PATHS and "::" in piece:
                tokens += [(word, line) for word in re.findall(r"::|\w+", piece)]
            else:
                # A literal: neither a word nor a mark.
                tokens.append(('""', line))
        line += piece.count("\n")
        at = end
    return tokens


def end_of_group(tokens, at):
    """The index behind the bracket that closes the one at `at`."""
    depth = 0
    for i in range(at, len(tokens)):
        word = tokens[i][0]
        depth += (word in OPENING) - (word in CLOSING)
        if depth == 0:
            return i + 1
    return len(tokens)


def end_of_item(tokens, at):
    """The index behind the item, field or statement that begins at `at`."""
    while at < len(tokens) and tokens[at][0] == "#":
        at = end_of_group(tokens, at + 1)
    braces_end = True
    while at < len(tokens):
        word = tokens[at][0]
        if word in ("use", "const", "static", "type", "let", "extern") and tokens[at + 1][0] != "fn":
            braces_end = False
        if word == "fn":
            braces_end = True
        if word in (";", ","):
            return at + 1
        if word in CLOSING:
            return at
        if word in OPENING:
            at = end_of_group(tokens, at)
            if word == "{" and braces_end:
                return at
        else:
            at += 1
    return at


def without_tests(tokens):
    """The tokens without items that exist only in tests."""
    kept, at = [], 0
    while at < len(tokens):
        if tokens[at][0] == "#" and [word for word, _ in tokens[at + 1 : at + 4]] == ["[", "cfg", "("]:
            end = end_of_group(tokens, at + 1)
            condition = "".join(word for word, _ in tokens[at + 4 : end - 2])
            if condition == "test" or condition.startswith("all(test"):
                at = end_of_item(tokens, end)
                continue
        kept.append(tokens[at])
        at += 1
    return kept


class Module:
    """A module: its children, the names that it defines and imports, and the paths that its code names."""

    def __init__(self, name, parent, file):
        self.name, self.parent, self.file = name, parent, file
        self.children, self.defined = {}, set()
        # Name to (path, whether it is re-exported).
        self.imported, self.globs = {}, []
        # (path, line).
        self.paths = []

    def __repr__(self):
        return f"{self.parent}::{self.name}" if self.parent and self.parent.parent else self.name

    def folder(self):
        module = self
        while module.parent and module.parent.parent:
            module = module.parent
        return module.name


class Crate:
    """The modules of a crate and the imports between them."""

    def __init__(self, name, library, root_file):
        self.name, self.library, self.modules = name, library, []
        self.root = self.load(name, None, root_file, root_file.parent)

    def load(self, name, parent, file, directory):
        module = self.added(name, parent, file)
        self.read(module, without_tests(tokens_of(file.read_text())), directory)
        return module

    def added(self, name, parent, file):
        module = Module(name, parent, file)
        self.modules.append(module)
        if parent:
            parent.children[name] = module
        return module

    def read(self, module, tokens, directory):
        """Records what the tokens of a module define, import and name. Its submodules lie in `directory`."""
        at, depth = 0, 0
        while at < len(tokens):
            word, line = tokens[at]
            following = tokens[at + 1][0] if at + 1 < len(tokens) else ""
            before = tokens[at - 1][0] if at else ""
            depth += (word == "{") - (word == "}")
            if word == "mod" and WORD.match(following) and tokens[at + 2][0] == ";":
                module.defined.add(following)
                file = directory / f"{following}.rs"
                if not file.exists():
                    file = directory / following / "mod.rs"
                self.load(following, module, file, directory / following)
                at += 3
            elif word == "mod" and WORD.match(following) and tokens[at + 2][0] == "{":
                module.defined.add(following)
                end = end_of_group(tokens, at + 2)
                child = self.added(following, module, module.file)
                self.read(child, tokens[at + 3 : end - 1], directory / following)
                at = end
            elif word == "use" and before not in ("+", "=", ":"):
                end = at
                while tokens[end][0] != ";":
                    end += 1
                public = before == "pub" or self.restricted(tokens, at)
                self.imports(module, tokens[at + 1 : end], [], public)
                at = end + 1
            elif word == "pub" and following == "(":
                at = end_of_group(tokens, at + 1)
            else:
                if word in DEFINING and depth == 0:
                    name = tokens[at + 2][0] if word == "macro_rules" else following
                    if name in ("mut", "unsafe", "fn", "async"):
                        name = ""
                    module.defined.add(name)
                if WORD.match(word) and before not in (".", "::", "fn", "struct", "enum", "trait", "let", "mod"):
                    path = [word]
                    at += 1
                    while at + 1 < len(tokens) and tokens[at][0] == "::" and WORD.match(tokens[at + 1][0]):
                        path.append(tokens[at + 1][0])
                        at += 2
                    following = tokens[at][0] if at < len(tokens) else ""
                    # A lone word in small letters is a variable, unless it is called.
                    if len(path) > 1 or not word[0].islower() or following in ("(", "!", "::"):
                        module.paths.append((path, line))
                else:
                    at += 1

    @staticmethod
    def restricted(tokens, at):
        """Whether `pub(…)` stands before the token at `at`."""
        if tokens[at - 1][0] != ")":
            return False
        begin = at - 1
        while begin and tokens[begin][0] != "(":
            begin -= 1
        return tokens[begin - 1][0] == "pub"

    def imports(self, module, tree, prefix, public):
        """Records the names of a `use` tree."""
        path, at = list(prefix), 0
        while at < len(tree):
            word, line = tree[at]
            if word == "{":
                end = end_of_group(tree, at)
                begin, depth = at + 1, 0
                for i in range(at + 1, end):
                    part = tree[i][0]
                    if depth == 0 and (part == "," or i == end - 1):
                        if i > begin:
                            self.imports(module, tree[begin:i], path, public)
                        begin = i + 1
                    depth += (part == "{") - (part == "}")
                return
            if word == "*":
                module.globs.append((path, public))
                if not public:
                    module.paths.append((path, line))
                return
            if word == "as":
                self.imported(module, path, tree[at + 1][0], line, public)
                return
            if word != "::":
                path.append(word)
            at += 1
        line = tree[0][1]
        if path[-1] == "self" and len(path) > 1:
            path = path[:-1]
        self.imported(module, path, path[-1], line, public)

    @staticmethod
    def imported(module, path, name, line, public):
        if name != "_":
            module.imported[name] = (path, public)
        if not public:
            module.paths.append((path, line))

    def resolve(self, module, path, seen=()):
        """The module that defines the item that a path names, or None for other crates and for local names."""
        if (module, tuple(path)) in seen:
            return None
        seen = (*seen, (module, tuple(path)))
        head, rest = path[0], path[1:]
        if head in ("crate", self.library):
            return self.descend(self.root, rest, seen)
        if head == "self":
            return self.descend(module, rest, seen) if rest else None
        if head == "super":
            if rest[:1] == ["super"]:
                return self.resolve(module.parent, rest, seen)
            return self.descend(module.parent, rest, seen) if module.parent else None
        if head in module.children or head in module.imported or module.globs:
            return self.descend(module, path, seen, local=True)
        return None

    def descend(self, module, path, seen, local=False):
        """The module that defines the item that a path below a module names."""
        if not path:
            return module
        head, rest = path[0], path[1:]
        if head in module.children:
            return self.descend(module.children[head], rest, seen)
        if head in module.imported:
            target, _ = module.imported[head]
            if target[0] == head and head not in module.children:
                # `use name::…` of another crate, or of this module's own name.
                return None
            return self.resolve(module, target + rest, seen)
        if head in module.defined:
            return module
        for target, _ in module.globs:
            inner = self.resolve(module, target, seen) if target else None
            if inner and inner is not module and self.offers(inner, head):
                return self.descend(inner, path, seen)
        return None if local else module

    @staticmethod
    def offers(module, name):
        return name in module.defined or name in module.imported or name in module.children

    def edges(self):
        """Importing module to imported module to the first (file, line) that names it."""
        edges = defaultdict(dict)
        for module in self.modules:
            for path, line in module.paths:
                if len(path) == 1 and not self.counts(module, path[0]):
                    continue
                target = self.resolve(module, path)
                # A path that ends at a module opens a name for later paths: those count.
                ends_at_module = target and path[-1] in ("crate", "super", target.name)
                if target and target is not module and (path[-1] in target.defined or not ends_at_module):
                    edges[module].setdefault(target, (module.file, line))
        return edges

    @staticmethod
    def counts(module, name):
        """Whether a lone name in code can be of another module: it is re-exported here, or comes by a glob."""
        return name not in module.defined and (name in module.imported or bool(module.globs))
