#!/bin/sh
# without.sh CMAKE: the build configures without Embree (and says what it leaves out), and the headers install without
# it, without any header whose library is not installed.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$1" -S "$root" -B "$scratch/program" -G Ninja -DTYNDALL_WITH_EMBREE=OFF -DTYNDALL_BUILD_TESTS=OFF >"$scratch/said" 2>&1 ||
  { cat "$scratch/said" >&2; exit 1; }
grep -q "Not built: command render" "$scratch/said" || { echo "nothing said of render" >&2; exit 1; }
"$1" -S "$root" -B "$scratch/headers" -G Ninja -DTYNDALL_BUILD_PROGRAM=OFF -DTYNDALL_BUILD_TESTS=OFF >/dev/null
"$1" --install "$scratch/headers" --prefix "$scratch/installed" >/dev/null
[ -f "$scratch/installed/include/tyndall/phase/law.h" ] || { echo "no headers were installed" >&2; exit 1; }
if find "$scratch/installed" -name '*kernel*' | grep .; then echo "headers without their library" >&2; exit 1; fi
