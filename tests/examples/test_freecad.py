"""The post-processor for FreeCAD: with stand-ins for FreeCAD's objects, and in a real FreeCAD where one is installed.

FreeCAD and what it needs take 1.3 GB, so tests/run does not install it. The stand-ins are those parts of an operation
that the post-processor reads: the label, and the names and parameters of the commands (`Path.Command`)."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import types
import unittest

from example_service import EXAMPLES, address, stop

sys.path.append(str(EXAMPLES / "freecad"))
import verne_post  # noqa: E402

tearDownModule = stop
SETUP = "--tool-length 120 --setup '{\"z\": 300}'"


def operation(label, *commands, **properties):
    listed = [types.SimpleNamespace(Name=name, Parameters=parameters) for name, parameters in commands]
    return types.SimpleNamespace(Label=label, Path=types.SimpleNamespace(Commands=listed), **properties)


def controller(number):
    return operation(f"TC {number}", ("(TC)", {}), ("M6", {"T": float(number)}), ("M3", {"S": 9000.0}))


def milling(*more, x=30.0, **properties):
    """An operation as FreeCAD makes it: feeds in mm/s, K in arcs, and Z before X and Y."""
    return operation(
        "Outline",
        ("(Outline)", {}),
        ("G0", {"Z": 26.0, "F": 0.0}),
        ("G0", {"X": x, "Y": 0.0}),
        ("G1", {"X": x, "Y": 0.0, "Z": 20.0, "F": 5.0}),
        ("G2", {"X": 0.0, "Y": -x, "Z": 20.0, "I": -x, "J": 0.0, "K": 0.0, "F": 15.0}),
        ("G1", {"X": -x, "Y": -x, "Z": 20.0, "F": 15.0}),
        *more,
        **properties,
    )


def posted(objects, arguments=SETUP):
    return verne_post.export(objects, "-", f"--server {address()} {arguments}")


class Post(unittest.TestCase):
    def test_a_job_becomes_a_joint_program(self):
        with tempfile.TemporaryDirectory() as place:
            file = pathlib.Path(place) / "job.ngc"
            text = verne_post.export([controller(1), milling()], str(file), f"--server {address()} {SETUP}")
            self.assertEqual(file.read_text(), text)
        self.assertIn("G93", text)
        self.assertTrue(text.rstrip().endswith("M30"), text[-100:])
        self.assertIn("M3", text)

    def test_the_axes_are_those_of_the_arguments(self):
        text = posted([controller(1), milling()], f"{SETUP} --axes U,V,W,B,C")
        self.assertRegex(text, r"\nG1 .*U\d.*V\d.*W\d")

    def test_drilling_coolant_and_two_tools_are_posted(self):
        holes = operation(
            "Holes",
            ("G0", {"Z": 26.0}),
            ("G0", {"X": 10.0, "Y": 10.0}),
            ("G83", {"X": 10.0, "Y": 10.0, "Z": 5.0, "R": 22.0, "Q": 4.0, "F": 2.0}),
            ("G83", {"X": -10.0, "Y": 10.0, "Z": 5.0, "R": 22.0, "Q": 4.0, "F": 2.0}),
            ("G80", {}),
            CoolantMode="Flood",
        )
        lengths = "--tool-length '{\"1\": 120, \"4\": 90}' --setup '{\"z\": 300}'"
        text = posted([controller(1), milling(), controller(4), holes], lengths)
        for word in ("T1", "T4", "M8", "M9"):
            self.assertIn(word, text)

    def test_an_inactive_operation_is_left_out(self):
        unreachable = milling(x=5000.0, Active=False)
        self.assertEqual(posted([controller(1), milling(), unreachable]), posted([controller(1), milling()]))

    def test_a_broken_limit_names_operation_command_limit_amount_and_remedy(self):
        with tempfile.TemporaryDirectory() as place:
            file = pathlib.Path(place) / "job.ngc"
            with self.assertRaises(verne_post.PostError) as caught:
                arguments = f"--server {address()} --tool-length 120 --setup '{{\"z\": 700}}'"
                verne_post.export([controller(1), milling()], str(file), arguments)
            self.assertFalse(file.exists())
        message = str(caught.exception)
        self.assertRegex(message, r"Outline, command \d \(G\d .*\).*: slider\d\.min by \d+\.\d+ mm \(stroke\)")
        self.assertRegex(message, r"It runs if setup\.z changes by -\d+\.\d+ mm")

    def test_a_word_that_the_service_cannot_read_names_its_command(self):
        with self.assertRaisesRegex(verne_post.PostError, r"Outline, command 7 \(G38\.2 Z10 F60\)"):
            posted([controller(1), milling(("G38.2", {"Z": 10.0, "F": 1.0}))])

    def test_rotary_words_are_refused(self):
        with self.assertRaisesRegex(verne_post.PostError, r"Outline, command 7: it turns the table by A"):
            posted([controller(1), milling(("G0", {"A": 30.0}))])

    def test_wrong_arguments_and_an_unreachable_service_are_explained(self):
        with self.assertRaisesRegex(verne_post.PostError, "--tool-length"):
            posted([milling()], "--setup '{}'")
        with self.assertRaisesRegex(verne_post.PostError, "No service answers at http://127.0.0.1:1/toolpath"):
            verne_post.export([milling()], "-", "--server http://127.0.0.1:1 --tool-length 120")
        with self.assertRaisesRegex(verne_post.PostError, "no machine has this name|machine"):
            posted([milling()], f"{SETUP} --machine nobody")


class RealFreeCad(unittest.TestCase):
    @unittest.skipUnless(shutil.which("freecadcmd") or "FREECADCMD" in os.environ, "FreeCAD is not installed")
    def test_a_job_of_freecad_is_posted(self):
        program = os.environ.get("FREECADCMD", "freecadcmd")
        script = pathlib.Path(__file__).with_name("freecad_job.py")
        with tempfile.TemporaryDirectory() as place:
            file = pathlib.Path(place) / "job.ngc"
            environment = {
                **os.environ, "VERNE_EXAMPLES": str(EXAMPLES), "VERNE_SERVER": address(),
                "VERNE_ARGUMENTS": SETUP, "VERNE_OUTPUT": str(file),
            }
            ran = subprocess.run(
                [program, str(script)], env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                timeout=300)
            self.assertIn("posted", ran.stdout.splitlines()[-1:], ran.stdout[-3000:] + ran.stderr[-2000:])
            self.assertTrue(file.read_text().rstrip().endswith("M30"))


if __name__ == "__main__":
    unittest.main()
