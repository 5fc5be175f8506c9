#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A million particles dropped on the bunny: none lost, none NaN, all with phi >= radius - 1e-4 voxel at the end, and the
# same files from one thread and from two.
# usage: main_job.sh VDBOUNCE SOURCE_FOLDER WORK_FOLDER
set -euo pipefail
vdbounce=$1
source=$2
mkdir -p "$3"
cd "$3"
count=1000000
radius=0.01

"$vdbounce" mesh2ls "$source/data/bunny.obj" -o bunny.vdb --dim 128 --quiet
"$vdbounce" emit box --min=-4,9.7,-3 --max 4,13,3 -n $count -o cloud.vdb --quiet
voxel=$("$vdbounce" info --json bunny.vdb | sed -n '/voxel_size/{n;s/[ ,]//gp;}')
for threads in 1 2; do
    "$vdbounce" collide --collider bunny.vdb --particles cloud.vdb -o "after$threads.vdb" --steps 300 --radius $radius \
        --threads $threads --json >"report$threads.json"
done
cmp after1.vdb after2.vdb
for key in free near contacts swept unresolved energy_final; do
    diff <(grep "\"$key\"" report1.json) <(grep "\"$key\"" report2.json)
done

"$vdbounce" sample bunny.vdb --at after1.vdb -o phi.csv --quiet
awk -F, -v count=$count -v least="$radius" -v voxel="$voxel" '
    NR == 1 { next }
    /nan|inf/ { print "not finite: " $0; bad = 1 }
    { if (NR == 2 || $4 + 0 < lowest) lowest = $4 + 0 }
    END {
        printf "particles %d, lowest phi %.9g, radius %g, voxel %g\n", NR - 1, lowest, least, voxel
        exit !(!bad && NR - 1 == count && voxel > 0 && lowest >= least - 1e-4 * voxel)
    }' phi.csv
"$vdbounce" convert after1.vdb after.csv --quiet
awk -F, 'NR > 1 && $NF != NR - 2 { print "lost id " NR - 2; exit 1 }' after.csv
rm -f ./*.vdb ./*.csv
