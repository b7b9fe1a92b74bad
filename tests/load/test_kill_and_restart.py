"""Many clients send requests to a service that is killed (SIGKILL) and started again on the same data directory: no job
may be lost, and every answer must equal that of an undisturbed service. Then the script backs up the jobs, restores
them elsewhere, and stops the service (SIGTERM) while it computes.

    test_kill_and_restart.py VERNE [--jobs N] [--clients N] [--kills N]"""

import argparse
import os
import sqlite3
import tempfile
import time

from concurrent_clients import LONG, ConcurrentClients, check, listed
from verne_process import Client, Service

DRAIN = 10  # Seconds, the service's default.


def run(service, jobs, clients, kills):
    """All answers; the service is killed so many times on the way."""
    clients_at_work = ConcurrentClients([service.port], jobs, clients)
    for thread in clients_at_work.threads:
        thread.start()
    for k in range(kills):
        while len(clients_at_work.answers) < jobs * (k + 1) // (kills + 1):
            time.sleep(0.01)
        service.kill()
        service.start()
    for thread in clients_at_work.threads:
        thread.join()
    return clients_at_work


def stopped_under_load(service):
    """Seconds until it exits, told so while it computes and others wait in the queue."""
    client = Client(service.port)
    ids = []
    for first in range(3):
        question = {**LONG, "phi1": first}
        ids.append(client.ask("POST", "/workspace", question, Prefer="respond-async").json()["id"])
    client.close()
    code, seconds = service.terminate()
    check(code == 0, f"SIGTERM: exit code {code}")
    check(seconds < DRAIN + 3, f"SIGTERM: {seconds:.1f} s")
    service.start()
    for id in ids:
        state = client.ask("GET", f"/jobs/{id}").json()["state"]
        check(state in ("queued", "running"), f"after SIGTERM job {id} is {state}")
    return seconds


def backed_up(service, data, fresh):
    """Backs up the jobs while one runs, as the sqlite3 program's .backup does, and restores them: a service on the copy
    must know every job."""
    client = Client(service.port)
    running = client.ask("POST", "/workspace", {**LONG, "phi1": 9}, Prefer="respond-async").json()["id"]
    before = {job["id"] for job in listed(client)}
    check(running in before, "a job that was promised is not listed")
    os.makedirs(os.path.join(fresh, "jobs"))
    source = sqlite3.connect(os.path.join(data, "jobs/jobs.sqlite3"))
    copy = sqlite3.connect(os.path.join(fresh, "jobs/jobs.sqlite3"))
    source.backup(copy)
    source.close()
    copy.close()
    check(client.ask("GET", "/readyz").status == 200, "not ready after a backup")
    client.ask("DELETE", f"/jobs/{running}")
    restored = Service(service.command[0], fresh).start()
    client = Client(restored.port)
    check({job["id"] for job in listed(client)} == before, "the restored service has other jobs")
    state = client.ask("GET", f"/jobs/{running}").json()["state"]
    check(state in ("queued", "running"), f"the restored service has the running job {state}")
    restored.kill()
    return len(before)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("verne")
    parser.add_argument("--jobs", type=int, default=300)
    parser.add_argument("--clients", type=int, default=8)
    parser.add_argument("--kills", type=int, default=2)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        alone = Service(options.verne, os.path.join(place, "alone")).start()
        began = time.monotonic()
        undisturbed = run(alone, options.jobs, options.clients, 0)
        print(f"undisturbed: {options.jobs} jobs in {time.monotonic() - began:.1f} s", flush=True)
        check(alone.terminate()[0] == 0, "SIGTERM: it does not exit well")

        data = os.path.join(place, "killed")
        service = Service(options.verne, data).start()
        began = time.monotonic()
        asked = run(service, options.jobs, options.clients, options.kills)
        print(f"{options.kills} kills: {time.monotonic() - began:.1f} s, {len(asked.promised)} jobs promised")
        check(not undisturbed.faults + asked.faults, f"faults: {undisturbed.faults[:3]} {asked.faults[:3]}")
        check(asked.answers == undisturbed.answers, "answers differ from those of a service left alone")
        jobs = listed(Client(service.port))
        check(all(job["state"] == "succeeded" for job in jobs), "a job has not ended")
        missing = {id for id, _ in asked.answers.values()} - {job["id"] for job in jobs}
        check(not missing, f"{len(missing)} jobs are lost")
        print(f"a backup of {backed_up(service, data, os.path.join(place, 'restored'))} jobs is restored")
        print(f"SIGTERM while it computes: exits in {stopped_under_load(service):.1f} s")
        service.kill()
        for database in ("jobs/jobs.sqlite3", "results/index.sqlite3"):
            with sqlite3.connect(os.path.join(data, database)) as connection:
                found = connection.execute("PRAGMA integrity_check").fetchall()
            check(found == [("ok",)], f"{database}: {found}")
    print(f"{len(asked.answers)} answers, all the same; both databases are sound")


main()
