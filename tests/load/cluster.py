"""Brokers, an S3 store, API nodes and workers of verne on this machine."""

import atexit
import http.client
import os
import random
import socket
import subprocess
import sys
import time

from verne_process import Process, free_port

BUCKET = "verne"
PASSWORD = "v0"
SHIPPED = os.path.join(os.path.dirname(__file__), "../../docker/nats/nats.conf")
CREDENTIALS = {"AWS_ACCESS_KEY_ID": "key", "AWS_SECRET_ACCESS_KEY": "secret", "AWS_REGION": "us-east-1",
               "AWS_ALLOW_HTTP": "true"}


def answers(port, path="/"):
    """The answer of the server at a port; waits until it answers."""
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        try:
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
            connection.request("GET", path)
            return connection.getresponse().read()
        except OSError:
            time.sleep(0.05)
    raise SystemExit(f"nothing answers on port {port}")


class Broker:
    """A NATS server with the configuration in docker/nats, and with its permissions; one of a cluster if `routes` are
    given."""

    def __init__(self, program, directory, name="alone", routes=()):
        self.port, self.program = free_port(), program
        self.url = f"nats://verne:{PASSWORD}@127.0.0.1:{self.port}"
        self.file = os.path.join(directory, f"nats-{name}.conf")
        self.environment = {**os.environ, "VERNE_BROKER_HOST": name, "VERNE_BROKER_PASSWORD": PASSWORD}
        with open(SHIPPED) as shipped:
            text = shipped.read()
        for address, here in (("0.0.0.0:4222", f"127.0.0.1:{self.port}"), ("0.0.0.0:8222", f"127.0.0.1:{free_port()}"),
                              ("store_dir: /data", f'store_dir: "{directory}/nats-{name}"')):
            if text.count(address) != 1:
                raise SystemExit(f"{SHIPPED} does not name {address} once")
            text = text.replace(address, here)
        if routes:
            others = ", ".join(f'"nats://{route}"' for route in routes[1:])
            text += f'cluster {{ name: "verne", listen: "{routes[0]}", routes: [{others}] }}\n'
        with open(self.file, "w") as file:
            file.write(text)
        self.start()

    def start(self):
        self.process = subprocess.Popen([self.program, "-c", self.file], env=self.environment,
                                        stderr=subprocess.DEVNULL)
        while True:
            try:
                return socket.create_connection(("127.0.0.1", self.port)).close()
            except OSError:
                time.sleep(0.02)

    def kill(self):
        self.process.kill()
        self.process.wait()


class Brokers:
    """NATS servers, each of which replicates everything. kill_one kills them in turn."""

    def __init__(self, program, directory, count):
        routes = [f"127.0.0.1:{free_port()}" for _ in range(count if count > 1 else 0)]
        self.all = [Broker(program, directory, f"n{i}", [*routes[i:], *routes[:i]]) for i in range(count)]
        self.url = ",".join(broker.url for broker in self.all)
        self.next = 0

    def kill_one(self):
        """Kills a broker and starts it again."""
        broker = self.all[self.next % len(self.all)]
        self.next += 1
        broker.kill()
        broker.start()

    def kill(self):
        for broker in self.all:
            broker.kill()


class Objects:
    """An S3 store that refuses a fraction of all writes."""

    def __init__(self, share):
        self.port = free_port()
        script = os.path.join(os.path.dirname(__file__), "s3_that_refuses_writes.py")
        self.process = subprocess.Popen([sys.executable, script, str(self.port), str(share)])
        answers(self.port, "/refused")
        status = 503
        while status == 503:
            connection = http.client.HTTPConnection("127.0.0.1", self.port)
            connection.request("PUT", f"/{BUCKET}")
            status = connection.getresponse().status

    def refused(self):
        return int(answers(self.port, "/refused"))

    def kill(self):
        self.process.kill()
        self.process.wait()


class Cluster:
    """API nodes and workers with one broker and one store. They end with this program."""

    def __init__(self, verne, nats, directory, nodes, workers, share=0.0, brokers=1):
        self.verne, self.nodes, self.workers = verne, [], []
        self.brokers = Brokers(nats, directory, brokers)
        atexit.register(self.brokers.kill)
        self.objects = Objects(share)
        atexit.register(self.objects.kill)
        self.environment = {**CREDENTIALS, "AWS_ENDPOINT": f"http://127.0.0.1:{self.objects.port}"}
        self.nodes += [self.node().launch() for _ in range(nodes)]
        self.workers += [self.worker().launch() for _ in range(workers)]
        atexit.register(self.kill_all)
        for process in self.nodes + self.workers:
            process.ready()

    def shared(self):
        replicas = str(len(self.brokers.all))
        return ["--broker", self.brokers.url, "--broker-replicas", replicas, "--store", f"s3://{BUCKET}/results"]

    def node(self):
        port = free_port()
        return Process(port, self.verne, "serve", "--listen", f"127.0.0.1:{port}", *self.shared(),
                       environment=self.environment)

    def worker(self):
        port = free_port()
        return Process(port, self.verne, "worker", "--listen", f"127.0.0.1:{port}", "--job-threads", "1",
                       *self.shared(), environment=self.environment)

    def kill_a_worker(self):
        """Kills a worker and starts another."""
        i = random.randrange(len(self.workers))
        self.workers[i].kill()
        self.workers[i] = self.worker().launch()

    def ports(self):
        return [node.port for node in self.nodes]

    def kill_all(self):
        for process in self.nodes + self.workers:
            process.kill()

    def end(self):
        self.kill_all()
        self.brokers.kill()
        self.objects.kill()
