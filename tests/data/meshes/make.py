#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the meshes with defects in this folder, and expected.csv: points that are known to be inside or outside.

Inside is said by the shapes the meshes were made of, not by the meshes. Points lie at least 4.5 % of the mesh's size
from its surface, or where `near` puts them. check.py compares the table with the meshes."""
import math
import os
import random

from shapes import Mesh, add, box, distance, in_ball, in_box, in_tube, sphere, sub, tube

HERE = os.path.dirname(os.path.abspath(__file__))
CLEARANCE = 0.045  # of the box's longest side: more than a voxel from 24 voxels a side on
rows = []


def write_off(path, mesh):
    with open(path, "w", newline="\n") as file:
        file.write("OFF\n%d %d 0\n" % (len(mesh.points), len(mesh.faces)))
        file.writelines("%.9g %.9g %.9g\n" % tuple(x + 0.0 for x in p) for p in mesh.points)
        file.writelines("3 %d %d %d\n" % f for f in mesh.faces)


def write_stl(path, mesh):
    with open(path, "w", newline="\n") as file:
        file.write("solid three corners a triangle\n")
        for corners in mesh.corners():
            file.write("facet normal 0 0 0\nouter loop\n")
            file.writelines("vertex %.9g %.9g %.9g\n" % tuple(x + 0.0 for x in p) for p in corners)
            file.write("endloop\nendfacet\n")
        file.write("endsolid\n")


def entry(name, mesh, inside, near=()):
    """Writes a mesh and appends its points: the near ones, random ones on both sides, far ones. inside(p) may be None,
    where it is nobody's to say."""
    (write_stl if name.endswith(".stl") else write_off)(os.path.join(HERE, name), mesh)
    used = [p for corners in mesh.corners() for p in corners]
    lo = tuple(min(p[a] for p in used) for a in range(3))
    hi = tuple(max(p[a] for p in used) for a in range(3))
    size = max(sub(hi, lo))
    corners = mesh.corners()
    rng = random.Random(name)
    points = list(near)
    wanted = {True: 10, False: 10}
    for _ in range(160):
        if not any(wanted.values()):
            break
        p = tuple(round(l - 0.15 * size + rng.random() * (h - l + 0.3 * size), 4) for l, h in zip(lo, hi))
        if wanted.get(inside(p)) and distance(corners, p) > CLEARANCE * size:
            wanted[inside(p)] -= 1
            points.append(p)
    middle = tuple(0.5 * (l + h) for l, h in zip(lo, hi))
    for way in ((1, 0, 0), (0, -1, 0), (0, 0, 1), (-1, 1, 1), (1, -1, -1)):
        points += [tuple(round(x, 4) for x in add(middle, way, s * size)) for s in (0.8, 5.0)]
    rows.extend("%s,%.9g,%.9g,%.9g,%d" % ((name,) + tuple(x + 0.0 for x in p) + (inside(p),)) for p in points
                if inside(p) is not None)


def shells():
    one, half = sphere(1.0, 2), sphere(0.5, 2)
    wall = lambda p: in_ball(1.0)(p) and not in_ball(0.5)(p)
    near = [(0, 0, 0), (0.3, 0.1, 0), (0.75, 0, 0), (0, -0.75, 0), (0, 0.1, 0.75), (1.2, 0, 0), (0, 0, -1.2)]
    entry("nested-shells.off", one + half.flipped(), wall, near)
    entry("inside-out-nested-shells.off", (one + half.flipped()).flipped(), wall, near)
    entry("soup-nested-shells.off", (one + half.flipped()).soup(), wall, near)
    entry("reversed-half-nested-shells.off", half_reversed(one + half, 2), wall, near)
    # All face outwards: solid, cavity, solid.
    three = one + sphere(0.7, 2) + sphere(0.35, 2)
    entry("nested-shells-outward.off", three,
          wall3, [(0, 0, 0), (0.1, 0.1, 0), (0.53, 0, 0), (0, -0.53, 0), (0.85, 0, 0), (0, 0, 0.85)])


def wall3(p):
    return (in_ball(1.0)(p) + in_ball(0.7)(p) + in_ball(0.35)(p)) % 2 == 1


def half_reversed(mesh, seed):
    rng = random.Random(seed)
    return Mesh(mesh.points, [f if rng.random() < 0.5 else (f[0], f[2], f[1]) for f in mesh.faces])


