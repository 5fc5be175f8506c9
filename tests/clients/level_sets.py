#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""vdb_print and pyopenvdb read the level sets that make, csg, blobs and redistance write, and find in them what the
formulas say and what vdbounce info tells.
usage: level_sets.py VDBOUNCE WORK_FOLDER"""
import json
import math
import os
import subprocess
import sys

import pyopenvdb

VDBOUNCE = os.path.abspath(sys.argv[1])
VOXEL = 0.05
BAND = 3 * VOXEL
ROUNDING = 1e-6  # of floats of the size of the band, and of coordinates
STRIDE = 7  # of the active voxels that are looked at: one in so many, no power of two


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{' '.join(map(str, words))}: {done.stderr}"
    return done.stdout


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def box_distance(d):
    """Signed distance, given how far a point is beyond the faces along each axis."""
    return math.hypot(*(max(x, 0.0) for x in d)) + min(max(d), 0.0)


def sphere(p, centre=(0, 0, 0), radius=0.5):
    return math.dist(p, centre) - radius


def turned_box(p):  # by 90 degrees about z: the first side lies along y
    return box_distance(minus(map(abs, p), (0.2, 0.5, 0.3)))


def torus(p):
    return math.hypot(math.hypot(p[0], p[2]) - 0.5, p[1]) - 0.2


def capsule(p):
    return math.hypot(p[0], p[1] - min(max(p[1], 0.0), 0.5), p[2]) - 0.2


def cylinder(p):
    return box_distance([math.hypot(p[0], p[2]) - 0.2, abs(p[1] - 0.25) - 0.25])


def polygon_distance(p, corners):
    """Of a convex polygon, its corners to the left of one another."""
    nearest, outside = math.inf, False
    for a, b in zip(corners, corners[1:] + corners[:1]):
        edge, way = minus(b, a), minus(p, a)
        share = min(max((edge[0] * way[0] + edge[1] * way[1]) / (edge[0] ** 2 + edge[1] ** 2), 0.0), 1.0)
        nearest = min(nearest, math.hypot(way[0] - share * edge[0], way[1] - share * edge[1]))
        outside = outside or edge[0] * way[1] - edge[1] * way[0] < 0
    return nearest if outside else -nearest


def cone(p):  # its half plane through the axis, and that one's mirror image
    return polygon_distance((math.hypot(p[0], p[2]), p[1]), [(-0.4, 0.0), (0.4, 0.0), (0.1, 0.6), (-0.1, 0.6)])


def ellipsoid(p, radii=(0.6, 0.4, 0.5)):
    """By where the normal through p meets it, r^2 p / (t + r^2); from everywhere closer than the radii of curvature."""
    least, most = -min(radii) ** 2, 10.0  # t, the sum below falling between them
    for _ in range(60):
        t = 0.5 * (least + most)
        if sum((r * x / (t + r * r)) ** 2 for x, r in zip(p, radii)) > 1:
            least = t
        else:
            most = t
    return math.copysign(math.dist(p, [r * r * x / (t + r * r) for x, r in zip(p, radii)]), t)


def hill(p):  # the cross section of what lies under hill.csv, without end along z
    return polygon_distance((p[0], p[1]), [(-1, -0.5), (1, -0.5), (1, 0), (0, 0.5), (-1, 0)])


def ridge(p):  # that between two flat ends
    across, along = hill(p), abs(p[2]) - 1.0
    return math.hypot(across, along) if across > 0 and along > 0 else max(across, along)


def described(name):
    """What the three programs say of a file; the grid."""
    ours = json.loads(run(VDBOUNCE, "info", "--json", name))["files"][0]["holds"]
    assert len(ours) == 1, f"{name}: {len(ours)} grids"
    printed = run("vdb_print", "-l", name)
    assert "class: level set" in printed, f"{name}: {printed}"
    count = ours[0]["active_voxels"]
    assert f"{count:,}" in [line.split()[-1] for line in printed.splitlines() if "active voxels:  " in line], printed
    grids = pyopenvdb.readAll(name)[0]
    assert len(grids) == 1 and grids[0].name == ours[0]["name"] == "surface", name
    grid = grids[0]
    assert grid.gridClass == "level set" and grid.valueTypeName == "float", (name, grid.gridClass)
    assert grid.activeVoxelCount() == count > 1000, (name, grid.activeVoxelCount(), count)
    assert grid.background == ours[0]["background"], (name, grid.background)
    assert grid.transform.voxelSize() == (VOXEL,) * 3, name
    return grid


def check(name, phi, error=ROUNDING, band=BAND):
    """Compares values with phi, `error` world units being allowed."""
    grid = described(name)
    assert abs(grid.background - band) < ROUNDING, (name, grid.background)
    for number, item in enumerate(grid.citerOnValues()):
        expected = phi(grid.transform.indexToWorld(item.min)) if number % STRIDE == 0 else item.value
        assert abs(item.value - expected) <= error, (name, item.min, item.value, expected)
    values = grid.getConstAccessor()
    assert values.getValue((10000, 0, 0)) == grid.background and not values.isValueOn((10000, 0, 0)), name
    return values


def shapes():
    """Arguments of make, and the distance."""
    with open("hill.csv", "w", encoding="utf-8") as heights:
        heights.write("0,1,0\n0,1,0\n")
    return {
        "sphere": ("--center 0,0,0 --radius 0.5", sphere),
        "box": ("--center 0,0,0 --half 0.5,0.2,0.3 --rotate 0.70710678,0,0,0.70710678", turned_box),
        "torus": ("--center 0,0,0 --axis 0,1,0 --major 0.5 --minor 0.2", torus),
        "capsule": ("--from 0,0,0 --to 0,0.5,0 --radius 0.2", capsule),
        "cylinder": ("--from 0,0,0 --to 0,0.5,0 --radius 0.2", cylinder),
        "cone": ("--from 0,0,0 --to 0,0.6,0 --radius 0.4 --top-radius 0.1", cone),
        "ellipsoid": ("--center 0,0,0 --radii 0.6,0.4,0.5", ellipsoid),
        "plane": ("--point 0,0.11,0 --normal 0,1,0 --min=-1,-0.5,-1 --max 1,0.5,1", lambda p: p[1] - 0.11),
        "heightfield": ("hill.csv --min=-1,0,-1 --max 1,0.5,1 --base=-0.5", ridge),
    }


def check_made():
    for shape, (arguments, phi) in shapes().items():
        run(VDBOUNCE, "make", shape, *arguments.split(), "--voxel", VOXEL, "-o", f"{shape}.vdb", "--quiet")
        values = check(f"{shape}.vdb", phi)
        if shape in ("sphere", "ellipsoid"):
            deep = values.getValue((0, 0, 0))
            assert abs(deep + BAND) < ROUNDING and not values.isValueOn((0, 0, 0)), (shape, deep)


def check_combined():
    ball = "--center 0.3,0,0 --radius 0.5"
    run(VDBOUNCE, "make", "sphere", *ball.split(), "--voxel", VOXEL, "-o", "beside.vdb", "--quiet")

    def beside(p):
        return sphere(p, (0.3, 0, 0))

    results = {
        "union": lambda p: min(sphere(p), beside(p)),
        "intersect": lambda p: max(sphere(p), beside(p)),
        "subtract": lambda p: max(sphere(p), -beside(p)),
    }
    for operation, phi in results.items():
        run(VDBOUNCE, "csg", operation, "sphere.vdb", "beside.vdb", "-o", f"{operation}.vdb", "--quiet")
        check(f"{operation}.vdb", phi)


def check_blobs():
    with open("drops.csv", "w", encoding="utf-8") as drops:
        drops.write("x,y,z,radius\n0,0,0,0.5\n0.61,0.02,0,0.3\n")
    with open("drop.csv", "w", encoding="utf-8") as drop:
        drop.write("x,y,z,radius\n0,0,0,0.5\n")
    blobs = [VDBOUNCE, "blobs", "--voxel", VOXEL, "--quiet"]
    run(*blobs, "drops.csv", "--kernel", "sphere", "-o", "spheres.vdb")
    check("spheres.vdb", lambda p: min(sphere(p), sphere(p, (0.61, 0.02, 0), 0.3)))
    for kernel in ("gaussian", "compact"):
        run(*blobs, "drop.csv", "--kernel", kernel, "-o", f"{kernel}.vdb")
        check(f"{kernel}.vdb", sphere, 0.02 * VOXEL)


def check_redistanced():
    run(VDBOUNCE, "redistance", "torus.vdb", "--band", "4vx", "-o", "wider.vdb", "--quiet")
    check("wider.vdb", torus, 0.05 * VOXEL, 4 * VOXEL)
    run(VDBOUNCE, "redistance", "sphere.vdb", "--iso", VOXEL / 2, "-o", "larger.vdb", "--quiet")
    check("larger.vdb", lambda p: sphere(p) - VOXEL / 2, 0.01 * VOXEL)


def check_complement():
    # What lies beyond the hole is inside to no end, so that far away is not the background.
    run(VDBOUNCE, "csg", "complement", "sphere.vdb", "-o", "hole.vdb", "--quiet")
    values = described("hole.vdb").getConstAccessor()
    for x in range(-14, 15):
        distance = 0.5 - abs(x) * VOXEL
        assert abs(values.getValue((x, 0, 0)) - min(max(distance, -BAND), BAND)) < ROUNDING, x


os.makedirs(sys.argv[2], exist_ok=True)
os.chdir(sys.argv[2])
check_made()
check_combined()
check_blobs()
check_redistanced()
check_complement()
print("vdb_print and pyopenvdb read the level sets that vdbounce makes")
