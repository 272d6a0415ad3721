#!/bin/sh
# schemas.sh PROGRAM [--check]: writes schema/*.schema.json as the program prints them, or says whether they are so.
# They follow from the field descriptions: run `scripts/schemas.sh build/tyndall` after changing one.
set -eu
program=$(realpath "${1:?usage: schemas.sh PROGRAM [--check]}")
cd "$(dirname "$0")/.."
for kind in medium scene; do
  file=schema/tyndall-$kind-1.schema.json
  new=$(mktemp)
  trap 'rm -f "$new"' EXIT
  "$program" schema $kind >"$new"
  if [ "${2:-}" != --check ]; then
    cp "$new" "$file"
  elif ! diff -u "$file" "$new" >&2; then
    echo "schemas: $file is not what the program prints; to write it anew: scripts/schemas.sh build/tyndall" >&2
    exit 1
  fi
  rm -f "$new"
done
