#!/bin/sh
# check_geometry.sh PYTHON: fails unless examples/geometry/*.glb are the bytes that their script writes.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" examples/geometry/make_geometry.py -o "$folder"
for file in examples/geometry/*.glb; do cmp "$file" "$folder/$(basename "$file")"; done
