#!/usr/bin/env bash
# How does a longer leg I change the workspace? Asks with a machine of one's own in the request.
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}

machine=$(curl -sS --fail-with-body "$server/machines/verne" | jq .definition)
for length in 1050 1100; do
    jq '{kind: "platform", tolerance: 5, machine: (. * {name: "mine", geometry: {L1: $length}})}' \
        --argjson length "$length" <<< "$machine" |
        curl -sS --fail-with-body "$server/workspace" -H 'Content-Type: application/json' -d @- |
        jq -r --arg length "$length" '"L1 = \($length) mm: \(.volume / 1e9 * 10000 | round / 10000) m³"'
done
