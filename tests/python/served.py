"""A verne process under test, and requests to it. Used by kills.py and load.py."""

import http.client
import json
import signal
import socket
import subprocess
import time


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Served:
    """The service on a data directory, on the same port at each start."""

    def __init__(self, verne, data, *flags):
        self.port = free_port()
        self.command = [verne, "serve", "--listen", f"127.0.0.1:{self.port}", "--data", data, *flags]
        self.process = None

    def start(self):
        self.process = subprocess.Popen(self.command, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            try:
                if Client(self.port).ask("GET", "/readyz").status == 200:
                    return self
            except OSError:
                pass
            if self.process.poll() is not None:
                break
            time.sleep(0.02)
        raise SystemExit(f"the service does not start: {self.command}")

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


class Reply:
    def __init__(self, response):
        self.status, self.headers, self.body = response.status, response.headers, response.read()

    def json(self):
        return json.loads(self.body)


class Client:
    """One connection, opened anew when it has broken."""

    def __init__(self, port):
        self.port = port
        self.connection = None

    def ask(self, method, path, question=None, **headers):
        """The reply; OSError or HTTPException where there is none."""
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
