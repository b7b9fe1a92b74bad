"""Sends each request of examples/http/verne.http and compares the status with the one that its title states."""

import re
import unittest
import urllib.error
import urllib.request

from example_service import EXAMPLES, address, stop

tearDownModule = stop

FILE = EXAMPLES / "http/verne.http"
ANSWERS = re.compile(r"\(answers (\d+)\)$")


def requests():
    """Title, method, address, headers and body of each request."""
    head, *parts = re.split(r"^###[ \t]*", FILE.read_text(), flags=re.MULTILINE)
    variables = dict(re.findall(r"^@(\w+) *= *(\S+)$", head, re.MULTILINE)) | {"server": address()}
    for part in parts:
        part = re.sub(r"\{\{(\w+)\}\}", lambda name: variables[name[1]], part)
        above, _, body = part.partition("\n\n")
        title, request, *headers = above.strip().splitlines()
        method, url = request.split(maxsplit=1)
        body = body.strip()
        if body.startswith("< "):
            content = (FILE.parent / body[2:]).read_bytes()
        else:
            content = body.encode() or None
        yield title, method, url, dict(re.split(r": *", header, maxsplit=1) for header in headers), content


def status(method, url, headers, content):
    try:
        with urllib.request.urlopen(urllib.request.Request(url, content, headers, method=method)) as reply:
            return reply.status, reply.read()
    except urllib.error.HTTPError as refused:
        return refused.code, refused.read()


class Http(unittest.TestCase):
    def test_each_request_is_answered_as_its_title_says(self):
        titles = []
        for title, *request in requests():
            titles.append(title)
            with self.subTest(title):
                code, text = status(*request)
                if expected := ANSWERS.search(title):
                    self.assertEqual(code, int(expected[1]), text[:500])
                else:
                    self.assertIn(code, (200, 201, 202), text[:500])
                self.assertTrue(text)
        self.assertEqual(len(titles), len(set(titles)), "each title once")
        self.assertGreater(len(titles), 15)


if __name__ == "__main__":
    unittest.main()
