#!/usr/bin/env bash
# The joints for each row of a table of poses. Other columns, such as names, stay.
#
#     table.sh [POSES.csv] > joints.csv
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}
poses=${1:-$(dirname "$0")/../poses.csv}

curl -sS --fail-with-body --data-binary "@$poses" "$server/ik/batch?format=csv&tool_length=50"
