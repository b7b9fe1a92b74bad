#!/usr/bin/env bash
# Can the machine run a program, and how does it move? Writes the program for the controller of the machine.
#
#     toolpath.sh [PROGRAM.cls [Z]] > joints.ngc     Z is the height of the part's origin over the table, mm
#
# If the machine cannot run the program, the script names lines, limits and a remedy, and ends with 3.
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}
program=${1:-$(dirname "$0")/../dome.cls} z=${2:-560}

# The set-up is JSON: {"z": 560}.
query="format=apt&tool_length=120&setup=%7B%22z%22:$z%7D"
report=$(curl -sS --fail-with-body --data-binary "@$program" "$server/toolpath?$query" -H 'Prefer: wait=25')
if [ "$(jq -r .verdict <<< "$report")" = ok ]; then
    jq -r '"\(.rows) rows; the least margin is \(.margins[0].margin) \(.margins[0].unit) at \(.margins[0].element)"' \
        <<< "$report" >&2
    curl -sS --fail-with-body "$server$(jq -r .links.program <<< "$report")"
else
    jq -r '.failures[:5][] | "lines \(.lines[0]) to \(.lines[1]): \(.element) by \(.margin) \(.unit)"
        + (if .change then "; \(.change.parameter) \(.change.delta) heals it" else "" end)' <<< "$report" >&2
    exit 3
fi
