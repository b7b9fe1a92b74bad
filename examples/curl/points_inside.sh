#!/usr/bin/env bash
# Which of these points can the tool reach upright on the part, and how far is each from the nearest limit?
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}

curl -sS --fail-with-body "$server/workspace/contains" -H 'Content-Type: application/json' -d '{
  "kind": "part", "tool_length": 50,
  "points": [[0, 0, 300], [200, 100, 300], [600, 0, 300]]
}' | jq -r '[.inside, .margin, .unit, .element] | transpose[]
  | "inside: \(.[0]), margin \(.[1] * 10 | round / 10) \(.[2]) at \(.[3])"'
