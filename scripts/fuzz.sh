#!/usr/bin/env bash
# fuzz.sh SECONDS [TARGET..]: builds the fuzz targets (preset fuzz: clang, libFuzzer, address and undefined-behaviour
# sanitizers) and runs each, or those named (medium, scene, ...), for so many seconds from its seeds, one process each.
# JOBS limits how many are at work at once (default: all cores). What a run learnt stays in build-fuzz/corpus and is
# where the next one starts; inputs that broke something are left in build-fuzz/found, and the exit code is then 1.
# Exit code 77: this machine's clang has no fuzzer.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[[ "${1:-}" =~ ^[0-9]+$ ]] || { sed -n '2,6s/^# //p' "$0" >&2; exit 2; }
seconds=$1
shift
build=${TYNDALL_FUZZ_BUILD:-build-fuzz}
jobs=${JOBS:-$(nproc)}

probe=$(mktemp -d)
trap 'rm -rf "$probe"' EXIT
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' >"$probe/probe.cc"
if ! clang++-14 -fsanitize=fuzzer,address,undefined -o "$probe/probe" "$probe/probe.cc" 2>/dev/null; then
  echo "fuzz: skipped: no clang++-14 with its fuzzer (Debian: clang-14 libclang-rt-14-dev)" >&2
  exit 77
fi

cmake --preset fuzz -B "$build" >"$probe/log" 2>&1 && cmake --build "$build" --target fuzz_targets -j "$jobs" >>"$probe/log" 2>&1 || {
  cat "$probe/log" >&2
  exit 1
}
rm -rf "$build/seeds"
python3 tests/fuzz/seeds.py "$build/seeds"
targets=("$@")
if [ ${#targets[@]} = 0 ]; then
  for program in "$build"/fuzz/*_fuzz; do targets+=("$(basename "$program" _fuzz)"); done
fi

# Sizes are claims that readers check; what they allow (2^31 bytes of a picture) must fit.
run() {
  local target=$1 options=(-max_total_time="$seconds" -timeout=30 -rss_limit_mb=5000 -print_final_stats=1)
  case $target in medium | variant | scene | gltf) options+=(-max_len=4096 -dict="$build/seeds/words.dict") ;; *) options+=(-max_len=2048) ;; esac
  mkdir -p "$build/corpus/$target" "$build/found"
  local code=0
  "$build/fuzz/${target}_fuzz" "${options[@]}" -artifact_prefix="$build/found/$target-" \
    "$build/corpus/$target" "$build/seeds/$target" >"$build/$target.log" 2>&1 || code=$?
  awk -v target="$target" -v code="$code" '
    / cov: / { for (i = 1; i < NF; ++i) { if ($i == "cov:") cov = $(i + 1); if ($i == "ft:") ft = $(i + 1); if ($i == "corp:") corp = $(i + 1) } }
    /number_of_executed_units/ { n = $2 }
    END { printf "%-10s %9d executions, %5d edges, %6d features, corpus %s%s\n", target, n, cov, ft, corp, code == 0 ? "" : ": FAILED" }' "$build/$target.log"
  if [ "$code" != 0 ]; then
    tail -n 60 "$build/$target.log" >&2
    touch "$build/found/failed"
  fi
}
mkdir -p "$build/found"
rm -f "$build/found/failed"
for target in "${targets[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n; done
  run "$target" &
done
wait
[ ! -e "$build/found/failed" ]
