#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Ctrl-C at any time of a large conversion, while it reads, builds or writes: exit code 130 within half a second, one line and no file.
# usage: interrupt_conversion.sh VDBOUNCE WORK_FOLDER
set -euo pipefail
vdbounce=$1
rm -rf "$2"
mkdir -p "$2"
cd "$2"

# A bumpy sphere of two million triangles: rows of 2000 by 500 quadrilaterals, as binary PLY.
python3 - <<'PYTHON'
import array, math, sys
around, rows = 2000, 500
points = array.array('f')
for row in range(rows + 1):
    polar = math.pi * row / rows
    z, ring = math.cos(polar), math.sin(polar)
    for column in range(around):
        angle = 2 * math.pi * column / around
        points.extend((ring * math.cos(angle), ring * math.sin(angle), z))
faces = bytearray()
for row in range(rows):
    a = array.array('i', range(row * around, (row + 1) * around))
    packed = bytearray()
    for column in range(around):
        after = (column + 1) % around
        i, j, k, l = a[column], a[column] + around, a[after] + around, a[after]
        packed += b'\x03' + array.array('i', (i, j, k)).tobytes() + b'\x03' + array.array('i', (i, k, l)).tobytes()
    faces += packed
if sys.byteorder != 'little':
    sys.exit('this script writes little-endian files')
with open('sphere.ply', 'wb') as file:
    file.write(b'ply\nformat binary_little_endian 1.0\nelement vertex %d\n' % (len(points) // 3))
    file.write(b'property float x\nproperty float y\nproperty float z\nelement face %d\n' % (2 * around * rows))
    file.write(b'property list uchar int vertex_indices\nend_header\n')
    file.write(points.tobytes())
    file.write(faces)
PYTHON

milliseconds() { echo $(($(date +%s%N) / 1000000)); }

# interrupted DIM COMMAND...: starts, sends SIGINT once COMMAND is done, wants 130 at once and nothing left behind.
interrupted() {
    "$vdbounce" mesh2ls sphere.ply -o sphere.vdb --dim "$1" --json >out.txt 2>err.txt &
    local process=$!
    shift
    # Before the tool is ready for it a process in the background ignores the signal.
    until grep -q '^SigCgt:.*[2367abef]$' /proc/$process/status; do sleep 0.01; done
    "$@"
    kill -INT $process
    local begin code=0 took
    begin=$(milliseconds)
    wait $process || code=$?
    took=$(($(milliseconds) - begin))
    if [ $code != 130 ] || [ $took -gt 500 ] || [ "$(grep -c '^vdbounce: error: interrupted' err.txt)" != 1 ]; then
        echo "after '$*': exit code $code, $took ms"
        cat err.txt
        exit 1
    fi
    test ! -e sphere.vdb
    test -z "$(find . -name '*.part-*')"
}

writingBegins() { until compgen -G '*.part-*' >/dev/null; do sleep 0.01; done; }

for seconds in 0 0.3 0.8 1.4; do interrupted 900 sleep $seconds; done
interrupted 300 writingBegins
