#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws error over cost, of what `vdbounce bench trade --json` wrote: FOLDER/trade-GROUP.svg for each group.
usage: draw_trade.py RUN.json FOLDER"""
import json
import math
import os
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # the source folder stays as it is
import trade_picture

FAILED, USAGE, INPUT = 1, 2, 3  # exit codes, as the tool's


def fail(code, text):
    print("draw_trade.py: " + " ".join(text.split()), file=sys.stderr)
    sys.exit(code)


def read_case(case):
    """What the picture needs of a case; raises ValueError, KeyError and the like where that is not there."""
    # Steps compare by what a second of the scene takes, or short ones would seem cheap.
    steps = "us_per_particle_second" in case["cost"]
    cost = case["cost"]["us_per_particle_second" if steps else "ns_per_particle_step"]
    key, error = next(iter(case["error"].items()))
    settings, best = case["settings"], case["pareto"]
    if not 0 < cost < math.inf or not isinstance(settings, dict) or not isinstance(best, bool):
        raise ValueError("no cost, settings or pareto")
    known = error is not None and math.isfinite(error)  # JSON has null for what is no number
    return {"name": str(case["name"]), "group": str(case["group"]), "settings": settings, "best": best, "cost": cost,
            "unit": "µs" if steps else "ns",
            "key": key, "error": abs(error) if known else None}


def read_run(path):
    """Command and machine, and the cases by group."""
    groups = {}
    try:
        run = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        for case in map(read_case, run["cases"]):
            groups.setdefault(case["group"], []).append(case)
        origin = [str(run["command"]), str(run["machine"])]
    except OSError as error:
        fail(INPUT, f"{path}: cannot be read, {error.strerror}; name the JSON of vdbounce bench trade")
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError):
        fail(INPUT, f"{path}: is not JSON; write it with vdbounce bench trade --json")
    except (ValueError, LookupError, TypeError, AttributeError, StopIteration) as error:
        what = f"it lacks {error}" if isinstance(error, KeyError) else "its values are of other kinds"
        fail(INPUT, f"{path}: is no run of bench trade, {what}; write it with vdbounce bench trade --json")
    if not groups:
        fail(INPUT, f"{path}: has no cases; write it with vdbounce bench trade --json")
    return origin, groups


def draw_all(path):
    """The pictures by their files' names."""
    origin, groups = read_run(path)
    pictures = {}
    for group, cases in groups.items():
        drawn = [c for c in cases if c["error"] is not None and c["key"] == cases[0]["key"]]
        name = "trade-" + re.sub(r"[^a-z0-9]+", "-", group.lower()).strip("-") + ".svg"
        if not drawn:
            fail(INPUT, f"{path}: the group {group!r} has no errors; measure it again with vdbounce bench trade --json")
        if name in pictures:
            fail(INPUT, f"{path}: two groups would be {name}; rename {group!r}")
        pictures[name] = trade_picture.draw(group, origin, drawn, len(cases) - len(drawn))
    return pictures


def write_all(folder, pictures):
    """Each whole or not at all."""
    part = folder / f".trade.svg.part-{os.getpid()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in pictures.items():
            part.write_text(text, encoding="utf-8")
            part.replace(folder / name)
    except OSError as error:
        if folder.is_dir():
            part.unlink(missing_ok=True)
        fail(FAILED, f"{folder}: cannot be written, {error.strerror}; name a folder that can be")


def main(arguments):
    if len(arguments) != 2:
        fail(USAGE, "usage: draw_trade.py RUN.json FOLDER")
    write_all(pathlib.Path(arguments[1]), draw_all(arguments[0]))


main(sys.argv[1:])
