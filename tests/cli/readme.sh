#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs every ```sh block of the README in a fresh folder, with vdbounce on the PATH and the mesh that it uses in place.
# The two commands that install and build, ./dev demo and ./dev test, must be in a ```console block, which is not run here.
# usage: readme.sh VDBOUNCE SOURCE_FOLDER WORK_FOLDER
set -euo pipefail
source=$2
rm -rf "$3"
mkdir -p "$3/bin"
cd "$3"
ln -s "$1" bin/vdbounce
PATH="$PWD/bin:$PATH"
cp "$source/data/bunny.obj" .
awk '/^```sh$/ { on = 1; next } /^```$/ { on = 0 } on' "$source/README.md" >commands.sh
# The scenes are called as the text calls them, in this order.
scenes=(scene.toml paddle.toml)
for i in "${!scenes[@]}"; do
    awk -v wanted="$i" '/^```toml$/ { on = (n++ == wanted); next } /^```$/ { on = 0 } on' "$source/README.md" >"${scenes[$i]}"
    test -s "${scenes[$i]}"
done
test -s commands.sh
bash -euxo pipefail commands.sh
for picture in *.png; do test -s "$picture"; done
