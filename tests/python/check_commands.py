"""Runs every command that the documents print, and compares its answer with the one that the document prints: in a copy
of the repository, as a reader would who has `verne` in the path. commands_not_run.toml lists the commands that are not run,
with the reason.

- `127.0.0.1:8080` is a fresh service; `verne serve` in a block is started, and is the service until the block ends.
- `cargo run -- ...` is the binary that is given.
- ID is a job's, or a workspace's; KEY is the last that `verne key new` has printed.
- Where a sentence only names a command (`verne serve`), it is run with `--help`. So is a script of Python that is not
  run otherwise."""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib

from markdown_commands import blocks

sys.path.append(str(pathlib.Path(__file__).parents[1] / "load"))
from verne_process import Client, Process, free_port  # noqa: E402

ROOT = pathlib.Path(__file__).parents[2]
# Directories of the reader's: they are made below the one where all this runs.
DIRECTORIES = ("/var/lib/verne", "/shared/results", "/backup")
SECONDS = 300
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
# A process that does not end by itself; without a command, verne serves.
SERVES = re.compile(
    r"(?:[A-Z_]+=\S+ +)*verne(?: +(?:serve|worker)\b| +(?=-)| *(?:#.*)?$)(?!.*--(?:help|version|print-config)\b)")


class Reader:
    """Somebody who works through the documents, with a directory and a service of their own."""

    def __init__(self, verne, place):
        self.place = pathlib.Path(place)
        self.work = self.place / "verne"
        self.copy()
        programs = self.place / "bin"
        programs.mkdir()
        (programs / "verne").symlink_to(verne.resolve())
        self.environment = {
            **os.environ,
            "PATH": f"{programs}:{os.environ['PATH']}",
            "XDG_DATA_HOME": str(self.place / "data"),
        }
        for directory in DIRECTORIES:
            (self.place / directory[1:]).mkdir(parents=True)
        self.shell = self.place / "shell"
        self.key = ""
        self.tools = 100
        self.service = self.serve("verne serve --data " + str(self.place / "service"))
        self.provide()

    def copy(self):
        """The repository as it is committed or to be committed, and what has been built and installed in it."""
        for name in listed("--cached", "--others", "--exclude-standard"):
            if (ROOT / name).is_file():
                (self.work / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, self.work / name)
        (self.work / "target").symlink_to(ROOT / "target")

    def provide(self):
        """The files that a reader brings: a machine, and a directory of machines."""
        client = Client(self.service.port)
        machine = client.ask("GET", "/machines/verne").json()["definition"] | {"name": "mine"}
        client.close()
        (self.work / "machines").mkdir(exist_ok=True)
        for path in (self.work / "my-machine.json", self.work / "machines" / "mine.json"):
            path.write_text(json.dumps(machine))

    def serve(self, command):
        """The process that the command starts, ready."""
        port = free_port()
        text = self.filled(command, port)
        # Signals go to the process itself, not to a shell.
        text = f"cd {self.work} && exec env {text}"
        environment = {**self.environment, "VERNE_LISTEN": f"127.0.0.1:{port}"}
        process = Process(port, "bash", "-c", text, environment=environment)
        return process.start()

    def filled(self, text, port):
        """The command, with what stands for something put in its place."""
        text = re.sub(r"(?:127\.0\.0\.1|0\.0\.0\.0|localhost|\[::1?\]):8080\b", f"127.0.0.1:{port}", text)
        text = re.sub(rf"(?<![\w.])(?:{'|'.join(DIRECTORIES)})\b", lambda found: f"{self.place}{found[0]}", text)
        text = re.sub(r"\bKEY\b", self.key, text)
        return re.sub(r"(?<=/)(jobs|workspace)/ID\b", lambda found: f"{found[1]}/{self.asked(found[1], port)}", text)

    def asked(self, kind, port):
        """The id of a job that has begun, or of a workspace that is computed: another one each time."""
        self.tools += 1
        client = Client(port)
        headers = {"Authorization": f"Bearer {self.key}", "Prefer": "respond-async" if kind == "jobs" else "wait=30"}
        if kind == "jobs":
            question = {"tool_length": self.tools, "phi1": {"from": -20, "to": 20}, "cell": 40}
            reply = client.ask("POST", "/workspace/dexterity", question, **headers)
        else:
            reply = client.ask("POST", "/workspace", {"kind": "part", "tool_length": self.tools}, **headers)
        client.close()
        return reply.json()["id"]

    def resumed(self):
        """Variables and directory as the command before in the same block has left them."""
        return f"[ -e {self.shell} ] && . {self.shell}"

    def kept(self):
        variables = "declare -p | grep -v '^declare -[a-z]*r'; printf 'cd %q\\n' \"$PWD\""
        return f"status=$?; {{ {variables}; }} > {self.shell}; exit $status"

    def run(self, command, port):
        """What the command printed; its fault, if it has one."""
        text = f"{self.resumed()}\n{self.filled(command.text, port)}\n{self.kept()}"
        shell = ["timeout", str(SECONDS), "bash", "-o", "pipefail", "-c", text]
        ran = subprocess.run(
            shell, cwd=self.work, env=self.environment, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if "verne key new" in command.text and ran.returncode == 0:
            self.key = ran.stderr.strip()
        if ran.returncode != 0:
            return f"ended with {ran.returncode}\n{ran.stdout[-2000:]}{ran.stderr[-2000:]}"
        return None if command.printed is None else difference(command.printed.strip(), ran.stdout.strip())


def listed(*options):
    """The names of files that git knows."""
    ran = subprocess.run(["git", "ls-files", "-z", *options], cwd=ROOT, capture_output=True, check=True)
    return list(filter(None, ran.stdout.decode().split("\0")))


def same(printed, said):
    """Whether it is the same answer. Three dots stand for anything, and JSON may have other line breaks."""
    parts = map(re.escape, re.split(r"\.\.\.|…", printed))
    if re.fullmatch(".*?".join(parts), said, re.DOTALL):
        return True
    try:
        return json.loads(printed) == json.loads(said)
    except json.JSONDecodeError:
        return False


def difference(printed, said):
    """What is wrong about the printed answer."""
    if same(printed, said):
        return None
    numbers = list(zip(NUMBER.findall(printed), NUMBER.findall(said)))
    near = all(abs(float(a) - float(b)) <= 1e-12 * max(1, abs(float(b))) for a, b in numbers)
    if near and NUMBER.sub("0", printed) == NUMBER.sub("0", said):
        # Another processor or C library rounds otherwise.
        print(f"  differs in the last digits; here it prints\n{said}")
        return None
    return f"prints\n{said}\ninstead of\n{printed}"


def with_binary(text):
    """The command, with the binary in place of `cargo run`."""
    text = re.sub(r"^cargo run(?: --release| --locked| --quiet)* -- ", "verne ", text)
    return re.sub(r"^cargo run(?: --release| --locked| --quiet)*(?= *#| *$)", "verne serve", text)


def questions_help(command):
    """The command that asks for help, where only that is to be run."""
    words = command.text.split()
    if command.inline and words[0] == "verne" and all(re.fullmatch(r"[a-z][a-z-]*", word) for word in words):
        return " ".join(words) + " --help"
    return None


def script(command):
    """The script of Python that it runs, if any."""
    named = re.search(r"(?:tests|docs|docker)/[\w/]+\.py\b", command.text)
    return named[0] if named and (ROOT / named[0]).is_file() else None


def work_through(reader, block, not_run, used):
    """Runs a block's commands; how many have a fault."""
    service, started, faults = reader.service, [], 0
    reader.shell.unlink(missing_ok=True)
    for command in block:
        shown = command.text.replace("\n", "\n    ")
        fault = None
        reason = next((entry for entry in not_run if re.search(entry["command"], command.text)), None)
        command.text = with_binary(command.text)
        help_only = questions_help(command)
        if reason:
            used.add(reason["command"])
            print(f"{command.place}: not run ({reason['reason']})\n    {shown}", flush=True)
            if name := script(command):
                ran = subprocess.run([sys.executable, name, "--help"], capture_output=True, text=True, timeout=60)
                fault = None if ran.returncode == 0 else f"{name} --help\n{ran.stderr}"
        elif help_only:
            command.text = help_only
            fault = reader.run(command, service.port)
        elif SERVES.match(command.text):
            print(f"{command.place}: started\n    {shown}", flush=True)
            try:
                service = reader.serve(command.text)
                started.append(service)
            except SystemExit as refused:
                fault = str(refused)
        else:
            print(f"{command.place}\n    {shown}", flush=True)
            fault = reader.run(command, service.port)
        if fault:
            faults += 1
            print(f"FAULT: {command.place}: {command.text}\n{fault}", flush=True)
    for process in started:
        if process.terminate()[0] != 0:
            faults += 1
            print(f"FAULT: {block[0].place}: the service does not end with 0")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("verne", type=pathlib.Path)
    parser.add_argument("documents", nargs="*", help="all of the repository, but for the changelog")
    options = parser.parse_args()
    os.chdir(ROOT)
    documents = options.documents or [name for name in listed("*.md") if name != "CHANGELOG.md"]
    not_run = tomllib.loads((pathlib.Path(__file__).parent / "commands_not_run.toml").read_text())["command"]
    used, faults, count = set(), 0, 0
    with tempfile.TemporaryDirectory() as place:
        reader = Reader(options.verne, place)
        try:
            for document in documents:
                for block in blocks(document):
                    count += len(block)
                    faults += work_through(reader, block, not_run, used)
        finally:
            reader.service.kill()
    for entry in not_run:
        if not options.documents and entry["command"] not in used:
            print(f"commands_not_run.toml: no document has a command like {entry['command']} any more")
    print(f"{count} commands, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
