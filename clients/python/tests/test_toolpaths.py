"""Programs and tool paths."""

from __future__ import annotations

import asyncio
from pathlib import Path

import numpy as np
import pandas
import pytest

import verne

JOINTS = ("rho1", "rho2", "rho3", "theta1", "theta2")
LINE = b"UNITS/MM\nRAPID\nGOTO/-150,0,300\nFEDRAT/1000,MMPM\nGOTO/150,0,300\n"


@pytest.fixture(scope="module")
def path(client: verne.Client, dome: Path) -> verne.ToolpathJob:
    return client.toolpath(dome, tool_length=120, setup={"z": 560})


def test_forward_of_the_rows_is_the_path(client: verne.Client, path: verne.ToolpathJob) -> None:
    report, rows = path.result(), path.rows()
    assert report.verdict == "ok"
    assert len(rows) == report.rows
    poses = client.fk_batch(rows.to_numpy(*JOINTS), tool_length=120)
    np.testing.assert_allclose(poses.part[:, :3], rows.to_numpy("x", "y", "z"), atol=1e-6)
    np.testing.assert_allclose(rows["margin"].min(), min(poses.margin), atol=1e-6)


def test_rows_are_selected(path: verne.ToolpathJob) -> None:
    every = path.rows()
    assert path.rows(10, 20).to_arrow() == every.to_arrow().slice(10, 10)
    assert set(every["kind"]) >= {"rapid", "feed"}


def test_a_joint_program_and_a_path(path: verne.ToolpathJob) -> None:
    text = path.program(axes="X,Y,Z,-A,C", length_decimals=5, head="%", source_lines=True)
    assert text.startswith("%")
    assert "G93" in text
    assert path.path().startswith(b"glTF")


def test_a_program_that_fails_says_where_and_has_no_joint_program(client: verne.Client, dome: Path) -> None:
    job = client.toolpath(str(dome), tool_length=120, setup={"z": 600})
    failure = job.result().failures[0]
    assert failure.margin < 0
    assert failure.change is not None
    healed = client.toolpath(dome, tool_length=120, setup={"z": 600 + failure.change.delta})
    assert failure.lines not in [other.lines for other in healed.result().failures]
    with pytest.raises(verne.Problem) as caught:
        job.program()
    assert caught.value.code == "no_joint_program"


def test_points_are_a_program(client: verne.Client) -> None:
    frame = pandas.DataFrame({"x": [-150.0, 150.0], "y": 0.0, "z": 300.0, "feed": [None, 1000.0]})
    points = client.toolpath(frame, tool_length=100).result()
    file = client.toolpath(LINE, format="apt", tool_length=100).result()
    assert points.length.feed + points.length.rapid == pytest.approx(file.length.feed)
    array = client.toolpath(np.array([[-150.0, 0, 300, 0, 0], [150, 0, 300, 0, 0]]), tool_length=100).result()
    assert array.ranges == points.ranges


def test_a_program_that_was_sent_before_is_read_with_its_options(client: verne.Client) -> None:
    text = b"G21\nM428\nG0 X0 Y0 Z320 A0 C0\nG1 Z300 A10 C45 F1000\nM429\nM30\n"
    program = client.program(text, format="gcode", tcp_on=["M428"], tcp_off=["M429"], units="mm")
    assert program.moves == 2
    start = client.ik(0, 0, 320, tool_length=100).solutions[0].joints
    report = client.toolpath(program, tool_length={1: 100.0}, length_before=1, start=start).result()
    assert report.program == program.id


def test_faults_have_line_column_and_word(client: verne.Client) -> None:
    with pytest.raises(verne.Problem) as caught:
        client.program(b"UNITS/MM\nGOTO/0,zero,320\n", format="apt")
    assert caught.value.code == "program_fault"
    fault = caught.value.errors[0]
    assert (fault.line, fault.pointer) == (2, None)
    assert fault.column is not None
    assert fault.word
    assert "line 2" in str(fault)


def test_a_format_is_stated_or_has_an_extension(client: verne.Client) -> None:
    with pytest.raises(ValueError, match="format"):
        client.program(LINE)
    with pytest.raises(ValueError, match="format"):
        client.program("part.txt")


def test_the_asynchronous_client_has_the_same_answers(
    client: verne.Client, path: verne.ToolpathJob, dome: Path
) -> None:
    async def ask() -> tuple[verne.ToolpathReport, verne.Table, str]:
        async with verne.AsyncClient(client.url) as asynchronous:
            job = await asynchronous.toolpath(dome, tool_length=120, setup={"z": 560})
            return await job.result(), await job.rows(), await job.program()

    report, rows, program = asyncio.run(ask())
    assert (report, program) == (path.result(), path.program())
    assert rows.to_arrow() == path.rows().to_arrow()
