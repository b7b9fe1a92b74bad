#!/usr/bin/env bash
# How does the volume of the tool's workspace grow with the length of the tool? One request for several workspaces.
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}

curl -sS --fail-with-body "$server/workspace" -H 'Content-Type: application/json' -H 'Prefer: wait=25' -d '{
  "kind": "tool", "tool_length": [50, 150, 300], "tolerance": 5
}' | jq -r '.members[] | "tool_length \(.request.tool_length) mm: \(.volume / 1e9 * 10000 | round / 10000) m³"'
