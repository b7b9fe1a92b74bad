#!/usr/bin/env bash
# Where do the sliders and the table go for a tool end on the part, and which limit is closest?
#
#     inverse.sh [X Y Z [PHI1 PHI2]]     mm and degrees
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}
x=${1:-100} y=${2:-50} z=${3:-300} phi1=${4:-10} phi2=${5:-30}

answer=$(curl -sS --fail-with-body "$server/ik?x=$x&y=$y&z=$z&phi1=$phi1&phi2=$phi2&tool_length=50")
jq -r '
  def rounded: . * 1000 | round / 1000;
  if .solutions == [] then "no solution: \(.reason)" else
    (.solutions[] | .joints as $joints | .margins.worst as $limit
      | "rho \($joints.rho | map(rounded)) mm, theta1 \($joints.theta1 | rounded)°, theta2 \($joints.theta2 | rounded)°",
        "feasible: \(.feasible); the closest limit is \($limit.element) with \($limit.value | rounded) \($limit.unit)")
  end' <<< "$answer"
