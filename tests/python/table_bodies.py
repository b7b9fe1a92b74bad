"""Lets schemathesis send tables: their bodies are bytes."""

import schemathesis

schemathesis.serializer.alias("application/vnd.apache.arrow.stream", "application/octet-stream")
schemathesis.serializer.alias("application/x-ndjson", "text/plain")
