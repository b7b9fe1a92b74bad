#!/usr/bin/env bash
# Where is the tool if the sliders and the table stand here? All assembly modes, also those that the machine cannot use.
#
#     forward.sh [RHO1 RHO2 RHO3]     mm
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}
rho=${1:-674},${2:-685},${3:-250}

curl -sS --fail-with-body "$server/fk?rho=$rho&solutions=all" | jq -r '
  def rounded: . * 1000 | round / 1000;
  .solutions[] | "P = (\(.platform.x | rounded), \(.platform.y | rounded), \(.platform.z | rounded)) mm, "
    + "alpha = \(.platform.alpha | rounded)°, feasible: \(.feasible)"'
