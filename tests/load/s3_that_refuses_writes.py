"""An S3 store in memory (moto) that refuses a part of all writes. python s3_that_refuses_writes.py PORT SHARE

`GET /refused` returns the number of refused writes."""

import random
import sys
import threading

from moto.server import DomainDispatcherApplication, create_backend_app
from werkzeug.serving import WSGIRequestHandler, make_server


class Refusing:
    """Answers 503 SlowDown to a part of the requests that write."""

    def __init__(self, application, share):
        self.application, self.share = application, share
        self.refused, self.lock = 0, threading.Lock()

    def __call__(self, environ, start_response):
        if environ["PATH_INFO"] == "/refused":
            start_response("200 OK", [("Content-Type", "text/plain")])
            return [str(self.refused).encode()]
        if environ["REQUEST_METHOD"] in ("PUT", "POST") and random.random() < self.share:
            with self.lock:
                self.refused += 1
            # Read, or the connection could not be used again.
            environ["wsgi.input"].read(int(environ.get("CONTENT_LENGTH") or 0))
            start_response("503 Slow Down", [("Content-Type", "application/xml")])
            return [b"<Error><Code>SlowDown</Code><Message>refused</Message></Error>"]
        return self.application(environ, start_response)


class Quiet(WSGIRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_request(self, *_):
        pass


def main():
    port, share = int(sys.argv[1]), float(sys.argv[2])
    application = Refusing(DomainDispatcherApplication(create_backend_app), share)
    make_server("127.0.0.1", port, application, threaded=True, request_handler=Quiet).serve_forever()


main()
