#!/bin/sh
# install.sh CMAKE BUILD PREFIX: installs BUILD's headers and package files into a fresh PREFIX, for the tests that know
# nothing else of us.
set -eu
rm -rf "$3"
"$1" --install "$2" --prefix "$3" >/dev/null
