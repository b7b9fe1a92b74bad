#!/usr/bin/env bash
# How large is the region that the tool reaches with some, and with all inclinations from -20° to 20°?
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}

curl -sS --fail-with-body "$server/workspace/dexterity" -H 'Content-Type: application/json' -H 'Prefer: wait=25' -d '{
  "tool_length": 50, "phi1": {"from": -20, "to": 20}, "cell": 80
}' | jq -r '"some inclinations: \(.reachable.volume / 1e9 * 1000 | round / 1000) m³",
            "all inclinations:  \(.dexterous.volume / 1e9 * 1000 | round / 1000) m³"'