def room():
    """A hollow box of six overlapping slabs: no surface of its own bounds the cavity, and nothing reaches it."""
    slabs = []
    for axis, reach in ((0, (0, 0.9, 0.9)), (1, (0.95, 0, 0.85)), (2, (0.8, 0.97, 0))):
        for side in (-1, 1):
            lo, hi = [-r for r in reach], list(reach)
            lo[axis], hi[axis] = sorted((0.7 * side, side))
            slabs.append((lo, hi))
    mesh = sum((box(*s) for s in slabs[1:]), box(*slabs[0]))
    near = [(0, 0, 0), (0.5, 0.5, 0.5), (0.85, 0, 0), (0, -0.85, 0), (0, 0, 0.85), (-0.85, 0.3, 0.2), (0.6, -0.6, 0)]
    entry("room-of-slabs.off", mesh, lambda p: any(in_box(*s)(p) for s in slabs), near)
    cavity = ([-0.4, -0.3, -0.6], [0.4, 0.5, 0.2])
    for name in ("cavity.off", "cavity.stl"):
        entry(name, box([-1] * 3, [1] * 3) + box(*cavity).flipped(),
              lambda p: in_box([-1] * 3, [1] * 3)(p) and not in_box(*cavity)(p),
              [(0, 0.1, -0.2), (0.25, -0.15, 0.05), (0.7, 0, 0), (0, 0, 0.6), (0, -0.65, 0)])


def self_intersections():
    eight = lambda t: (math.sin(2 * math.pi * t), math.sin(2 * math.pi * t) * math.cos(2 * math.pi * t), 0.0)
    entry("figure-eight-tube.off", tube(eight, 0.2, 36, 6, True), in_tube(eight, 0.2, True),
          [(0, 0, 0), (0.02, 0.01, 0.05), (0.7071, 0.5, 0), (-0.7071, -0.5, 0), (0.55, 0, 0), (-0.55, 0, 0),
           (0, 0.5, 0), (0, 0, 0.4)] + [tuple(round(x, 4) for x in eight((i + 0.5) / 12)) for i in range(12)])
    turn = 2 * math.pi + 0.9
    coil = lambda t: (0.8 * math.cos(turn * t), 0.8 * math.sin(turn * t), 0.15 * t)
    over = [(0.8 * math.cos(a), 0.8 * math.sin(a), 0.075) for a in (0.25, 0.45, 0.65)]
    entry("coil-into-itself.off", tube(coil, 0.25, 36, 6, False), in_tube(coil, 0.25, False),
          over + [(-0.8, 0, 0.07), (0, -0.8, 0.1), (0, 0, 0), (0, 0, 0.1), (0.4, 0, 0.1)] +
          [tuple(round(x, 4) for x in coil((i + 0.5) / 8)) for i in range(8)])


def overlaps():
    a, b = ([-1, -0.5, -0.5], [0.3, 0.5, 0.5]), ([-0.2, -0.3, -0.4], [1, 0.7, 0.6])
    both = lambda p: in_box(*a)(p) or in_box(*b)(p)
    near = [(0.05, 0.1, 0.05), (0, 0, 0), (-0.6, 0, 0), (0.65, 0.2, 0.1), (0.65, -0.42, 0), (-0.6, 0.6, 0)]
    entry("overlapping-boxes.off", box(*a) + box(*b), both, near)
    ball = (0.5, (0.0, 2.0, 0.0))
    entry("overlap-beside-reversed.off", box(*a) + box(*b) + half_reversed(sphere(*ball[:1], 2, ball[1]), 3),
          lambda p: both(p) or in_ball(*ball)(p), near + [(0, 2, 0), (0.2, 2.1, 0), (0, 1.1, 0), (0.7, 2, 0)])
    touching = ([-1, -0.5, -0.5], [0, 0.5, 0.5]), ([0, -0.5, -0.5], [1, 0.5, 0.5])
    entry("touching-boxes.off", box(*touching[0]) + box(*touching[1]), in_box([-1, -0.5, -0.5], [1, 0.5, 0.5]),
          [(-0.2, 0, 0), (0.2, 0, 0), (0.2, 0.3, -0.3), (0, 0.7, 0), (0, 0, -0.7)])
    # A box that faces inwards takes away what it covers, and adds nothing where it covers nothing.
    solid, cutter = ([-1, -1, -1], [1, 1, 1]), ([0.2, -0.5, -0.4], [1.8, 0.6, 0.5])
    entry("cutter.off", box(*solid) + box(*cutter).flipped(), lambda p: in_box(*solid)(p) and not in_box(*cutter)(p),
          [(0.6, 0, 0), (0.5, 0.2, 0.2), (1.4, 0, 0), (1.5, 0.2, 0.1), (0.6, 0.8, 0), (0.6, 0, 0.75), (0, 0, 0)])
    gap = ([-1.05, -0.5, -0.5], [-0.05, 0.5, 0.5]), ([0.05, -0.5, -0.5], [1.05, 0.5, 0.5])
    entry("boxes-with-gap.off", box(*gap[0]) + box(*gap[1]), lambda p: in_box(*gap[0])(p) or in_box(*gap[1])(p),
          [(0, 0, 0), (0, 0.3, -0.2), (0, -0.45, 0.4), (0.01, 0.1, 0.1), (-0.5, 0, 0), (0.5, 0, 0), (-0.15, 0, 0)])


