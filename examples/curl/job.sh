#!/usr/bin/env bash
# Starts a long computation, follows its progress as events, and gets the result under its id.
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}

job=$(curl -sS --fail-with-body "$server/workspace" -H 'Content-Type: application/json' -H 'Prefer: respond-async' \
    -d '{"kind": "part", "tool_length": 70, "tolerance": 2}')
# A result that is stored already has no state.
if jq -e 'has("state")' <<< "$job" > /dev/null; then
    # The stream ends with the job. Each line that begins with "data:" is the job.
    curl -sSN --fail-with-body "$server$(jq -r .links.events <<< "$job")" |
        sed -un 's/^data: *//p' | jq --unbuffered -r '"\(.state): \(.progress * 100 | round) %"'
fi
curl -sS --fail-with-body "$server/workspace/$(jq -r .id <<< "$job")" | jq -r '"volume \(.volume) mm³"'
