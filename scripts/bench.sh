#!/bin/sh
# bench.sh BUILD: runs every benchmark of that build, one after the other, and keeps each result as BUILD/bench/*.json.
set -eu
build=$1
mkdir -p "$build/bench"
while read -r name; do
  [ -n "$name" ] || continue
  echo "== $name"
  "$build/bin/$name" --benchmark_out="$build/bench/$name.json" --benchmark_out_format=json
done <"$build/benches.txt"
python3 "$(dirname "$0")/bench_page.py" "$build"
echo "Results: docs/bench.md, $build/bench/"
