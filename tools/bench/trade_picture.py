# SPDX-License-Identifier: Apache-2.0
"""The picture of a group of bench trade: error over cost as an SVG, 800 pixels wide, and a table of the best below it."""
import html
import math
import re
import textwrap

import number_places

WIDTH, LEFT, RIGHT, HEIGHT, ZERO_STRIP, ROW = 800, 74, 784, 380, 34, 21  # pixels; HEIGHT is that of the plot
INK, MUTED, LINE, GRID, GREY, GREY_EDGE = "#17202b", "#56606d", "#c3cad3", "#eceff3", "#aab3bf", "#8b95a3"
WORTHWHILE = .01  # how much smaller an error must be to be worth a look
# The setting that markers tell: by colours that differ for colour-blind readers too, and by shapes about (0, 0).
KINDS = {"lookup": ["nearest", "trilinear", "cubic"], "sweep": ["never", "auto", "always"]}
COLOURS = ("#d55e00", "#0072b2", "#007f5f", "#a0508a")
CIRCLE = ()
SHAPES = (((-.88, -.88), (.88, -.88), (.88, .88), (-.88, .88)), CIRCLE, ((0, -1.3), (1.3, 0), (0, 1.3), (-1.3, 0)),
          ((0, -1.2), (1.2, .9), (-1.2, .9)))
ERRORS = {"phi_p99": "distance error, 99th percentile", "place_of_impact_vx": "error of the place of impact",
          "sliding_distance_relative": "error of the sliding distance"}
UNITS = {"vx": "voxels", "s": "seconds", "deg": "degrees", "p99": "world units"}


def plain(value):
    """A number in few characters."""
    return f"{value:.0f}" if abs(value) >= 1000 else re.sub(r"e([+-])0", r"e\1", f"{value:.3g}").replace("e+", "e")


def px(value):
    return f"{value:.1f}".removesuffix(".0")


def escaped(words):
    return html.escape("".join(c for c in words if c.isprintable()), quote=False)


def text(x, y, words, size=12, more=""):
    return f'<text x="{px(x)}" y="{px(y)}" font-size="{size}" {more}>{escaped(words)}</text>'


def path(way, colour, more=""):
    return f'<path d="{way}" fill="none" stroke="{colour}" {more}/>'


def marker(x, y, kind, best, case=None):
    """In the kind's shape, in its colour if nothing beats it; a case's says what it is when pointed at."""
    radius = 6 if best else 4
    look = f'fill="{COLOURS[kind]}" stroke="#fff"' if best else f'fill="{GREY}" fill-opacity=".45" stroke="{GREY_EDGE}"'
    inside = ""
    if case:
        look += ' class="case"'
        inside = f"<title>{escaped(case['name'])}: {plain(case['cost'])} {case['unit']}, error {plain(case['error'])}</title>"
    if SHAPES[kind] == CIRCLE:
        return f'<circle cx="{px(x)}" cy="{px(y)}" r="{radius}" {look}>{inside}</circle>'
    points = " ".join(f"{px(x + radius * a)},{px(y + radius * b)}" for a, b in SHAPES[kind])
    return f'<polygon points="{points}" {look}>{inside}</polygon>'


def span(values):
    """Where a log axis goes from and to, in powers of ten: at least a decade, so that it has ticks."""
    low, high = (math.log10(f(values)) for f in (min, max)) if values else (-1, -1)
    margin = max(.06 * (high - low), (1.05 - (high - low)) / 2)
    return low - margin, high + margin


def ticks(low, high):
    """(power of ten, words, is it a decade): decades, and 2 and 5 times them where there are few."""
    for power in range(math.floor(low), math.ceil(high) + 1):
        for digit in (1, 2, 5) if high - low < 2.6 else (1,):
            if low <= power + math.log10(digit) <= high:
                yield power + math.log10(digit), plain(digit * 10.0**power), digit == 1


