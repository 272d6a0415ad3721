#!/bin/sh
# run.sh CMAKE PREFIX COMPILER: configures, builds and runs this folder's project against the package installed under
# PREFIX alone, from outside the source tree.
set -eu
cmake=$1
prefix=$2
compiler=$3
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/source"
cp "$here/CMakeLists.txt" "$here/main.cc" "$scratch/source/"
"$cmake" -S "$scratch/source" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
"$cmake" --build "$scratch/build" -j 4
"$scratch/build/stranger"
