"""Finds the commands in Markdown documents. Used by check_commands.py."""

import dataclasses
import pathlib
import re
import shutil
import subprocess

SHELLS = {"sh", "bash", "shell", "console"}
FENCE = re.compile(r"^( *)(```+|~~~+)([^\n`]*)\n(.*?)(?:^\1\2[`~]*[ \t]*$|\Z)", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"(?<!`)(`+)(?!`)(.+?)(?<!`)\1(?!`)", re.DOTALL)
ASSIGNMENT = re.compile(r"[A-Z_][A-Z0-9_]*=\S*$")
# What a span of code begins with if it is a command. A program's name alone is a mention of it.
PROGRAMS = {
    "apt-get", "aws", "cargo", "cp", "curl", "docker", "find", "git", "helm", "kubectl", "nats", "node", "npm", "npx",
    "openssl", "pip", "python", "python3", "sqlite3", "systemctl", "systemd-analyze", "verne",
}


@dataclasses.dataclass
class Command:
    place: str
    text: str
    # What the document prints after it; `None` where it prints nothing.
    printed: str | None = None
    # Within a sentence, and not in a block of its own.
    inline: bool = False


def blocks(path):
    """The commands of a document in the order in which they are read: a list for each block, or for each sentence's."""
    text = pathlib.Path(path).read_text()
    found = []
    for fence in FENCE.finditer(text):
        if fence[3].split()[:1] and fence[3].split()[0] in SHELLS:
            place = f"{path}:{line(text, fence.start(4))}"
            found.append((fence.start(), commands(place, fence[4])))
    prose = FENCE.sub(lambda fence: re.sub(r"[^\n]", " ", fence[0]), text)
    for span in SPAN.finditer(prose):
        words = " ".join(span[2].split())
        if is_command(words):
            place = f"{path}:{line(text, span.start())}"
            found.append((span.start(), [Command(place, words, inline=True)]))
    return [block for _, block in sorted(found, key=lambda item: item[0])]


def line(text, offset):
    return text.count("\n", 0, offset) + 1


def is_command(span):
    words = span.split()
    while words and ASSIGNMENT.match(words[0]):
        words.pop(0)
    if len(words) < 2:
        return False
    script = "/" in words[0] and pathlib.Path(words[0]).is_file()
    return script or pathlib.PurePath(words[0]).name in PROGRAMS


def commands(place, text):
    """A block's commands. Where lines have the prompt `$ `, the others are what is printed."""
    prompted = any(row.startswith("$ ") for row in text.splitlines())
    found, pending = [], []
    for row in text.splitlines():
        if pending or not prompted:
            pending.append(row)
        elif row.startswith("$ "):
            pending.append(row[2:])
        elif found:
            last = found[-1]
            last.printed = row if last.printed is None else f"{last.printed}\n{row}"
        if pending and complete("\n".join(pending)):
            command = "\n".join(pending)
            if not all(row.strip() == "" or row.strip().startswith("#") for row in pending):
                found.append(Command(place, command))
            pending = []
    if pending:
        raise SystemExit(f"{place}: a command that does not end: {pending}")
    return found


def complete(text):
    """Whether the shell needs no further line."""
    if text.rstrip().endswith(("\\", "|", "&&", "||")):
        return False
    return subprocess.run([shutil.which("bash"), "-n", "-c", text], capture_output=True).returncode == 0
