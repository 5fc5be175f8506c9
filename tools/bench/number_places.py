# SPDX-License-Identifier: Apache-2.0
"""Where the numbers of a picture's marked points can stand without hiding anything that matters."""
import math

NEAREST = 15  # pixels from the middle of a point to that of its number
REACHES = (NEAREST, 22, 30, 40, 52, 66, 82, 100)
# Below and left first: of error over cost nothing lies there, or the point would be beaten.
ANGLES = [math.radians(angle) for angle in (135, 180, 90, 155, 110, 225, 45, 270, 0, 315)]
IN_THE_WAY = 9  # pixels further that are as good as not to cover a grey point or a line


def around(x, y, width, height):
    return x - width, y - height, x + width, y + height


def meet(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def find(points, others, lines, area):
    """(x, y) of the number of each of `points`: within `area`, never on another number or point where that can be
    helped, rather near than far, rather not on `others` or `lines`, which are boxes (left, top, right, bottom)."""
    taken, places = [around(*point, 8, 8) for point in points], []
    rest = [around(*point, 4, 4) for point in others] + lines
    for i, point in enumerate(points):
        tries = []
        for reach in REACHES:
            for turn, angle in enumerate(ANGLES):
                x, y = point[0] + reach * math.cos(angle), point[1] + reach * math.sin(angle)
                at = around(x, y, 3 + 4 * len(str(i + 1)), 7)
                outside = at[0] < area[0] or at[1] < area[1] or at[2] > area[2] or at[3] > area[3]
                never = outside + sum(meet(at, other) for other in taken)
                tries.append((never, reach + IN_THE_WAY * sum(meet(at, other) for other in rest), turn, x, y, at))
        *_, x, y, at = min(tries)
        taken.append(at)
        places.append((x, y))
    return places