def draw_header(group, origin, kinds, axis):
    """The title, how to repeat the run, the shapes by name, and the error; and where they end."""
    lines = [(line, 18, f'font-weight="600" fill="{INK}"') for line in textwrap.wrap(f"{group}: error over cost", 58)]
    for words in origin:
        lines += [(line, 12, f'fill="{MUTED}"') for line in textwrap.wrap(words, 100)]
    parts, x, y = [], 22, 12
    for words, size, more in lines:
        y += size + 5
        parts.append(text(16, y, words, size, more))
    muted = f'fill="{MUTED}" text-anchor="end"'
    for kind, name in enumerate(kinds):
        parts += [marker(x, y + 25, kind, True), marker(x + 15, y + 25, kind, False), text(x + 26, y + 29, name, 12.5)]
        x += 54 + 7 * len(name)
    parts += [text(RIGHT, y + 29, "coloured: nothing beats it in cost and error; grey: beaten", 12, muted),
              text(16, y + 62, axis, 13, 'font-weight="600"'),
              text(RIGHT, y + 62, "↙ better: cheaper and more exact", 12, muted)]
    return parts, y + 72


def draw_axes(cases, top, axis):
    """The grid and its labels; tells the cases their pixels."""
    bottom = top + HEIGHT
    floor = bottom - (ZERO_STRIP if any(c["error"] == 0 for c in cases) else 0)
    (x0, x1), (y0, y1) = span([c["cost"] for c in cases]), span([c["error"] for c in cases if c["error"]])
    at_x = lambda power: LEFT + (RIGHT - LEFT) * (power - x0) / (x1 - x0)
    at_y = lambda power: floor - (floor - top) * (power - y0) / (y1 - y0)
    for c in cases:
        c["x"], c["y"] = at_x(math.log10(c["cost"])), at_y(math.log10(c["error"])) if c["error"] else bottom
    parts, right = [], 'text-anchor="end"'
    for power, words, decade in ticks(x0, x1):
        parts += [path(f"M{px(at_x(power))} {px(top)}V{px(bottom)}", LINE if decade else GRID),
                  text(at_x(power), bottom + 18, words, 12, 'text-anchor="middle"')]
    for power, words, decade in ticks(y0, y1) if any(c["error"] for c in cases) else ():
        parts += [path(f"M{LEFT} {px(at_y(power))}H{RIGHT}", LINE if decade else GRID),
                  text(LEFT - 8, at_y(power) + 4, words, 12, right)]
    if floor < bottom:
        parts += [text(LEFT - 8, bottom + 4, "0", 12, right + ' font-weight="700"'),
                  path(f"M{LEFT} {px(floor)}H{RIGHT}", MUTED, 'stroke-dasharray="2 4"'),
                  text(RIGHT - 6, floor + 15, "on the lower edge: no error at all", 12, f'{right} fill="{MUTED}"')]
    return parts + [path(f"M{LEFT} {px(top)}V{px(bottom)}H{RIGHT}", INK),
                    text((LEFT + RIGHT) / 2, bottom + 38, axis, 13, 'text-anchor="middle" font-weight="600"')]


def draw_cases(best, others, area):
    """The markers, the best joined by the least error that a cost can buy, and numbered."""
    at = lambda c: (c["x"], c["y"])
    parts = [marker(*at(c), c["kind"], False, c) for c in others]
    way, lines, y = "", [], area[1]
    for case, after in zip(best, [c["x"] for c in best[1:]] + [area[2]]):
        way += f"V{px(case['y'])}H{px(after)}"
        lines += [(case["x"] - 1, y, case["x"] + 1, case["y"]), (case["x"], case["y"] - 1, after, case["y"] + 1)]
        y = case["y"]
    if best:
        parts.append(path(f"M{px(best[0]['x'])} {px(area[1])}{way}", MUTED, 'stroke-width="1.5"'))
    places = number_places.find([at(c) for c in best], [at(c) for c in others], lines, area)
    parts += [path(f"M{px(c['x'])} {px(c['y'])}L{px(x)} {px(y)}", MUTED) for c, (x, y) in zip(best, places)
              if math.dist((x, y), at(c)) > number_places.NEAREST + 1]
    parts += [marker(*at(c), c["kind"], True, c) for c in best]
    look = 'class="number" text-anchor="middle" font-weight="700" stroke="#fff" stroke-width="3.5" paint-order="stroke"'
    return parts + [text(x, y + 4.5, str(i + 1), 13, look) for i, (x, y) in enumerate(places)]


