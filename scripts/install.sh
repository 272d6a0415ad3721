#!/bin/sh
# install.sh [PART..]: installs what scripts/packages.txt names for these parts (demo, build, test, bench; default: all)
# and this machine lacks, as root or through sudo. Quick when nothing is missing. TYNDALL_INSTALL=no only says what is
# missing.
set -eu
here=$(cd "$(dirname "$0")" && pwd)

if ! command -v dpkg-query >/dev/null; then
  echo "install: not a Debian system; what Tyndall needs is listed in scripts/packages.txt" >&2
  exit 0
fi

[ $# -gt 0 ] || set -- demo build test bench
for part in "$@"; do
  grep -qxF "[$part]" "$here/packages.txt" || { echo "install: no part $part in scripts/packages.txt" >&2; exit 2; }
done
wanted=$(awk -v parts=" $* " '
  { sub(/#.*/, "") }
  /^\[/ { gsub(/[][ \t]/, ""); wanted = index(parts, " " $0 " "); next }
  wanted && NF' "$here/packages.txt")
# shellcheck disable=SC2086  # a list of words
present=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $wanted 2>/dev/null | sed -n 's/ installed$//p' || true)
missing=""
for package in $wanted; do
  case "
$present
" in
    *"
$package
"*) ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0

if [ "${TYNDALL_INSTALL:-yes}" = no ]; then
  echo "install: not installed (TYNDALL_INSTALL=no):$missing" >&2
  exit 0
fi
if [ "$(id -u)" = 0 ]; then
  as_root=""
elif command -v sudo >/dev/null; then
  as_root="sudo"
else
  echo "install: these Debian packages are missing, and this is neither root nor is there sudo. As root:" >&2
  echo "  apt-get update && apt-get install --no-install-recommends$missing" >&2
  exit 1
fi

echo "Installing Debian packages:$missing"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# env: sudo drops the caller's environment. Nothing may ask questions: there may be nobody to answer. Apt's page of
# names is shown only when something went wrong.
# shellcheck disable=SC2086
if ! { $as_root apt-get -qq update &&
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 install -y --no-install-recommends $missing
} </dev/null >"$log" 2>&1; then
  cat "$log" >&2
  echo "install: apt-get failed (above)" >&2
  exit 1
fi
