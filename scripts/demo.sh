#!/bin/sh
# demo.sh PROGRAM FOLDER: the night street in three airs, from hazy (w = 0) to murky (w = 1), and one sheet of them.
# SIZE and SPP in the environment ask for more: SIZE=1280x720 SPP=64 make demo
set -eu
program=$1
out=$2
size=${SIZE:-336x189}
spp=${SPP:-16}
cd "$(dirname "$0")/.."
mkdir -p "$out"
out=$(cd "$out" && pwd)
set --
for w in 000 050 100; do
  echo "Street, w = $(echo "$w" | sed 's/^\(.\)\(.\)./\1.\2/')"
  "$program" render examples/street.scene.json --medium "examples/media/street_w$w.medium.json" \
    --size "$size" --spp "$spp" -o "$out/street_w$w.exr" -o "$out/street_w$w.png"
  set -- "$@" "$out/street_w$w.png"
done
python3 scripts/contact_sheet.py "$out/contact_sheet.png" "$@"
echo
echo "Pictures, and all layers of each as .exr beside it:"
for picture in "$@" "$out/contact_sheet.png"; do echo "  $picture"; done
