#!/usr/bin/env python3
"""Rejects unclear sentences in the texts that users read.

    check_texts.py target/debug/verne

Checks the help of every command, openapi/openapi.json, README.md, clients/python/README.md and the Markdown files in docs. A sentence
must not begin with What, Who, Whoever, Whose or Of, nor with That as a conjunction: such a sentence hides who does what.
It must not contain "told of", "is held" or "whoever". Questions and headings may begin with any word.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]

BEGINNING = re.compile(r"(?:What|Who|Whoever|Whose|Of)\b|That (?!is\b|was\b|has\b|means\b|needs\b|takes\b|gives\b|makes\b)")
PHRASE = re.compile(r"\b(?:told of|is held|whoever)\b", re.IGNORECASE)
# A sentence ends before a capital letter or a code span; abbreviations such as "Eq (3)" have no dot here.
END = re.compile(r"(?<=[.!?:;])\s+(?=[A-Z`*\"(])")
# Markdown before the first word: bullets, numbers, emphasis.
MARKS = re.compile(r"^(?:[-*+]\s+|\d+\.\s+|[*_(\"]+)*")


def faults(text):
    """The sentences of a text that are unclear."""
    for sentence in END.split(" ".join(text.split())):
        sentence = MARKS.sub("", sentence)
        if sentence.endswith("?"):
            continue
        if BEGINNING.match(sentence) or PHRASE.search(sentence):
            yield sentence


def help_texts(verne, command=()):
    """The help of a command and of all commands below it, line by line."""
    help_ = subprocess.run([verne, *command, "--help"], check=True, capture_output=True, text=True).stdout
    for line in help_.splitlines():
        # Two spaces stand between a name and its meaning.
        for text in re.split(r"\s{2,}", line.strip()):
            yield " ".join(["verne", *command, "--help"]), text
    listed = re.search(r"^Commands:\n((?:  .*\n)+)", help_, re.MULTILINE)
    for name in re.findall(r"^  ([\w-]+)", listed[1], re.MULTILINE) if listed else []:
        if name != "help":
            yield from help_texts(verne, (*command, name))


def document_texts(node, path="openapi.json "):
    """The texts of the OpenAPI document: summaries, descriptions, titles and details of problems."""
    if isinstance(node, dict):
        for key, value in node.items():
            if key in ("summary", "description", "title", "detail") and isinstance(value, str):
                for paragraph in re.split(r"\n\s*\n", value):
                    yield from cells(path + key, paragraph)
            else:
                yield from document_texts(value, f"{path}{key}/")
    elif isinstance(node, list):
        for i, value in enumerate(node):
            yield from document_texts(value, f"{path}{i}/")


def cells(place, paragraph):
    """A paragraph, or the cells of a table."""
    if paragraph.lstrip().startswith("|"):
        for cell in re.split(r"\s*\|\s*", paragraph):
            yield place, cell
    else:
        yield place, paragraph


def markdown_texts(path):
    """The paragraphs, list items and table cells of a Markdown file, without code blocks and headings."""
    text = re.sub(r"^( *)```.*?^\1```", "", path.read_text(), flags=re.MULTILINE | re.DOTALL)
    for paragraph in re.split(r"\n\s*\n|\n(?=\s*(?:[-*+]|\d+\.) )", text):
        if not paragraph.lstrip().startswith("#"):
            yield from cells(str(path.relative_to(ROOT)), paragraph)


def main(verne):
    texts = list(help_texts(verne))
    texts += document_texts(json.loads((ROOT / "openapi/openapi.json").read_text()))
    for path in [ROOT / "README.md", ROOT / "clients/python/README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
        texts += markdown_texts(path)
    failed = False
    for place, sentence in dict.fromkeys((place, fault) for place, text in texts for fault in faults(text)):
        failed = True
        print(f"{place}: {sentence}")
    print(f"{len(texts)} texts read")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
