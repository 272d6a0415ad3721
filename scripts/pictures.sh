#!/bin/sh
# pictures.sh [PROGRAM [SPP]]: renders the pictures of README.md and docs/ into docs/pictures. Some minutes.
set -eu
cd "$(dirname "$0")/.."
program=${1:-build/tyndall}
spp=${2:-64}
mkdir -p docs/pictures
"$program" render examples/street.scene.json --medium examples/media/street_w100.medium.json --size 480x270 --spp "$spp" \
  -o docs/pictures/street.png
"$program" render examples/room.scene.json --size 320x180 --spp $((spp * 4)) -o docs/pictures/room.png
strip=$(mktemp -d)
trap 'rm -rf "$strip"' EXIT
"$program" render examples/morning.scene.json --frames 0-7 --size 240x135 --spp $((spp * 3 / 2)) --exposure -0.7 -o "$strip/fog.png"
scripts/contact_sheet.py --columns 4 docs/pictures/morning.png "$strip"/fog.*.png
"$program" render examples/landscape.scene.json --size 320x180 --spp "$spp" -o docs/pictures/landscape.png
