#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# usage: csg_picture.sh VDBOUNCE OUT.png
# Draws docs/csg.png: a box less a turned box and with another one, left as min and max make it, right redistanced.
set -eu
tool=$(realpath "$1")
output=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# box NAME X Y HALF_X HALF_Y DEGREES: a level set of a box of depth 2, turned about z
box() {
    awk -v cx="$2" -v cy="$3" -v hx="$4" -v hy="$5" -v degrees="$6" 'BEGIN {
        c = cos(degrees * atan2(0, -1) / 180); s = sin(degrees * atan2(0, -1) / 180)
        for (z = -1; z <= 1; z += 2)
            for (i = 0; i < 4; ++i) {
                x = (i == 1 || i == 2) ? hx : -hx
                y = i > 1 ? hy : -hy
                print "v", cx + c * x - s * y, cy + s * x + c * y, z
            }
        print "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8"
    }' >"$1.obj"
    "$tool" mesh2ls "$1.obj" -o "$1.vdb" --voxel 0.04 --band 8vx --quiet
}

# solid NAME PLATE_X CUT_X BUMP_X [FLAG]
solid() {
    box plate "$2" 0 1.1 0.4 0
    box cut "$3" 0.45 0.36 0.36 45
    box bump "$4" 0.4 0.33 0.33 30
    "$tool" csg subtract plate.vdb cut.vdb -o notched.vdb --quiet
    "$tool" csg union notched.vdb bump.vdb -o "$1.vdb" --quiet ${5:-}
}

solid left -1.53 -0.98 -2.03
solid right 1.53 2.08 1.03 --redistance
"$tool" csg union left.vdb right.vdb -o both.vdb --quiet
"$tool" slice both.vdb --axis z --size 1100 -o picture.png --quiet
cd "$OLDPWD"
cp "$folder/picture.png" "$output"
