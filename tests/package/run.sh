#!/bin/sh
# run.sh CMAKE BUILD COMPILER: installs BUILD's headers and package files into a scratch prefix, then configures, builds
# and runs this folder's project against that prefix alone, from outside the source tree.
set -eu
cmake=$1
build=$2
compiler=$3
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$cmake" --install "$build" --prefix "$scratch/prefix" >/dev/null
mkdir "$scratch/source"
cp "$here/CMakeLists.txt" "$here/main.cc" "$scratch/source/"
"$cmake" -S "$scratch/source" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
"$cmake" --build "$scratch/build" -j 4
"$scratch/build/stranger"
