"""Looks for known faults in what Cargo.lock and the package-lock.json of the viewer and its client name:
python check_advisories.py CARGO_DENY

A fault ends it with 1, as does anything else that is wrong, but for one thing: a database that is not reached is said, and
is no fault."""

import argparse
import json
import os
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")


def run(*command):
    return subprocess.run(command, cwd=ROOT, text=True, capture_output=True)


def crates(cargo_deny):
    """Whether there is no fault; `None`: the database was not reached. All it says."""
    ran = run(cargo_deny, "--locked", "--color=never", "check", "advisories")
    told = ran.stdout + ran.stderr
    if ran.returncode == 0:
        return True, told
    # It fetches before it checks, and says at the end how a check went.
    checked = "advisories FAILED" in told
    return (None if "failed to fetch advisory database" in told and not checked else False), told


def packages(directory):
    """The same of an npm package."""
    options = ["--json", "--package-lock-only", "--fetch-retries=0", f"--prefix={directory}"]
    ran = run("npm", "audit", *options)
    told = ran.stdout + ran.stderr
    if ran.returncode == 0:
        return True, told
    try:
        answer = json.loads(ran.stdout)
    except json.JSONDecodeError:
        return False, told
    # A report is from who was reached. Without one: no answer at all, or that of a mirror that has no such database.
    silent = answer.get("statusCode") in (None, 404, 405, 501, 502, 503, 504)
    away = "auditReportVersion" not in answer and "audit endpoint returned an error" in ran.stderr and silent
    return (None if away else False), told


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cargo_deny")
    options = parser.parse_args()
    sound = True
    checks = [("crates", crates(options.cargo_deny))]
    checks += [(f"packages of {directory}", packages(directory)) for directory in ("src/viewer", "clients/typescript")]
    for name, (none_found, told) in checks:
        if none_found:
            print(f"{name}: no known faults")
        elif none_found is None:
            print(f"{name}: the database of advisories was not reached\n{told}")
        else:
            sound = False
            print(f"{name}: faults\n{told}")
    sys.exit(not sound)


main()