def faces_gone_wrong():
    ball, solid = sphere(1.0, 2), in_ball(1.0)
    near = [(0, 0, 0), (0.5, 0.2, 0.1), (0.85, 0, 0), (0, 0.85, 0), (0, 0, -0.85), (1.12, 0, 0), (0, -1.12, 0.1)]
    entry("duplicate-faces.off", Mesh(ball.points, ball.faces + ball.faces), solid, near)
    some = [(b, c, a) for a, b, c in ball.faces[::3]]
    entry("duplicate-some-faces.off", Mesh(ball.points, ball.faces + some), solid, near)
    entry("duplicate-shell.off", ball + ball, solid, near)
    entry("reversed-half.off", half_reversed(ball, 1), solid, near)
    entry("inside-out.off", ball.flipped(), solid, near)
    rng = random.Random(4)
    torn = ball.soup()
    torn.points = [add(p, tuple(rng.uniform(-1e-3, 1e-3) for _ in range(3))) for p in torn.points]
    entry("torn.off", torn, solid, near)
    entry("soup.off", ball.soup(), solid, near)
    entry("sphere-with-hole.off", Mesh(ball.points, ball.faces[:60] + ball.faces[61:]), solid, [])
    entry("box-without-lid.off", Mesh(box([-1] * 3, [1] * 3).points, box([-1] * 3, [1] * 3).faces[:10]),
          lidless, [(0, 0, -0.5), (0.7, 0.7, -0.6), (-0.8, 0, -0.2), (0, 0, 0), (0, 0, 2), (1.3, 0, 0.5)])
    # Points held twice by neighbouring faces, and points that no face uses, one of them far away.
    twice = Mesh(ball.points + [add(p, (0, 0, 0)) for p in ball.points] + [(0, 0, 0), (100, 100, 100), (0.5, 0, 0)],
                 [f if i % 3 else tuple(x + len(ball.points) for x in f) for i, f in enumerate(ball.faces)])
    entry("duplicate-vertices.off", twice, solid, near)


def lidless(p):
    near_lid = abs(p[0]) < 1.3 and abs(p[1]) < 1.3 and 0.2 < p[2] < 1.7
    return None if near_lid else in_box([-1] * 3, [1] * 3)(p)


