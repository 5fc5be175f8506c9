#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# OpenVDB's own programs read what vdbounce writes: vdb_print and pyopenvdb.
# usage: openvdb.sh VDBOUNCE SOURCE_FOLDER WORK_FOLDER
set -euo pipefail
vdbounce=$1
source=$2
mkdir -p "$3"
cd "$3"
"$vdbounce" mesh2ls "$source/data/bunny.obj" -o bunny.vdb --dim 64 --name bunny --json >report.json
# The first is what there is, the second what was expected.
active=$(sed -n 's/.*"active_voxels": \([0-9]*\).*/\1/p' report.json | head -n 1)
vdb_print -l bunny.vdb >print.txt
grep -q 'class: level set' print.txt
grep -q 'Name: bunny' print.txt
grep -q "Number of active voxels: *$(printf "%'d" "$active" | tr -d "'" | rev | sed 's/\([0-9]\{3\}\)/\1,/g;s/,$//' | rev)" print.txt

/usr/bin/python3 - "$active" <<'PYTHON'
import sys
import pyopenvdb as vdb
grid = vdb.read("bunny.vdb", "bunny")
assert grid.gridClass == vdb.GridClass.LEVEL_SET if hasattr(vdb, "GridClass") else grid.gridClass == "level set", grid.gridClass
assert grid.activeVoxelCount() == int(sys.argv[1])
voxel = grid.transform.voxelSize()[0]
assert abs(grid.background - 3 * voxel) < 1e-5
access = grid.getConstAccessor()
inside = tuple(int(round(c / voxel)) for c in (0.0, 3.0, 0.0))
assert access.getValue(inside) < 0 < access.getValue((10000, 0, 0))
PYTHON

"$vdbounce" emit box --min 0,0,0 --max 1,1,1 -n 1000 --velocity 1,2,3 --radius 0.1 --mass 2 -o points.vdb --quiet
vdb_print -l points.vdb >points.txt
grep -q 'ptdataidx32' points.txt
echo "vdb_print and pyopenvdb read what vdbounce writes"
