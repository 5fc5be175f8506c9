#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# On a terminal long work shows frame, rate and time left; in a pipe and with --quiet there is nothing of it.
# Skipped (77) where the system has no terminals to give, as in a bare chroot.
# usage: progress.sh VDBOUNCE SOURCE_FOLDER WORK_FOLDER
set -euo pipefail
vdbounce=$1
source=$2
rm -rf "$3"
mkdir -p "$3"
cd "$3"
"$vdbounce" mesh2ls "$source/data/bunny.obj" -o bunny.vdb --dim 64 --quiet
"$vdbounce" emit box --min=-3,9.8,-2 --max 3,12,2 -n 200000 -o cloud.vdb --quiet
printf '[time]\nframes = 10\n[particles]\nfile = "cloud.vdb"\n[[collider]]\nfile = "bunny.vdb"\n' >scene.toml
run=("$vdbounce" collide scene.toml)

# script gives the command a terminal of its own.
script -qec true /dev/null >/dev/null </dev/null || exit 77
script -qec "${run[*]}" /dev/null >terminal.txt </dev/null
tr '\r' '\n' <terminal.txt | grep -E 'frame [0-9]+/10 \[=* *\] [0-9.]+ M particle steps/s, [0-9:]+ left' >/dev/null
script -qec "${run[*]} --quiet" /dev/null >quiet.txt </dev/null
test ! -s quiet.txt
"${run[@]}" 2>pipe.txt >/dev/null
test ! -s pipe.txt
