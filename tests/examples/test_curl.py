"""Runs every script in examples/curl and reads what it prints."""

import os
import subprocess
import tempfile
import unittest

from example_service import EXAMPLES, address, stop

tearDownModule = stop


def run(script, *arguments):
    """What the script prints; its exit status and its messages."""
    environment = {**os.environ, "VERNE_SERVER": address()}
    command = [str(EXAMPLES / "curl" / script), *arguments]
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120)


class Curl(unittest.TestCase):
    def said(self, script, *arguments):
        ran = run(script, *arguments)
        self.assertEqual(ran.returncode, 0, f"{script}: {ran.stdout}{ran.stderr}")
        self.assertTrue(ran.stdout.strip(), f"{script} prints something")
        return ran.stdout

    def test_each_script_has_a_test(self):
        scripts = {path.stem for path in (EXAMPLES / "curl").glob("*.sh")}
        tests = {name.removeprefix("test_") for name in dir(self) if name.startswith("test_")}
        self.assertEqual(scripts - tests, set())

    def test_inverse(self):
        self.assertIn("feasible: true", self.said("inverse.sh"))
        self.assertIn("no solution: unreachable", self.said("inverse.sh", "900", "0", "300"))

    def test_forward(self):
        lines = self.said("forward.sh").splitlines()
        self.assertEqual(len(lines), 4, "four assembly modes")
        self.assertEqual(sum("feasible: true" in line for line in lines), 1)

    def test_table(self):
        first, *rows = self.said("table.sh").splitlines()
        self.assertTrue(first.startswith("id,rho1,"), first)
        self.assertEqual(len(rows), len((EXAMPLES / "poses.csv").read_text().splitlines()) - 1)
        self.assertTrue(all(",ok," in row for row in rows), rows)

    def test_points_inside(self):
        lines = self.said("points_inside.sh").splitlines()
        self.assertEqual([line.split(",")[0] for line in lines], ["inside: true", "inside: true", "inside: false"])

    def test_workspace(self):
        with tempfile.TemporaryDirectory() as place:
            self.assertIn("triangles", self.said("workspace.sh", place))
            for name, start in {
                "workspace.glb": b"glTF", "workspace.stl": b"", "slice.svg": b"<svg", "slice.dxf": b"999\n",
            }.items():
                with open(f"{place}/{name}", "rb") as file:
                    content = file.read()
                self.assertTrue(content.startswith(start) and len(content) > 500, f"{name}: {content[:40]}")

    def test_family(self):
        volumes = [float(line.split()[-2]) for line in self.said("family.sh").splitlines()]
        self.assertEqual(volumes, sorted(volumes), "a longer tool has the larger workspace")
        self.assertEqual(len(volumes), 3)

    def test_dexterity(self):
        some, every = (float(line.split()[-2]) for line in self.said("dexterity.sh").splitlines())
        self.assertGreater(some, every)

    def test_error_budget(self):
        first, *contributions = self.said("error_budget.sh").splitlines()
        self.assertRegex(first, r"^tool end: rms 0\.\d+ mm, worst 0\.\d+ mm$")
        sizes = [float(line.split()[-2]) for line in contributions]
        self.assertEqual(sizes, sorted(sizes, reverse=True))

    def test_job(self):
        lines = self.said("job.sh").splitlines()
        self.assertEqual(lines[-2], "succeeded: 100 %")
        self.assertTrue(lines[-1].startswith("volume "))
        # The same request again: the result is stored.
        self.assertEqual(self.said("job.sh").splitlines(), lines[-1:])

    def test_toolpath(self):
        program = self.said("toolpath.sh")
        self.assertTrue(program.rstrip().endswith("M30"), program[-200:])
        refused = run("toolpath.sh", str(EXAMPLES / "dome.cls"), "600")
        self.assertEqual(refused.returncode, 3, refused.stderr)
        self.assertRegex(refused.stderr, r"lines \d+ to \d+: slider2.min by -.* heals it")

    def test_machine(self):
        self.assertRegex(self.said("machine.sh"), r"L1 = 1050 mm: .* m³\nL1 = 1100 mm: .* m³\n")


if __name__ == "__main__":
    unittest.main()
