#!/usr/bin/env python3
"""Checks the guide that the service serves at /guide, and the links of all Markdown files.

    check_guide.py target/debug/verne

Every page is reached from the first one. Every link leads to a page, and its anchor to a place there; pictures, scripts
and style sheets are the service's own, with their media types, so the guide is complete without a network. The
reference names every operation, the chapter of limits draws every constraint, and the drawings are what their scripts
draw. In the repository every relative link of a Markdown file leads to a file, and its anchor to a heading.
"""

import html.parser
import json
import re
import subprocess
import sys
import tempfile
import urllib.parse
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.append(str(ROOT / "tests/load"))
from verne_process import Client, Service  # noqa: E402

MEDIA = {
    "html": "text/html", "js": "text/javascript", "css": "text/css", "svg": "image/svg+xml", "png": "image/png",
}
# What an element loads, or where it leads.
ADDRESSES = {"a": "href", "img": "src", "script": "src", "link": "href", "iframe": "src"}
SCRIPTS = ("limits.py", "concepts.py")


class Page(html.parser.HTMLParser):
    """The places of a page, its addresses, and its text outside of code."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.addresses, self.text, self.prose, self.inside = set(), [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if place := attributes.get("id"):
            self.ids.add(place)
        if address := attributes.get(ADDRESSES.get(tag, "")):
            self.addresses.append((tag, address))
        if tag == "script" and "src" not in attributes:
            self.addresses.append((tag, "inline"))
        if tag in ("code", "pre", "script", "style"):
            self.inside.append(tag)

    def handle_endtag(self, tag):
        if self.inside and self.inside[-1] == tag:
            self.inside.pop()

    def handle_data(self, data):
        self.text.append(data)
        if not self.inside:
            self.prose.append(data)


def crawl(client):
    """All pages by path, and the faults of what they load."""
    pages, faults, waiting, seen = {}, [], ["/guide/"], set()
    while waiting:
        path = waiting.pop()
        if path in seen:
            continue
        seen.add(path)
        reply = client.ask("GET", path)
        media = reply.headers["Content-Type"].split(";")[0]
        wanted = MEDIA.get("html" if path.endswith("/") else path.rsplit(".", 1)[-1])
        if reply.status != 200 or media != wanted:
            faults.append(f"{path}: {reply.status}, {media}")
            continue
        if client.ask("GET", path, **{"If-None-Match": reply.headers["ETag"]}).status != 304:
            faults.append(f"{path}: not 304 with its tag")
        if media != "text/html":
            continue
        pages[path] = page = Page(reply.body.decode())
        for tag, address in page.addresses:
            if re.match(r"[a-z]+:", address):
                if tag != "a":
                    faults.append(f"{path}: loads {address}")
                continue
            if address == "inline":
                faults.append(f"{path}: a script in the page, which the policy forbids")
                continue
            target = urllib.parse.urljoin(path, address).split("#")[0]
            if not target.startswith("/guide/"):
                faults.append(f"{path}: leaves the guide for {address}")
            else:
                waiting.append(target)
    return pages, faults


def anchors(pages):
    """Links to places that no page has, and Markdown that was not understood."""
    for path, page in pages.items():
        for tag, address in page.addresses:
            target, _, anchor = urllib.parse.urljoin(path, address).partition("#")
            if tag == "a" and anchor and target in pages and urllib.parse.unquote(anchor) not in pages[target].ids:
                yield f"{path}: {address} leads to no place"
        if found := re.search(r".{0,40}\]\(.{0,40}|.{0,40}<!--.{0,40}", "".join(page.prose)):
            yield f"{path}: not understood: {found[0]}"


def completeness(pages):
    """Chapters, operations and constraints that the guide leaves out."""
    for chapter in re.findall(r"\]\(([\w/-]+)\.md\)", (ROOT / "docs/SUMMARY.md").read_text()):
        if f"/guide/{chapter}.html" not in pages:
            yield f"SUMMARY.md: {chapter} is no page"
    document = json.loads((ROOT / "openapi/openapi.json").read_text())
    operations = "".join(pages["/guide/operations.html"].text)
    for path, methods in document["paths"].items():
        for method in methods:
            if f"{method.upper()} {path}" not in operations:
                yield f"operations.html: lacks {method.upper()} {path}"
    limits = pages["/guide/limits.html"]
    for constraint in document["components"]["schemas"]["Constraint"]["enum"]:
        if constraint not in limits.ids or ("img", f"limits/{constraint}.svg") not in limits.addresses:
            yield f"limits.html: lacks {constraint} or its drawing"


def drawings():
    """Drawings that their scripts draw in another way."""
    for script in SCRIPTS:
        command = [sys.executable, ROOT / "docs/drawings" / script, "--check"]
        ran = subprocess.run(command, capture_output=True, text=True)
        if ran.returncode:
            yield ran.stderr.strip()
    drawn = subprocess.run([sys.executable, ROOT / "docs/frames.py"], capture_output=True, text=True, check=True).stdout
    if drawn != (ROOT / "docs/frames.svg").read_text():
        yield "docs/frames.svg is not what docs/frames.py draws"


def headings(path):
    """The anchors of a Markdown file: of its headings, as GitHub and mdBook make them."""
    text = re.sub(r"^( *)(```+).*?^\1\2", "", path.read_text(), flags=re.MULTILINE | re.DOTALL)
    for heading in re.findall(r"^#+ +(.+)$", text, re.MULTILINE):
        words = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower())
        yield words.strip().replace(" ", "-")


def repository_links():
    """Relative links of Markdown files to files or headings that do not exist."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "*.md"],
        cwd=ROOT, capture_output=True, check=True)
    for name in filter(None, listed.stdout.decode().split("\0")):
        path = ROOT / name
        text = re.sub(r"^( *)(```+).*?^\1\2|`[^`\n]*`", "", path.read_text(), flags=re.MULTILINE | re.DOTALL)
        for target in re.findall(r"\]\(([^)\s]+)\)", text):
            file, _, anchor = target.partition("#")
            # The solver's texts are parts of its documentation, with links to its items.
            if re.match(r"[a-z]+:", target) or name.startswith("src/solver/"):
                continue
            there = (path.parent / file) if file else path
            if not there.exists():
                yield f"{name}: {target} does not exist"
            elif anchor and there.suffix == ".md" and there.name not in ("operations.md", "types.md") \
                    and anchor not in headings(there):
                yield f"{name}: {target} leads to no heading"


def main(verne):
    with tempfile.TemporaryDirectory() as data:
        service = Service(verne, data).start()
        client = Client(service.port)
        try:
            pages, faults = crawl(client)
            redirect = client.ask("GET", "/guide")
            if redirect.headers["Location"] != "/guide/":
                faults.append("/guide does not lead to /guide/")
            if client.ask("GET", "/guide/nothing.html").status != 404:
                faults.append("a page that does not exist is not 404")
        finally:
            client.close()
            service.kill()
    faults += [*anchors(pages), *completeness(pages), *drawings(), *repository_links()]
    print("\n".join(faults))
    print(f"{len(pages)} pages, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
