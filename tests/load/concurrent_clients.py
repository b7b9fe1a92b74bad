"""Many clients that send requests at the same time, and the answers that they got. Used by the tests in this folder."""

import hashlib
import http.client
import json
import queue
import random
import threading
import time

from verne_process import Client

# A job that does not end during a test.
LONG = {"kind": "part", "tool_length": {"from": 1, "to": 500, "step": 1}, "tolerance": 0.05}


def question(i):
    """The i-th of many small requests, of some 10 ms of one core each."""
    return {"kind": ["tool", "part"][i % 2], "tool_length": 10 + i / 20, "tolerance": 50}


class ConcurrentClients:
    """Clients that repeat every request until it is answered, whatever happens to the service.

    Each client uses one of the ports."""

    def __init__(self, ports, jobs, clients):
        self.ports, self.answers, self.faults = ports, {}, []
        self.promised = set()
        self.left = queue.SimpleQueue()
        for i in random.sample(range(jobs), jobs):
            self.left.put(i)
        # Daemons, so that an error elsewhere ends the program.
        self.threads = [
            threading.Thread(target=self.client, args=(seed,), daemon=True) for seed in range(clients)]

    def client(self, seed):
        chance, client = random.Random(seed), Client(self.ports[seed % len(self.ports)])
        while True:
            try:
                i = self.left.get_nowait()
            except queue.Empty:
                return
            preference = chance.choice(["respond-async", "wait=20"])
            while i not in self.answers:
                try:
                    self.ask(client, i, preference)
                except (OSError, http.client.HTTPException):
                    time.sleep(0.05)  # The service is down, or was a moment ago.

    def ask(self, client, i, preference):
        reply = client.ask("POST", "/workspace", question(i), Prefer=preference)
        if reply.status == 503:
            return time.sleep(0.1)
        if reply.status == 202:
            path = reply.headers["Location"]
            self.promised.add(path)
            if not self.ended(client, path):
                return None
            reply = client.ask("GET", path.replace("/jobs/", "/workspace/"))
        if reply.status != 200:
            self.faults.append((i, reply.status, reply.body))
            return time.sleep(0.1)
        mesh = client.ask("GET", reply.json()["links"]["mesh"])
        if mesh.status == 200:
            self.answers[i] = reply.json()["id"], hashlib.sha256(reply.body + mesh.body).hexdigest()
        return None

    def ended(self, client, path):
        """Reads the events of a job to their end; returns whether the job has a result."""
        reply = client.ask("GET", f"{path}/events")
        if reply.status == 503:
            time.sleep(0.1)
            return False
        if reply.status != 200:
            self.faults.append((path, reply.status, reply.body))
            return False
        events = [line for line in reply.body.splitlines() if line.startswith(b"data: ")]
        job = json.loads(events[-1].removeprefix(b"data: "))
        if job["state"] in ("failed", "cancelled"):
            self.faults.append(job)
        return job["state"] == "succeeded"


def listed(client):
    """Every job of GET /jobs."""
    jobs, after = [], ""
    while True:
        page = client.ask("GET", f"/jobs?limit=100{after}").json()
        jobs += page["jobs"]
        if page["next"] is None:
            return jobs
        after = f"&after={page['next']}"


def check(right, fault):
    if not right:
        raise SystemExit(fault)
