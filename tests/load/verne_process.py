"""Starts and stops verne processes, and sends requests to them."""

import http.client
import json
import os
import signal
import socket
import subprocess
import time

LOGS = os.environ.get("VERNE_LOGS")  # A directory for the logs of the processes.


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Process:
    """A verne process that answers probes on a port. The port is the same at each start."""

    def __init__(self, port, *command, environment=None):
        self.port, self.command = port, list(command)
        self.environment = {**os.environ, **(environment or {})}
        self.process = None

    def launch(self):
        log = open(os.path.join(LOGS, f"{self.port}.log"), "ab") if LOGS else subprocess.DEVNULL
        self.process = subprocess.Popen(self.command, env=self.environment, stderr=log)
        return self

    def start(self):
        return self.launch().ready()

    def ready(self):
        """Waits until the process is ready."""
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            try:
                client = Client(self.port)
                if client.ask("GET", "/readyz").status == 200:
                    return self
            except OSError:
                pass
            finally:
                client.close()
            if self.process.poll() is not None:
                break
            time.sleep(0.02)
        raise SystemExit(f"it does not start: {self.command}")

    def kill(self):
        self.process.kill()
        self.process.wait()

    def terminate(self):
        """Exit code and seconds after SIGTERM."""
        began = time.monotonic()
        self.process.send_signal(signal.SIGTERM)
        code = self.process.wait(timeout=60)
        return code, time.monotonic() - began

    def rss(self):
        """Resident memory, bytes."""
        with open(f"/proc/{self.process.pid}/status") as status:
            return next(int(line.split()[1]) * 1024 for line in status if line.startswith("VmRSS"))


class Service(Process):
    """The service on a data directory."""

    def __init__(self, verne, data, *flags):
        port = free_port()
        super().__init__(port, verne, "serve", "--listen", f"127.0.0.1:{port}", "--data", data, *flags)


class Reply:
    def __init__(self, response):
        self.status, self.headers, self.body = response.status, response.headers, response.read()

    def json(self):
        return json.loads(self.body)


class Client:
    """A client with one connection, which it opens again after an error."""

    def __init__(self, port):
        self.port = port
        self.connection = None

    def ask(self, method, path, question=None, **headers):
        """The reply; raises OSError or HTTPException without one."""
        if self.connection is None:
            self.connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        body = None
        if question is not None:
            body, headers["Content-Type"] = json.dumps(question), "application/json"
        try:
            self.connection.request(method, path, body, headers)
            return Reply(self.connection.getresponse())
        except (OSError, http.client.HTTPException):
            self.close()
            raise

    def close(self):
        if self.connection is not None:
            self.connection.close()
            self.connection = None
