#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the build, then configures, builds and runs a program that finds it with find_package(vdbounce).
# usage: run.sh BUILD_FOLDER WORK_FOLDER COMPILER
set -euo pipefail
here=$(dirname "$(realpath "$0")")
rm -rf "$2"
cmake --install "$1" --prefix "$2/installed" >/dev/null
cmake -S "$here" -B "$2/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$3" -DCMAKE_PREFIX_PATH="$2/installed" >/dev/null
cmake --build "$2/build"
"$2/build/consumer" "$here/../../data/bunny.obj"
"$2/installed/bin/vdbounce" --version
