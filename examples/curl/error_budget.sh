#!/usr/bin/env bash
# How far may the tool be off at a pose, and which tolerances matter most?
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}

curl -sS --fail-with-body "$server/error-budget" -H 'Content-Type: application/json' -d '{
  "tool_length": 50, "poses": [[100, 50, 150, 20, 30]],
  "parameter_tolerances": {"L1": 0.02, "L2": 0.02, "L3": 0.02, "o1": 0.005, "o2": 0.005, "o3": 0.005, "tilt_zero": 0.001}
}' | jq -r 'def micrometre: . * 1e4 | round / 1e4;
            .budgets[0].tip as $tip | "tool end: rms \($tip.rms | micrometre) mm, worst \($tip.worst | micrometre) mm",
            ([[.parameters[].name], $tip.contributions] | transpose | sort_by(-.[1])[] | "\(.[0]) alone: \(.[1] | micrometre) mm")'
