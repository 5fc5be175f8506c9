#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The main job from end to end: mesh to level set, a cloud of particles poured over it, a picture.
# usage: demo.sh VDBOUNCE OUT_FOLDER [PARTICLES]
set -euo pipefail
vdbounce=$(realpath "$1")
mkdir -p "$2"
out=$(realpath "$2")
particles=${3:-1000000}
here=$(dirname "$(realpath "$0")")

"$vdbounce" mesh2ls "$here/../data/bunny.obj" -o "$out/bunny.vdb" --dim 160 --quiet
"$vdbounce" emit box --min=-3.6,10,-2 --max 2.8,20,2.4 --velocity 0,-3,0 -n "$particles" -o "$out/cloud.vdb" --quiet
cp "$here/bunny.toml" "$out/bunny.toml"
"$vdbounce" collide "$out/bunny.toml"
"$vdbounce" render "$out/bunny.vdb" "$out/demo.0060.vdb" --ground 0 --view 0.35,0.30,1 --size 1600x1200 \
    --particle-radius 0.014 --frame-min=-5.8,-1.2,-4.2 --frame-max 5.6,9.8,4.6 -o "$out/demo.png" --quiet
echo "demo done: $particles particles poured over the bunny; picture: $out/demo.png, frames: $out/demo.####.vdb"
