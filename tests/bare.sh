#!/usr/bin/env bash
# bare.sh [--working-tree] [GOAL..]: proves `make demo` and `make test` (or the goals named) on bare Debian 12, and
# prints times.
#
# A debootstrap minbase chroot with make, git and ca-certificates, nothing of this machine bound into it; a clean clone
# of HEAD (or, with --working-tree, of the files as they are) is copied in, and the commands are run there. From
# this machine come only the names of its Debian mirror and proxy (apt's own configuration) and its name servers.
# Needs root, debootstrap, 4 GB in $TMPDIR (/var/tmp) and some minutes. CORES=0,1 in the environment restricts the run
# to those processors. KEEP=1 keeps the chroot. Exit code: that of the first command that failed.
set -euo pipefail

if [ "${1:-}" != --inside ]; then
  [ "$(id -u)" = 0 ] || { echo "bare: needs root (chroot, mount)" >&2; exit 1; }
  # A mount namespace of its own: whatever happens, nothing stays mounted.
  exec unshare --mount --propagation private "$0" --inside "$@"
fi
shift

source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
from=head
commands=()
for argument in "$@"; do
  case "$argument" in
    --working-tree) from=files ;;
    -*) echo "usage: bare.sh [--working-tree] [GOAL..]" >&2; exit 2 ;;
    *) commands+=("$argument") ;;
  esac
done
[ ${#commands[@]} -gt 0 ] || commands=(demo test)

root=$(mktemp -d "${TMPDIR:-/var/tmp}/tyndall-bare.XXXXXX")
chmod 755 "$root"  # apt fetches as a user of its own
clean_up() {
  umount "$root/dev/shm" "$root/proc" 2>/dev/null || true
  if [ "${KEEP:-0}" = 1 ]; then
    echo "bare: kept $root"
  else
    rm -rf --one-file-system "$root"
  fi
}
trap clean_up EXIT

now() { date +%s.%N; }
since() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.1f s", b - a }'; }
written() { stat -c %.9Y "$root/$1" 2>/dev/null || echo "$2"; }

# This machine's Debian mirror: "URI suite component" for each list it reads.
lists=$(apt-get indextargets --format '$(ORIGIN)|$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
  sed -n 's/^Debian|//p' | grep ' bookworm' | sort -u)
mirror=$(awk '$2 == "bookworm" { print $1; exit }' <<<"$lists")
[ -n "$mirror" ] || { echo "bare: this machine's apt knows no Debian 12 mirror (apt-get update?)" >&2; exit 1; }

begin=$(now)
debootstrap --variant=minbase --include=make,git,ca-certificates bookworm "$root" "$mirror" >"$root.log" 2>&1 ||
  { tail -n 20 "$root.log" >&2; exit 1; }
rm -f "$root.log"
sed 's/^/deb /' <<<"$lists" >"$root/etc/apt/sources.list"
apt-config dump | grep -E '^Acquire::(https?|ftp|ForceIPv|Retries|Check-)' >"$root/etc/apt/apt.conf.d/90mirror" || true
cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
mount -t proc proc "$root/proc"
mkdir -p "$root/dev/shm"
mount -t tmpfs tmpfs "$root/dev/shm"
echo "bare: minbase system made in $(since "$begin" "$(now)"), $(chroot "$root" dpkg-query -f . -W | wc -c) packages"

clone="$root/root/tyndall"
if [ $from = head ]; then
  git -c safe.directory='*' clone --quiet --no-hardlinks "$source_tree" "$clone"
else
  mkdir -p "$clone"
  (cd "$source_tree" && git ls-files -z --cached --others --exclude-standard |
    tar --null --ignore-failed-read -T - -c -f -) | tar -x -C "$clone" --no-same-owner
  git -C "$clone" init --quiet
fi

status=0
for command in "${commands[@]}"; do
  echo "bare: make $command"
  log="$root/root/make-$command.log"
  begin=$(now)
  env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
    ${CORES:+taskset -c "$CORES"} chroot "$root" make -C /root/tyndall "$command" </dev/null 2>&1 | tee "$log" || status=$?
  end=$(now)
  # When each stage ended is written on what it left behind.
  installed=$(written var/lib/dpkg/status "$begin")
  if awk -v a="$installed" -v b="$begin" 'BEGIN { exit !(a < b) }'; then installed=$begin; fi
  configured=$(written root/tyndall/build/build.ninja "$installed")
  built=$(written root/tyndall/build/.ninja_log "$configured")
  results+=("make $command: install $(since "$begin" "$installed"), configure $(since "$installed" "$configured"), build \
$(since "$configured" "$built"), then $(since "$built" "$end"); $(since "$begin" "$end") in all")
  [ "$status" = 0 ] || break
done

echo
echo "bare Debian 12, $(${CORES:+taskset -c "$CORES"} nproc) processors, $(chroot "$root" dpkg-query -f . -W | wc -c) packages, $(du -xsm "$root" | cut -f1) MB:"
printf '  %s\n' "${results[@]}"
exit "$status"
