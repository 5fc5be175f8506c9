#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks expected.csv against the meshes alone, by exact solid angles and by counting crossings of rays.

Exits 1 where a point is not where the table says. What makes a point inside is named for each mesh: `winding`, more
than half of a sphere's solid angle; `either way`, the same whichever way the faces point; `parity`, an odd number of
crossings on most of seven rays; `parts`, parity for any one of the mesh's connected parts. The first is the default."""
import collections
import math
import os
import sys

from shapes import Mesh, cross, distance, dot, norm, sub

HERE = os.path.dirname(os.path.abspath(__file__))
RULES = {
    "nested-shells.off": ("winding", "parity"),
    "nested-shells-outward.off": ("parity",),
    "soup-nested-shells.off": ("winding", "parity"),
    "inside-out.off": ("either way", "parity"),
    "inside-out-nested-shells.off": ("either way", "parity"),
    "reversed-half.off": ("parity", "parts"),
    "reversed-half-nested-shells.off": ("parity",),
    "cavity.off": ("winding", "parity"),
    "cavity.stl": ("winding", "parity"),
    "room-of-slabs.off": ("winding", "parts"),
    "overlapping-boxes.off": ("winding", "parts"),
    "overlap-beside-reversed.off": ("parts",),
    "touching-boxes.off": ("winding", "parts"),
    "duplicate-shell.off": ("winding", "parts"),
    "boxes-with-gap.off": ("winding", "parity", "parts"),
    "lattice-of-spheres.off": ("parity",),
    "degenerate.off": ("winding", "parity"),
    "cubes-sharing-edge.off": ("winding", "parity"),
    "t-junctions.off": ("winding", "parity"),
    "thin-plate.off": ("winding", "parity"),
    "faces-on-voxels.off": ("winding", "parity"),
}
RAYS = [(0.3571, 0.6113, 0.7061), (-0.7193, 0.2239, 0.6577), (0.5171, -0.8221, 0.2389), (-0.2713, -0.4337, -0.8591),
        (0.8887, 0.1171, -0.4431), (-0.6113, 0.7877, -0.0757), (0.0917, -0.3391, 0.9361)]


def read(path):
    if path.endswith(".stl"):
        numbers = [tuple(map(float, line.split()[1:])) for line in open(path) if line.startswith("vertex")]
        return Mesh(numbers, [(t, t + 1, t + 2) for t in range(0, len(numbers), 3)])
    words = open(path).read().split()
    points, faces = int(words[1]), int(words[2])
    numbers = words[4:]
    mesh = Mesh([tuple(map(float, numbers[3 * i:3 * i + 3])) for i in range(points)], [])
    numbers = numbers[3 * points:]
    mesh.faces = [tuple(map(int, numbers[4 * i + 1:4 * i + 4])) for i in range(faces)]
    return mesh


def winding(triangles, p):
    """Van Oosterom and Strackee, 1983."""
    total = 0.0
    for t in triangles:
        a, b, c = (sub(q, p) for q in t)
        la, lb, lc = norm(a), norm(b), norm(c)
        total += math.atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)
    return total / (2.0 * math.pi)


def crosses(p, way, a, b, c):
    ab, ac = sub(b, a), sub(c, a)
    h = cross(way, ac)
    det = dot(ab, h)
    if abs(det) < 1e-14:
        return False
    s = sub(p, a)
    u = dot(s, h) / det
    q = cross(s, ab)
    v = dot(way, q) / det
    return u >= 0.0 and v >= 0.0 and u + v <= 1.0 and dot(ac, q) / det > 0.0


def odd(triangles, p):
    return sum(sum(crosses(p, way, *t) for t in triangles) % 2 for way in RAYS) > len(RAYS) // 2


def parts(mesh):
    parent = list(range(len(mesh.points)))

    def root(i):
        while parent[i] != i:
            parent[i] = i = parent[parent[i]]
        return i

    for a, b, c in mesh.faces:
        parent[root(a)] = root(b)
        parent[root(c)] = root(b)
    found = collections.defaultdict(list)
    for face, corners in zip(mesh.faces, mesh.corners()):
        found[root(face[0])].append(corners)
    return list(found.values())


table = collections.defaultdict(list)
with open(os.path.join(HERE, "expected.csv")) as file:
    for line in list(file)[1:]:
        name, x, y, z, inside = line.strip().split(",")
        table[name].append(((float(x), float(y), float(z)), inside == "1"))

failed = 0
for name, points in table.items():
    mesh = read(os.path.join(HERE, name))
    triangles = mesh.corners()
    pieces = parts(mesh)
    size = max(max(p[a] for t in triangles for p in t) - min(p[a] for t in triangles for p in t) for a in range(3))
    margin, nearest = math.inf, math.inf
    rules = RULES.get(name, ("winding",))
    for p, inside in points:
        nearest = min(nearest, distance(triangles, p) / size)
        for rule in rules:
            if rule in ("winding", "either way"):
                w = winding(triangles, p)
                w = abs(w) if rule == "either way" else w
                margin = min(margin, abs(w - 0.5))
                said = w > 0.5
            else:
                said = odd(triangles, p) if rule == "parity" else any(odd(part, p) for part in pieces)
            if said != inside:
                failed += 1
                print("%s: %s is %s by %s" % (name, p, "inside" if said else "outside", rule))
    print("%-32s %3d points, %2d inside, %4d triangles, nearest %.4f of the box, winding %.3f from a half, by %s" %
          (name, len(points), sum(i for _, i in points), len(triangles), nearest, margin, ", ".join(rules)))
sys.exit(failed > 0)
