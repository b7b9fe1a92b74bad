"""Problem documents, API keys and retries."""

from __future__ import annotations

import asyncio
import email.utils
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import httpx
import pytest

import verne
from verne.operations.publications import machines
from verne.session import LONGEST_PAUSE, Pause, Session

MACHINES: dict[str, list[str]] = {"machines": []}


def test_a_bad_field_has_a_pointer(client: verne.Client) -> None:
    with pytest.raises(verne.Problem) as caught:
        client.ik(1e9, 0, -1e9)
    problem = caught.value
    assert (problem.code, problem.status) == ("invalid_request", 422)
    assert [error.pointer for error in problem.errors] == ["/pose/x", "/pose/z"]
    assert problem.request_id is not None
    assert all(error.detail in str(problem) for error in problem.errors)


def test_an_unknown_machine_has_a_code(client: verne.Client) -> None:
    with pytest.raises(verne.Problem) as caught:
        client.machine("none")
    assert (caught.value.code, caught.value.status, caught.value.errors) == ("machine_not_found", 404, [])


def test_a_number_that_is_none_is_refused_before_it_is_sent(client: verne.Client) -> None:
    with pytest.raises(ValueError, match="JSON"):
        client.ik(float("nan"), 0, 400)


def test_keys(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    command = [str(verne.find_binary()), "key", "new", "--name", "reader", "--role", "read"]
    made = subprocess.run(command, capture_output=True, text=True, check=True)
    keys = tmp_path / "keys.toml"
    keys.write_text(made.stdout)
    keys.chmod(0o600)
    monkeypatch.setenv("VERNE_KEYS", str(keys))
    with verne.local() as stranger:
        with pytest.raises(verne.Problem) as caught:
            stranger.machines()
        assert caught.value.code == "unauthorized"
        with verne.Client(stranger.url, api_key=made.stderr.strip()) as reader:
            assert reader.machines()


class Answers:
    """Answers to requests in their order; the last one to all further requests."""

    def __init__(self, *answers: httpx.Response) -> None:
        self.answers = list(answers)
        self.requests: list[httpx.Request] = []

    def __call__(self, request: httpx.Request) -> httpx.Response:
        self.requests.append(request)
        return self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]


def overloaded(retry_after: str | None) -> httpx.Response:
    document = {"type": "about:blank", "title": "", "status": 503, "code": "overloaded", "detail": "later"}
    headers = {"content-type": "application/problem+json"} | ({"retry-after": retry_after} if retry_after else {})
    return httpx.Response(503, headers=headers, json=document)


def ask(answers: Callable[[httpx.Request], httpx.Response], retries: int) -> list[verne.MachineEntry]:
    with httpx.Client(transport=httpx.MockTransport(answers)) as http:
        return verne.Client("http://service/below", retries=retries, http=http).machines()


def ask_async(answers: Callable[[httpx.Request], httpx.Response], retries: int) -> list[verne.MachineEntry]:
    async def run() -> list[verne.MachineEntry]:
        async with httpx.AsyncClient(transport=httpx.MockTransport(answers)) as http:
            return await verne.AsyncClient("http://service/below", retries=retries, http=http).machines()

    return asyncio.run(run())


@pytest.mark.parametrize("run", [ask, ask_async])
def test_a_request_is_repeated_until_it_succeeds(
    run: Callable[[Callable[[httpx.Request], httpx.Response], int], list[verne.MachineEntry]],
) -> None:
    answers = Answers(overloaded("0"), overloaded("0"), httpx.Response(200, json=MACHINES))
    assert run(answers, 2) == []
    assert [str(request.url) for request in answers.requests] == ["http://service/below/machines"] * 3
    answers = Answers(overloaded("0"))
    with pytest.raises(verne.Problem, match="later"):
        run(answers, 2)
    assert len(answers.requests) == 3


@pytest.mark.parametrize("retry_after", [None, "soon", str(LONGEST_PAUSE + 1)])
def test_a_request_is_not_repeated_without_a_reasonable_time(retry_after: str | None) -> None:
    answers = Answers(overloaded(retry_after))
    with pytest.raises(verne.Problem):
        ask(answers, 5)
    assert len(answers.requests) == 1


@pytest.mark.parametrize("date", [False, True])
def test_the_pause_is_the_one_that_the_service_asks_for(date: bool) -> None:
    operation = machines(Session("http://service", None, 1))
    next(operation)
    pause = operation.send(overloaded(email.utils.formatdate(time.time() + 30, usegmt=True) if date else "30"))
    assert isinstance(pause, Pause)
    assert 28 < pause.seconds <= 30


def test_an_answer_of_a_proxy_is_a_problem_without_code() -> None:
    with pytest.raises(verne.Problem, match="Bad Gateway") as caught:
        ask(Answers(httpx.Response(502, text="<html>Bad Gateway</html>")), 1)
    assert (caught.value.code, caught.value.status) == (None, 502)


def test_another_answer_than_the_expected_one_is_a_decoding_error() -> None:
    with pytest.raises(verne.DecodingError, match="MachineEntry"):
        ask(Answers(httpx.Response(200, json={"machines": [{"name": 1}]})), 0)
