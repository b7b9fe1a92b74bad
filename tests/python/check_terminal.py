"""Runs verne with a terminal as its standard output, as its users do: check_terminal.py VERNE. Answers are tables there,
as wide as the terminal, with colours unless NO_COLOR is set; in a pipe they are JSON."""

import fcntl
import json
import os
import pty
import struct
import subprocess
import sys
import termios

IK = ["ik", "--x", "100", "--y", "50", "--z", "300"]
ESCAPE = "\x1b"


def on_terminal(verne: str, arguments: list[str], columns: int, **environment: str) -> str:
    """What the command writes to a terminal."""
    terminal, end = pty.openpty()
    fcntl.ioctl(end, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    inherited = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "CLICOLOR")}
    process = subprocess.Popen(
        [verne, *arguments], stdin=end, stdout=end, env={**inherited, "TERM": "xterm", **environment})
    os.close(end)
    text = b""
    while True:
        try:
            piece = os.read(terminal, 65536)
        except OSError:
            # Linux ends a terminal without writers in this way.
            break
        if not piece:
            break
        text += piece
    os.close(terminal)
    assert process.wait() == 0, arguments
    return text.decode().replace("\r\n", "\n")


def main() -> None:
    verne = sys.argv[1]
    piped = subprocess.run([verne, *IK], check=True, stdout=subprocess.PIPE, text=True).stdout
    joints = json.loads(piped)["solutions"][0]["joints"]

    coloured = on_terminal(verne, IK, 120)
    assert coloured.startswith(f"{ESCAPE}[1mverne: 1 solution{ESCAPE}[0m\n"), coloured
    plain = on_terminal(verne, IK, 120, NO_COLOR="1")
    assert ESCAPE not in plain and plain.startswith("verne: 1 solution\n"), plain
    assert ESCAPE not in on_terminal(verne, IK, 120, TERM="dumb")
    row = plain.splitlines()[2].split()
    assert row[1:4] == [f"{rho:.3f}" for rho in joints["rho"]], row

    narrow = on_terminal(verne, IK, 50, NO_COLOR="1")
    assert f"  rho1         {joints['rho'][0]:.3f}\n" in narrow, narrow
    for flag in ("--json", "--pretty"):
        assert json.loads(on_terminal(verne, [*IK, flag], 120)) == json.loads(piped), flag
    # The commands that print files and pages print them on a terminal as well.
    assert on_terminal(verne, ["completions", "bash"], 80).startswith("_verne()")
    print("Answers on a terminal are tables, in a pipe JSON.")


if __name__ == "__main__":
    main()