def edges_gone_wrong():
    # Each defect closes what it opens: a point in the middle of an edge with a triangle without area, a needle.
    mesh = box([-1] * 3, [1] * 3)
    a, b, c = mesh.faces.pop(0)
    middle, close = len(mesh.points), len(mesh.points) + 1
    mesh.points.append(tuple(0.5 * (x + y) for x, y in zip(mesh.points[a], mesh.points[b])))
    mesh.points.append(add(mesh.points[a], sub(mesh.points[b], mesh.points[a]), 1e-7))
    mesh.faces += [(a, close, c), (close, middle, c), (middle, b, c), (a, b, middle), (a, middle, close)]
    mesh.faces += [(1, 1, 7), (middle, middle, middle), (2, 6, 2), (0, 1, 1)]
    cube = in_box([-1] * 3, [1] * 3)
    near = [(0, 0, 0), (0.85, 0, 0), (-0.85, 0, 0.9), (-0.85, -0.85, 0)]
    near += [(-1.15, -1.15, 0), (-1.15, 0, -1), (0, 0, 1.15)]
    entry("degenerate.off", mesh, cube, near)

    first = box([-1, -1, -1], [0, 0, 1])
    second = box([0, 0, -1], [1, 1, 1])
    share = {second.points.index((0, 0, z)): first.points.index((0, 0, z)) for z in (-1, 1)}
    shift = len(first.points)
    joined = Mesh(first.points + second.points,
                  first.faces + [tuple(share.get(i, i + shift) for i in f) for f in second.faces])
    entry("cubes-sharing-edge.off", joined,
          lambda p: in_box([-1, -1, -1], [0, 0, 1])(p) or in_box([0, 0, -1], [1, 1, 1])(p),
          [(-0.15, -0.15, 0), (0.15, 0.15, 0), (0.15, -0.15, 0), (-0.15, 0.15, 0), (0.15, 0.15, 0.8), (-0.5, 0.5, 0)])

    halves = box([-1, -1, -1], [0, 1, 1]) + box([0, -1, -1], [1, 1, 1])
    wall = [f for f in halves.faces[:12] if all(halves.points[i][0] == 0 for i in f)]
    faces = [f for f in halves.faces if not all(halves.points[i][0] == 0 for i in f)] + wall
    at = {p: i for i, p in reversed(list(enumerate(halves.points)))}
    entry("cube-with-inner-wall.off", Mesh(halves.points, [tuple(at[halves.points[i]] for i in f) for f in faces]),
          cube, [(-0.15, 0, 0), (0.15, 0, 0), (0.3, 0.5, -0.5), (-0.3, 0.5, -0.5), (0.5, 0, 0), (-0.5, 0, 0)])

    # One face of a turned box is cut into a grid, its neighbours are not, so that digits open cracks of 1e-9.
    mesh = box([-1] * 3, [1] * 3)
    mesh.faces = [f for f in mesh.faces if not all(mesh.points[i][0] == 1 for i in f)]
    grid = [(1, -1 + 0.5 * i, -1 + 0.5 * j) for i in range(5) for j in range(5)]
    quads = [(5 * i + j + 8, 5 * i + j + 13, 5 * i + j + 14, 5 * i + j + 9) for i in range(4) for j in range(4)]
    mesh = Mesh(mesh.points + grid, mesh.faces + [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))])
    turn = lambda p: tuple(sum(r * x for r, x in zip(row, p)) / 3 for row in ((2, -1, 2), (2, 2, -1), (-1, 2, 2)))
    back = lambda p: tuple(sum(r * x for r, x in zip(row, p)) / 3 for row in ((2, 2, -1), (-1, 2, 2), (2, -1, 2)))
    mesh.points = [turn(p) for p in mesh.points]
    entry("t-junctions.off", mesh, lambda p: cube(back(p)),
          [tuple(round(x, 4) for x in turn(p)) for p in [(0, 0, 0), (0.8, 0.5, 0.8), (1.2, 0.5, 0.9), (0.8, -0.8, 0)]])


def many_and_thin():
    mesh, balls = None, []
    for i in range(27):
        centre = (i % 3 - 1.0, i // 3 % 3 - 1.0, i // 9 - 1.0)
        part = sphere(0.35, 1, centre)
        if i % 3 == (i // 3) % 3:  # a hollow one, whose inner wall faces one way or the other
            inner = sphere(0.2, 1, centre)
            part = part + (inner if i % 2 else inner.flipped())
        balls.append((centre, i % 3 == (i // 3) % 3))
        mesh = part if mesh is None else mesh + part
    solid = lambda p: any(in_ball(0.35, c)(p) and not (hollow and in_ball(0.2, c)(p)) for c, hollow in balls)
    near = [c for c, _ in balls] + [add(c, (0, 0.26, 0)) for c, _ in balls[::2]] + [(0.5, 0, 0), (0.5, 0.5, 0.5)]
    entry("lattice-of-spheres.off", mesh, solid, near)

    # Faces exactly at voxel centres where the voxel is 1, or a half.
    whole = ([-4, -3, -2], [4, 3, 2])
    entry("faces-on-voxels.off", box(*whole), in_box(*whole),
          [(x, y, z) for x in (-3, -3.5, 5, 4.5) for y, z in ((0, 0), (2, -1), (2.5, 1.5))])
    # 0.3 voxels thick where the longest side is 64 voxels; its middle holds the voxel centres of z = 0.
    plate = ([-1, -0.7, -0.0047], [1, 0.7, 0.0047])
    near = [(0, 0, 0), (0.25, 0.25, 0), (0.5, -0.5, 0), (-0.75, 0.25, 0)]
    near += [(20 / 41, -10 / 41, 0), (-30 / 41, 20 / 41, 0)]
    near += [(0.25, 0.25, s / n) for s in (-1, 1) for n in (12, 32)] + [(10 / 41, 0, s * 2 / 41) for s in (-1, 1)]
    entry("thin-plate.off", box(*plate), in_box(*plate), near)


shells()
room()
self_intersections()
overlaps()
faces_gone_wrong()
edges_gone_wrong()
many_and_thin()
with open(os.path.join(HERE, "expected.csv"), "w", newline="\n") as file:
    file.write("mesh,x,y,z,inside\n" + "".join(row + "\n" for row in rows))
