# SPDX-License-Identifier: Apache-2.0
"""Small triangle meshes, and what lies inside of them by their shape's own formula. Used by make.py."""
import math


class Mesh:
    """points: tuples of three numbers; faces: tuples of three indices, counter-clockwise seen from outside."""

    def __init__(self, points, faces):
        self.points = list(points)
        self.faces = list(faces)

    def __add__(self, other):
        shift = len(self.points)
        return Mesh(self.points + other.points, self.faces + [tuple(i + shift for i in f) for f in other.faces])

    def flipped(self):
        return Mesh(self.points, [(a, c, b) for a, b, c in self.faces])

    def soup(self):
        """Every triangle with points of its own."""
        return Mesh([self.points[i] for f in self.faces for i in f],
                    [(3 * t, 3 * t + 1, 3 * t + 2) for t in range(len(self.faces))])

    def corners(self):
        return [tuple(self.points[i] for i in f) for f in self.faces]


def add(a, b, s=1.0):
    return tuple(x + s * y for x, y in zip(a, b))


def sub(a, b):
    return add(a, b, -1.0)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(dot(a, a))


def box(lo, hi):
    points = [tuple((lo, hi)[i >> axis & 1][axis] for axis in range(3)) for i in range(8)]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return Mesh(points, [f for a, b, c, d in quads for f in ((a, b, c), (a, c, d))])


def sphere(radius, level, centre=(0, 0, 0)):
    """8 * 4^level triangles whose points lie on the sphere."""
    points = [(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(level):
        middles = {}

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                m = add(points[a], points[b])
                points.append(tuple(x / norm(m) for x in m))
            return middles[key]

        finer = []
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    return Mesh([add(centre, p, radius) for p in points], faces)


def tube(curve, radius, rings, sides, closed):
    """A tube around curve(0..1); `closed` joins its ends, else they get flat caps."""
    points, faces = [], []
    for i in range(rings):
        t = i / (rings if closed else rings - 1)
        c = curve(t)
        along = sub(curve(t + 1e-5), curve(t - 1e-5))
        along = tuple(x / norm(along) for x in along)
        across = cross((0.0, 0.0, 1.0), along)
        across = tuple(x / norm(across) for x in across)
        up = cross(along, across)
        for k in range(sides):
            angle = 2.0 * math.pi * k / sides
            points.append(add(add(c, across, radius * math.cos(angle)), up, radius * math.sin(angle)))
    for i in range(rings if closed else rings - 1):
        j = (i + 1) % rings
        for k in range(sides):
            l = (k + 1) % sides
            a, b, c, d = i * sides + k, i * sides + l, j * sides + l, j * sides + k
            faces += [(a, b, c), (a, c, d)]
    if not closed:
        last = (rings - 1) * sides
        faces += [(0, k + 1, k) for k in range(1, sides - 1)]
        faces += [(last, last + k, last + k + 1) for k in range(1, sides - 1)]
    return Mesh(points, faces)


def in_box(lo, hi):
    return lambda p: all(l < x < h for l, x, h in zip(lo, p, hi))


def in_ball(radius, centre=(0, 0, 0)):
    return lambda p: norm(sub(p, centre)) < radius


def in_tube(curve, radius, closed):
    """Within the radius of the curve, counting only discs at right angles to it, so that the ends are flat."""
    count = 600
    discs = []
    for i in range(count + 1):
        t = i / count
        along = sub(curve(t + 1e-5), curve(t - 1e-5))
        discs.append((curve(t), tuple(x / norm(along) for x in along)))
    step = max(norm(sub(a[0], b[0])) for a, b in zip(discs, discs[1:]))
    return lambda p: any(norm(sub(p, c)) < radius and abs(dot(sub(p, c), along)) < step for c, along in discs)


def distance_to_triangle(p, a, b, c):
    """Ericson, Real-Time Collision Detection, 5.1.5; triangles without area by their edges."""
    ab, ac = sub(b, a), sub(c, a)
    n = cross(ab, ac)
    if norm(n) > 1e-12 * (dot(ab, ab) + dot(ac, ac)):
        inside = all(dot(cross(sub(v, u), sub(p, u)), n) >= 0.0 for u, v in ((a, b), (b, c), (c, a)))
        if inside:
            return abs(dot(sub(p, a), n)) / norm(n)
    return min(distance_to_segment(p, u, v) for u, v in ((a, b), (b, c), (c, a)))


def distance_to_segment(p, u, v):
    along = sub(v, u)
    length2 = dot(along, along)
    t = 0.0 if length2 == 0.0 else max(0.0, min(1.0, dot(sub(p, u), along) / length2))
    return norm(sub(p, add(u, along, t)))


def distance(corners, p):
    return min(distance_to_triangle(p, *t) for t in corners)
