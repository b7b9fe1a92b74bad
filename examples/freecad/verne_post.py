"""Post-processor for the CAM workbench of FreeCAD (Path until version 0.21): the program runs on a machine of the VERNE
architecture, whose controller moves the joints and knows neither tool nor part.

It sends the paths to a verne service, which plans the joint motion and checks every limit. The file contains the joint
program. If the machine cannot run the program, no file is written, and an error names the operation, the command, the
limit and the missing amount. Arguments of the job's post-processor:

    --tool-length 120            from the platform to the tool's end, mm; or for each tool: '{"1": 120, "2": 95}'
    --setup '{"z": 560}'         the job's origin on the table: x, y, z in mm, and rotations a, b, c in degrees
    --offsets '{"G55": {...}}'   the same for other work offsets than G54
    --machine verne              the name of a machine that the service has
    --table-clearance 0          least height over the table, mm; without it the table is not checked
    --axes X,Y,Z,A,C             the axes of the controller for rho1, rho2, rho3, theta1, theta2
    --server http://127.0.0.1:8080

The environment variable VERNE_KEY has the API key if the service needs one.
"""

import argparse
import json
import os
import re
import shlex
import time
import urllib.error
import urllib.parse
import urllib.request

TOOLTIP = __doc__
TOOLTIP_ARGS = "see above"

WORDS = "XYZIJKRQPLSF"
CODE = re.compile(r"([GM])0*(\d+(?:\.\d+)?)$")
MOVES = {"G0", "G1", "G2", "G3"}
COOLANT = {"Mist": "M7", "Flood": "M8"}
# Seconds between two looks at a job, if the service does not say how many.
PAUSE = 1.0


class PostError(Exception):
    """The machine cannot run the program, or the service cannot read it."""


def export(objectslist, filename, argstring):
    """Writes the joint program to the file, or only returns it if the file's name is `-`."""
    options = arguments(argstring)
    program = Program()
    for item in objectslist:
        base = getattr(item, "Base", None)
        if hasattr(item, "Path") and getattr(item, "Active", True) and getattr(base, "Active", True):
            program.add(item)
    text = joint_program(options, program)
    if filename != "-":
        with open(filename, "w", encoding="utf-8") as file:
            file.write(text)
    return text


def arguments(argstring):
    parser = argparse.ArgumentParser(prog="verne", add_help=False)
    parser.add_argument("--server", default="http://127.0.0.1:8080")
    parser.add_argument("--machine")
    parser.add_argument("--tool-length", required=True)
    parser.add_argument("--setup")
    parser.add_argument("--offsets")
    parser.add_argument("--table-clearance")
    parser.add_argument("--axes")
    try:
        return parser.parse_args(shlex.split(argstring))
    except SystemExit as ended:
        raise PostError(f"Check the arguments of the post-processor. They are:\n{TOOLTIP}") from ended


class Program:
    """The G-code for the service, with the command of FreeCAD that each line is."""

    def __init__(self):
        self.lines, self.sources = [], []
        # The place of the tool; a word is missing until a command states it.
        self.place = {}
        # The controller follows the tip (G43.4) with the length of this tool.
        self.tool, self.length = 1, None
        self.write("G21 G90 G94", "the head")

    def write(self, line, source):
        self.lines.append(line)
        self.sources.append(source)

    def add(self, item):
        """The commands of an operation, a tool controller or a work offset."""
        coolant = COOLANT.get(getattr(item, "CoolantMode", None))
        if coolant:
            self.write(coolant, item.Label)
        for number, command in enumerate(item.Path.Commands, 1):
            self.add_command(command, f"{item.Label}, command {number}")
        if coolant:
            self.write("M9", item.Label)

    def add_command(self, command, source):
        name, words = command.Name, dict(command.Parameters)
        if not name or name.startswith("("):
            return
        if found := CODE.match(name.upper()):
            name = found[1] + found[2]
        if turned := [word for word in "ABC" if word in words]:
            raise PostError(
                f"{source}: it turns the table by {turned[0]}, and its X, Y and Z turn with it. State the orientation "
                "of the part by a, b and c of --setup instead, in a job for each orientation."
            )
        if name == "M6":
            self.tool, self.length, self.place = int(words["T"]), None, {}
            self.write(f"T{self.tool} M6", source)
        elif name in ("G43", "G49"):
            return
        elif name in MOVES:
            self.add_move(name, words, source)
        else:
            self.write(block(name, words), source)

    def add_move(self, name, words, source):
        self.place |= {word: words[word] for word in "XYZ" if word in words}
        if len(self.place) < 3:
            # The first move has to state all of its end: FreeCAD begins with Z alone.
            return
        if self.length != self.tool:
            self.write(f"G43.4 H{self.tool}", source)
            self.length = self.tool
            words |= self.place
        if name == "G0" or not words.get("F", 0) > 0:
            words.pop("F", None)
        self.write(block(name, words), source)


