#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The rules of docs/conventions.md that a script can check: folders are floors, every source file has its licence line and is
# short enough to read, public headers keep OpenVDB out, and nothing ties the project to one machine.
set -euo pipefail
cd "$(dirname "$0")/.."
failed=0
complain() {
    echo "$1"
    failed=1
}

# A floor may use itself and those before it.
floors=(base particles io field implicit build render contact scene)
for i in "${!floors[@]}"; do
    above=$(IFS='|'; echo "${floors[*]:$((i + 1))}")
    [ -z "$above" ] && continue
    if hits=$(grep -nE "#include \"vdbounce/($above)/" "lib/vdbounce/${floors[$i]}"/*); then
        complain "${floors[$i]} uses a floor above it:"$'\n'"$hits"
    fi
done

while read -r file; do
    grep -q 'SPDX-License-Identifier: Apache-2.0' "$file" || complain "$file: no licence line"
    lines=$(wc -l <"$file")
    if [[ $file != tests/* ]] && [ "$lines" -gt 300 ]; then complain "$file: $lines lines, at most 300"; fi
done < <(find lib tools tests examples cmake .ci dev -name node_modules -prune -o -type f \( -name '*.h' -o -name '*.cpp' -o -name '*.sh' -o -name '*.cmake' -o -name '*.js' -o -name '*.css' -o -name '*.html' -o -name dev -o -name run \) -print)

if hits=$(grep -lE '#include <openvdb/' lib/vdbounce/*/*.h | grep -vE 'io/(openvdb_grid|vdb_archive)\.h$'); then
    complain "public headers that include OpenVDB: $hits"
fi
for name in utils util misc common helpers; do
    if hits=$(find lib tools tests -name "$name.*"); [ -n "$hits" ]; then complain "a file for leftovers: $hits"; fi
done
if hits=$(grep -rnE '/(work|home|root)/' --include='*' --exclude-dir=node_modules lib tools tests examples cmake docs README.md dev .ci CMakeLists.txt 2>/dev/null | grep -v 'tests/structure.sh'); then
    complain "a path of one machine:"$'\n'"$hits"
fi
exit $failed
