#!/bin/sh
# run_tests.sh CTEST_ARGUMENTS...: ctest, with the number of skipped tests said just above its summary (ctest lists
# them by name only). Ends with ctest's own summary and its exit code.
set -u
status=$(mktemp)
trap 'rm -f "$status"' EXIT
{ ctest "$@"; echo $? >"$status"; } | awk '
  /\*\*\*Skipped/ { skipped++ }
  /^[0-9]+% tests passed/ { print skipped + 0 " tests skipped" }
  { print; fflush() }'
exit "$(cat "$status")"
