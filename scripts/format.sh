#!/bin/sh
# format.sh --check | --fix: our C++ as .clang-format says, by the version of Debian 12 (others differ in detail).
set -eu
cd "$(dirname "$0")/.."
tool=$(command -v clang-format-14 || command -v clang-format || true)
[ -n "$tool" ] || { echo "format: clang-format is not installed" >&2; exit 1; }
case "${1:-}" in
  --check) action="--dry-run -Werror" ;;
  --fix) action="-i" ;;
  *) echo "usage: format.sh --check | --fix" >&2; exit 2 ;;
esac
# shellcheck disable=SC2086
find tyndall tests examples \( -name '*.h' -o -name '*.cc' \) -print0 | xargs -0 -r -n 16 -P 4 "$tool" $action
