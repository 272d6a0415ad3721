#!/bin/sh
# check_kernels.sh OBJECT ENTRY: fails unless OBJECT's only symbol that other objects can see is ENTRY, and it runs
# nothing at start-up. See cmake/kernels.cmake for what goes wrong otherwise.
set -eu
object=$1
entry=$2
symbols=$("${NM:-nm}" --defined-only --extern-only --format=posix "$object" | awk '{print $1}')
bad=0
if [ "$symbols" != "$entry" ]; then
  echo "$object: visible symbols must be exactly '$entry', found:"
  printf '%s\n' "${symbols:-(none)}"
  bad=1
fi
# posix format types: V v W w are weak, u is unique.
weak=$("${NM:-nm}" --defined-only --format=posix "$object" | awk '$2 ~ /^[VvWwu]$/ {print $1}')
if [ -n "$weak" ]; then
  echo "$object: weak or unique symbols:"
  printf '%s\n' "$weak"
  bad=1
fi
sections=$("${OBJDUMP:-objdump}" -h "$object" | awk '$2 ~ /^\.(init_array|ctors|preinit_array|tbss|tdata)/ {print $2}')
if [ -n "$sections" ]; then
  echo "$object: static initialisers or thread-local data would run on every machine: $sections"
  bad=1
fi
exit $bad