def hardly_better(best):
    """Of each, the cheapest first: is it next to no more exact than one before it?"""
    flags, least = [], math.inf
    for c in best:
        flags.append(c["error"] > (1 - WORTHWHILE) * least)
        least = least if flags[-1] else c["error"]
    return flags


def draw_table(cases, best, missing, y):
    """What the numbers stand for, in the settings that differ within the group; and where it ends."""
    words = lambda value: "-" if value is None else f"{value:g}" if isinstance(value, (int, float)) else str(value)
    keys = [k for k in cases[0]["settings"] if len({words(c["settings"].get(k)) for c in cases}) > 1]
    rows = [[cases[0]["unit"], "error"] + ["dt (s)" if key == "dt" else key for key in keys]]
    rows += [[plain(c["cost"]), plain(c["error"])] + [words(c["settings"].get(key)) for key in keys] for c in best]
    faint = [True] + hardly_better(best)
    widths = [7.3 * max(map(len, column)) for column in zip(*rows)]
    gap = min(26, (RIGHT - 66 - sum(widths)) / len(widths))
    parts = [text(16, y, "What nothing beats, the cheapest first", 13, 'font-weight="600"')]
    for i, row in enumerate(rows):
        y, x, look = y + ROW, 66, f'fill="{MUTED}"' if faint[i] else ""
        if i:
            parts += [path(f"M16 {px(y - 15)}H{RIGHT}", GRID), marker(48, y - 4.5, best[i - 1]["kind"], True),
                      text(32, y, str(i), 13, f'text-anchor="end" font-weight="700" {look}')]
        for cell, width in zip(row, widths):
            parts.append(text(x, y, cell, 12.5 if i else 12, look))
            x += width + gap
    notes = [f"Grey rows: not even {WORTHWHILE:.0%} more exact than a cheaper row."] if any(faint[1:]) else []
    notes += [f"Not drawn, for want of this error: {missing}."] if missing else []
    if notes:
        y += ROW + 4
        parts.append(text(16, y, " ".join(notes), 12, f'fill="{MUTED}"'))
    return parts, y + 14


def draw(group, origin, cases, missing):
    """The SVG of `cases` (name, settings, best, cost, key, error); `missing` others have no such error."""
    told = "sweep" if any(c["settings"].get("sweep") for c in cases) else "lookup"
    kind_of = lambda c: str(c["settings"].get(told))
    kinds = (KINDS[told] + sorted({kind_of(c) for c in cases} - set(KINDS[told])))[:len(SHAPES)]
    for c in cases:
        c["kind"] = kinds.index(kind_of(c)) if kind_of(c) in kinds else len(kinds) - 1
    best = sorted((c for c in cases if c["best"]), key=lambda c: (c["cost"], -c["error"], c["name"]))
    key = cases[0]["key"]
    error = f"{ERRORS.get(key, key.replace('_', ' '))} ({UNITS.get(key.rpartition('_')[2], 'relative')})"
    cost = "ns for a lookup" if cases[0]["unit"] == "ns" else "µs for a particle and second of the scene"
    parts, top = draw_header(group, origin, kinds, error)
    parts += draw_axes(cases, top, cost)
    parts += draw_cases(best, [c for c in cases if not c["best"]], (LEFT, top, RIGHT, top + HEIGHT))
    table, height = draw_table(cases, best, missing, top + HEIGHT + 72)
    size = f'width="{WIDTH}" height="{px(height)}"'
    head = [f'<svg xmlns="http://www.w3.org/2000/svg" {size} viewBox="0 0 {WIDTH} {px(height)}" '
            f'font-family="system-ui, sans-serif" fill="{INK}">', f'<rect {size} fill="#fff"/>']
    return "\n".join(head + parts + table + ["</svg>\n"])
