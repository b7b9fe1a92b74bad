"""Two API nodes and several workers with a broker and an S3 store. The script kills workers, kills a broker and starts
it again, and the store refuses a tenth of the writes: every job must end, and every answer must equal that of one
undisturbed process.

    test_many_processes.py VERNE NATS_SERVER [--jobs N] [--clients N] [--workers N] [--brokers N] [--every SECONDS]"""

import argparse
import hashlib
import os
import tempfile
import threading
import time

from concurrent_clients import LONG, ConcurrentClients, check, listed
from cluster import Cluster
from verne_process import Client, Service

MAP = {"tool_length": 50, "phi1": {"from": -30, "to": 30}, "cell": 120}
FAMILY = {"kind": "part", "tool_length": [20, 40, 60], "phi1": {"from": -20, "to": 20, "step": 10}, "tolerance": 5}
ORIGINS = {"program": {"points": [[-60, -40, 0], [60, -40, 10], [60, 50, 0, 0.2, 0.15, 1]]}, "tool_length": 100,
           "cell": 40}
SHARE = 0.1


def run(ports, jobs, clients, disturb=None):
    """All answers, and those to the requests that are split into subtasks."""
    clients_at_work = ConcurrentClients(ports, jobs, clients)
    over = threading.Event()
    disturbing = threading.Thread(target=disturb, args=(clients_at_work, over), daemon=True) if disturb else None
    for thread in [*clients_at_work.threads, *([disturbing] if disturbing else [])]:
        thread.start()
    client = Client(ports[0])
    files = ["cells", "mesh?set=reachable", "mesh?set=dexterous"]
    split_answers = [whole_answer(client, "/workspace/dexterity", MAP, files),
                     whole_answer(client, "/workspace", FAMILY, []),
                     whole_answer(client, "/toolpath/origins", ORIGINS, ["mesh.glb", "slice.json?z=300"])]
    for thread in clients_at_work.threads:
        thread.join()
    over.set()
    if disturbing:
        disturbing.join()
    return clients_at_work, split_answers


def whole_answer(client, path, question, parts):
    """The hash of an answer with its files; repeats the request until it is answered."""
    while True:
        try:
            replies = [client.ask("POST", path, question, Prefer="wait=20")]
            if replies[0].status == 200:
                kept = replies[0].json()["links"]["self"]
                replies += [client.ask("GET", f"{kept}/{part}") for part in parts]
            if all(reply.status == 200 for reply in replies):
                return hashlib.sha256(b"".join(reply.body for reply in replies)).hexdigest()
            check(all(reply.status in (200, 202, 503) for reply in replies), [r.body[:300] for r in replies])
        except OSError:
            pass
        time.sleep(0.1)


class Disturbance:
    """Kills workers and brokers of a cluster while clients send requests."""

    def __init__(self, cluster, jobs, every):
        self.cluster, self.jobs, self.every, self.killed, self.brokers = cluster, jobs, every, 0, 0

    def __call__(self, clients_at_work, over):
        while not over.wait(self.every):
            self.cluster.kill_a_worker()
            self.killed += 1
            if self.brokers < 2 and len(clients_at_work.answers) > self.jobs * (self.brokers + 1) // 4:
                self.cluster.brokers.kill_one()
                self.brokers += 1


def cancelled_after(cluster):
    """Seconds from DELETE until a running job has ended and its worker is idle."""
    client = Client(cluster.nodes[0].port)
    path = client.ask("POST", "/workspace", LONG, Prefer="respond-async").headers["Location"]
    while client.ask("GET", path).json()["progress"] == 0:
        time.sleep(0.01)
    other = Client(cluster.nodes[-1].port)
    began = time.monotonic()
    check(other.ask("DELETE", path).status == 200, "DELETE at the other node")
    while client.ask("GET", path).json()["state"] != "cancelled" or any(map(busy, cluster.workers)):
        check(time.monotonic() - began < 60, "a cancelled job goes on")
        time.sleep(0.01)
    return time.monotonic() - began


def metric(process, name):
    text = Client(process.port).ask("GET", "/metrics").body.decode()
    return float(next(line.split()[1] for line in text.splitlines() if line.startswith(f"verne_{name} ")))


def busy(worker):
    return metric(worker, "worker_seats_busy") > 0


def stopped(cluster):
    """Stops a worker during a long job, which another worker continues; returns the seconds until the worker exits."""
    client = Client(cluster.nodes[0].port)
    path = client.ask("POST", "/workspace", {**LONG, "phi1": 1}, Prefer="respond-async").headers["Location"]
    while not busy(cluster.workers[0]):
        time.sleep(0.01)
    code, seconds = cluster.workers[0].terminate()
    check(code == 0, f"SIGTERM: a worker exits with {code}")
    before = client.ask("GET", path).json()["progress"]
    while client.ask("GET", path).json()["progress"] <= before:
        time.sleep(0.01)
    client.ask("DELETE", path)
    cluster.workers[0].start()
    return seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("verne")
    parser.add_argument("nats_server")
    parser.add_argument("--jobs", type=int, default=200)
    parser.add_argument("--clients", type=int, default=8)
    parser.add_argument("--workers", type=int, default=4)
    parser.add_argument("--brokers", type=int, default=1)
    parser.add_argument("--every", type=float, default=5)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        alone = Service(options.verne, os.path.join(place, "alone")).start()
        undisturbed, split_answers = run([alone.port], options.jobs, options.clients)
        alone.kill()
        cluster = Cluster(options.verne, options.nats_server, place, 2, options.workers, SHARE, options.brokers)
        disturbance = Disturbance(cluster, options.jobs, options.every)
        began = time.monotonic()
        asked, same_split_answers = run(cluster.ports(), options.jobs, options.clients, disturbance)
        print(f"{options.jobs} jobs on {options.workers} workers in {time.monotonic() - began:.1f} s: "
              f"{disturbance.killed} workers and {disturbance.brokers} brokers lost, "
              f"{cluster.objects.refused()} writes refused")
        check(disturbance.killed and disturbance.brokers and cluster.objects.refused(), "nothing was disturbed")
        check(not undisturbed.faults + asked.faults, f"faults: {undisturbed.faults[:3]} {asked.faults[:3]}")
        check(asked.answers == undisturbed.answers, "answers differ from those of one process")
        check(same_split_answers == split_answers, "what was merged differs from what one process makes")
        for worker in cluster.workers:
            worker.ready()
        for process in cluster.nodes + cluster.workers:
            health = Client(process.port).ask("GET", "/readyz").json()
            check("broker" not in health.get("failing", []), "the broker forbids something that jobs need")
        jobs = listed(Client(cluster.nodes[1].port))
        check(all(job["state"] == "succeeded" for job in jobs), "a job has not ended well")
        missing = {id for id, _ in asked.answers.values()} - {job["id"] for job in jobs}
        check(not missing, f"{len(missing)} jobs are lost")
        print(f"DELETE: ended, and the workers idle, after {cancelled_after(cluster):.2f} s")
        print(f"SIGTERM in the midst of a job: a worker exits after {stopped(cluster):.1f} s, the job goes on")
    print(f"{len(asked.answers)} answers, all the same")


main()
