#!/bin/sh
# check_example.sh EXAMPLE.cc: compiles it by the compile line in its head comment ("//   g++ ... examples/x.cc ...", as
# typed in the repository's folder), in a scratch copy, and runs what comes out. It must print something.
set -eu
example=$1
name=$(basename "$example" .cc)
root=$(cd "$(dirname "$0")/.." && pwd)
line=$(sed -n '1,12s,^//[[:space:]]*\(\(g++\|clang++\|c++\) .*\),\1,p' "$example" | head -n 1)
[ -n "$line" ] || { echo "$example: no compile line in its first 12 lines" >&2; exit 1; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# The line is run from a folder that looks like the repository but may be written to.
ln -s "$root/tyndall" "$root/examples" "$scratch/"
cd "$scratch"
echo "$line"
eval "$line"
program=$(find . -maxdepth 1 -type f -perm -u+x)
[ -n "$program" ] || { echo "$example: the compile line made no program here" >&2; exit 1; }
output=$("$program")
printf '%s\n' "$output"
[ -n "$output" ] || { echo "$name printed nothing" >&2; exit 1; }
