#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Ctrl-C in the middle of a run and of a conversion: exit code 130 and no half-written file.
# usage: interrupt.sh VDBOUNCE SOURCE_FOLDER WORK_FOLDER
set -euo pipefail
vdbounce=$1
source=$2
rm -rf "$3"
mkdir -p "$3"
cd "$3"

# interrupted FOLDER COMMAND...: starts, sends SIGINT after a moment, wants 130.
interrupted() {
    "$@" >out.txt 2>err.txt &
    local process=$!
    sleep 1
    kill -INT $process
    local code=0
    wait $process || code=$?
    if [ $code != 130 ] || [ "$(wc -l <err.txt)" != 1 ]; then
        echo "exit code $code of: $*"
        cat err.txt
        exit 1
    fi
}

# Background processes of a shell without job control ignore SIGINT; the tool must catch it all the same.
"$vdbounce" mesh2ls "$source/data/bunny.obj" -o bunny.vdb --dim 64 --quiet
"$vdbounce" emit box --min=-3,9.8,-2 --max 3,12,2 -n 200000 -o cloud.vdb --quiet
interrupted "$vdbounce" collide --collider bunny.vdb --particles cloud.vdb -o after.vdb --steps 100000
interrupted "$vdbounce" mesh2ls "$source/data/bunny.obj" -o fine.vdb --dim 3000 --json
test ! -e after.vdb
test ! -e fine.vdb
test -z "$(find . -name '*.part-*')"
