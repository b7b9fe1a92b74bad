"""The joint motion of a computed tool path. Each operation waits for its job."""

from __future__ import annotations

from typing import Literal

from verne.answers.toolpath import ToolpathReport
from verne.arrow_stream import read_stream
from verne.operations.jobs import Submission, fetch
from verne.session import Numbers, Operation
from verne.table import Table


def rows(job: Submission[ToolpathReport], first: int = 0, end: int | None = None) -> Operation[Table]:
    """The joint motion. Between two rows all joints move linearly.

    Args:
        first: Index of the first row.
        end: Index of the row before which the answer ends; by default the number of rows.

    Returns:
        A table with the columns line, kind, x, y, z (mm), i, j, k, rho1, rho2, rho3 (mm), theta1, theta2 (degrees),
        duration (s), margin, constraint and element.
    """
    report = yield from job.result()
    request = job.session.get(report.links.rows, format="arrow", **{"from": first, "to": end})
    response = yield from fetch(job.session, request)
    return Table(read_stream(response.content))


def joint_program(
    job: Submission[ToolpathReport],
    *,
    axes: str | None = None,
    axis_offsets: Numbers | None = None,
    length_decimals: int | None = None,
    angle_decimals: int | None = None,
    feed_word: Literal["inverse_time", "per_minute"] | None = None,
    greatest_feed: float | None = None,
    rapid_word: Literal["g0", "g1"] | None = None,
    numbers: int | None = None,
    head: str | None = None,
    foot: str | None = None,
    source_lines: bool = False,
) -> Operation[str]:
    """The joint program: G-code with a word for each joint.

    Args:
        axes: Axes of the controller that move rho1, rho2, rho3, theta1 and theta2; by default ``X,Y,Z,A,C``. A minus
            before a letter says that the axis counts against the joint.
        axis_offsets: Words of the axes where their joints are zero: three numbers in mm, and perhaps two in degrees.
        length_decimals: Decimals of words in mm; by default 4.
        angle_decimals: Decimals of words in degrees; by default 5.
        feed_word: ``inverse_time`` (G93, the default), or ``per_minute`` (G94), the speed of the tip.
        greatest_feed: The greatest F.
        rapid_word: Word of rapids.
        numbers: Step of the numbers of blocks; by default blocks have no numbers.
        head: Lines before all others.
        foot: The last lines; by default ``M30``.
        source_lines: Whether comments name the lines of the program.

    Raises:
        Problem: ``no_joint_program``: the machine cannot run the program, or a feed move has no duration.
    """
    report = yield from job.result()
    request = job.session.get(
        f"toolpath/{report.id}/program",
        axes=axes,
        axis_offsets=axis_offsets,
        length_decimals=length_decimals,
        angle_decimals=angle_decimals,
        feed_word=feed_word,
        greatest_feed=greatest_feed,
        rapid_word=rapid_word,
        numbers=numbers,
        head=head,
        foot=foot,
        source_lines=source_lines or None,
    )
    return (yield from fetch(job.session, request)).text


def path(job: Submission[ToolpathReport], *, least: float = 0.0, greatest: float = 0.25) -> Operation[bytes]:
    """The path of the tool end in the part frame as lines in a GLB, coloured by the worst margin.

    Args:
        least: Fraction of the limit's range that is yellow, as smaller ones are.
        greatest: Fraction of the limit's range that is dark blue, as greater ones are.
    """
    report = yield from job.result()
    request = job.session.get(report.links.path, least=least, greatest=greatest)
    return (yield from fetch(job.session, request)).content