def block(name, words):
    """A line of G-code. FreeCAD counts feeds in mm/s."""
    values = {word: words[word] * (60 if word == "F" else 1) for word in WORDS if word in words}
    return " ".join([name, *(f"{word}{value:.6f}".rstrip("0").rstrip(".") for word, value in values.items())])


def joint_program(options, program):
    """The joint program of the service. Raises PostError where the machine cannot follow."""
    query = {"format": "gcode", "tool_length": options.tool_length}
    for name in ("machine", "setup", "offsets", "table_clearance"):
        if (value := getattr(options, name)) is not None:
            query[name] = value
    url = f"{options.server}/toolpath?{urllib.parse.urlencode(query)}"
    answer = ask(url, program, data="\n".join([*program.lines, "M30", ""]).encode())
    while "state" in answer:
        # The service computes it as a job.
        if answer["state"] in ("failed", "cancelled"):
            raise PostError(f"The job has ended: {answer['state']}. {(answer['error'] or {}).get('detail', '')}")
        time.sleep(PAUSE)
        path = answer["result"] or answer["links"]["self"]
        answer = ask(urllib.parse.urljoin(options.server, path), program)
    if answer["verdict"] != "ok":
        raise PostError(explained(answer, program))
    path = answer["links"]["program"]
    axes = f"?{urllib.parse.urlencode({'axes': options.axes})}" if options.axes else ""
    return ask(urllib.parse.urljoin(options.server, path + axes), program, parse=bytes.decode)


def ask(url, program, data=None, parse=json.loads):
    """The answer of the service."""
    headers = {"Content-Type": "text/plain"} if data else {}
    if key := os.environ.get("VERNE_KEY"):
        headers["Authorization"] = f"Bearer {key}"
    try:
        with urllib.request.urlopen(urllib.request.Request(url, data, headers)) as reply:
            return parse(reply.read())
    except urllib.error.HTTPError as refused:
        raise PostError(refusal(json.loads(refused.read()), program)) from None
    except urllib.error.URLError as unreachable:
        raise PostError(f"No service answers at {url.split('?')[0]}: {unreachable.reason}") from None


def refusal(problem, program):
    """The text of a problem document; its faults name the commands."""
    texts = [problem["detail"]]
    for error in problem.get("errors", []):
        if "line" in error:
            texts.append(f"{place(program, error['line'])}: {error['word']}: {error['detail']}")
    return "\n".join(texts)


def explained(report, program):
    """The limits that the program breaks."""
    texts = ["The machine cannot run this program. No file was written."]
    for failure in report["failures"]:
        first, last = failure["lines"]
        texts.append(
            f"{place(program, first)}" + (f" to {place(program, last)}" if last > first else "")
            + f": {failure['element']} by {-failure['margin']:.3f} {failure['unit']} ({failure['constraint']})"
        )
        if change := failure.get("change"):
            texts.append(f"  It runs if {change['parameter']} changes by {change['delta']:+.3f} mm.")
    return "\n".join(texts)


def place(program, line):
    """The command that a line of the program is."""
    if not 1 <= line <= len(program.lines):
        return "the end"
    return f"{program.sources[line - 1]} ({program.lines[line - 1]})"
