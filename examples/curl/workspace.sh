#!/usr/bin/env bash
# How large is the workspace on the part? Writes its surface and a cut through it as files for viewers.
#
#     workspace.sh [DIRECTORY]     the files are workspace.glb, workspace.stl, slice.svg and slice.dxf
set -euo pipefail
server=${VERNE_SERVER:-http://127.0.0.1:8080}
directory=${1:-.}

summary=$(curl -sS --fail-with-body "$server/workspace?kind=part&tool_length=50&table_clearance=0")
jq -r '"volume \(.volume) mm³ ± \(.volume_error) mm³, \(.triangles) triangles"' <<< "$summary"
path=$server/workspace/$(jq -r .id <<< "$summary")
for format in glb stl; do
    curl -sS --fail-with-body "$path/mesh.$format" -o "$directory/workspace.$format"
done
for format in svg dxf; do
    curl -sS --fail-with-body "$path/slice.$format?z=300" -o "$directory/slice.$format"
done
