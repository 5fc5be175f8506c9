#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/bench/draw_trade.py on a run of a few cases: what the pictures hold, and that bad input leaves nothing behind.
usage: draw_trade.py SOURCE_FOLDER WORK_FOLDER"""
import copy
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

SVG = "{http://www.w3.org/2000/svg}"


def case(group, cost, error, pareto, **settings):
    """As bench trade writes them, as far as it matters."""
    key = "place_of_impact_vx" if "steps" in group else "phi_p99"
    costs = {"ns_per_particle_step": cost}
    settings = {"voxel": 0.1, "lookup": "trilinear", "normal": "central", "storage": "float", "scheme": None,
                "sweep": None, "dt": None, **settings}
    if settings["dt"]:
        costs["us_per_particle_second"] = 1e-3 * cost / settings["dt"]
    return {"name": ", ".join(map(str, [group, *settings.values()])), "unit": "ns", "value": cost, "group": group,
            "settings": settings, "cost": costs, "error": {key: error, "another": 7.0},
            "pareto": pareto}


# 3 close together, whose numbers must not lie on each other; one without error; one that is beaten.
LOOKUPS = [case("a <ball> & a box, lookups", cost, error, pareto, lookup=lookup) for cost, error, pareto, lookup in (
    (5.0, 0.02, True, "nearest"), (5.01, 0.0199, True, "nearest"), (5.02, 0.01985, True, "trilinear"),
    (200.0, 0.0, True, "cubic"), (90.0, 0.3, False, "trilinear"))]
STEPS = [case("shots, steps", 70.0, 1e-6, True, scheme="once", sweep="always", dt=0.00125),
         case("shots, steps", 40.0, 12.0, True, scheme="once", sweep="never", dt=0.02),
         case("shots, steps", 41.0, None, True, scheme="once", sweep="never", dt=0.005)]
RUN = {"machine": "A processor & more", "command": "vdbounce bench trade --dim 8", "cases": LOOKUPS + STEPS}
NAMES = ["trade-a-ball-a-box-lookups.svg", "trade-shots-steps.svg"]


def draw(program, run, folder):
    """Of a run, or of a file's text; returns how it ended."""
    source = folder.parent / "run.json"
    source.write_text(run if isinstance(run, str) else json.dumps(run))
    return subprocess.run([sys.executable, program, source, folder], capture_output=True, text=True, timeout=60)


def texts(picture):
    return [element.text for element in picture.iter(SVG + "text")]


def check_picture(path, cases, best):
    data = path.read_text(encoding="utf-8")
    assert len(data) < 60000 and "href" not in data and "<script" not in data and data.count("http") == 1, path
    picture = ElementTree.fromstring(data)
    marks = [element for element in picture.iter() if element.get("class") == "case"]
    assert len(marks) == cases, (path, len(marks))
    assert sum(mark.get("stroke") == "#fff" for mark in marks) == best, "those that nothing beats are coloured"
    numbers = [element for element in picture.iter(SVG + "text") if element.get("class") == "number"]
    assert [element.text for element in numbers] == [str(i + 1) for i in range(best)]
    places = [(float(element.get("x")), float(element.get("y"))) for element in numbers]
    for i, a in enumerate(places):
        assert all(abs(a[0] - b[0]) >= 13.9 or abs(a[1] - b[1]) >= 13.9 for b in places[:i]), ("numbers overlap", places)
    for element in picture.iter(SVG + "text"):
        assert 0 < float(element.get("x")) < 800 and 0 < float(element.get("y")) < float(picture.get("height"))
    assert RUN["machine"] in texts(picture) and RUN["command"] in texts(picture)
    return picture


def check_pictures(program, folder):
    result = draw(program, RUN, folder)
    assert result.returncode == 0 and result.stdout + result.stderr == "", result
    assert sorted(os.listdir(folder)) == NAMES, os.listdir(folder)

    lookups = check_picture(folder / NAMES[0], 5, 4)
    words = texts(lookups)
    assert "a <ball> & a box, lookups: error over cost" in words and {"0", "0.1", "10", "100"} <= set(words)
    assert "cubic" in words and "lookup" in words and "voxel" not in words, "only what differs has a column"
    assert "distance error, 99th percentile (world units)" in words
    floor = max(float(re.search(r"V([\d.]+)", path.get("d")).group(1)) for path in lookups.iter(SVG + "path")
                if "V" in path.get("d"))
    exact = [mark for mark in lookups.iter(SVG + "polygon") if "".join(mark.itertext()).endswith(" error 0")]
    heights = [float(point.split(",")[1]) for point in exact[0].get("points").split()]
    assert len(exact) == 1 and abs((min(heights) + max(heights)) / 2 - floor) < 0.2, "no error: on the lower edge"

    steps = texts(check_picture(folder / NAMES[1], 2, 2))
    assert {"error of the place of impact (voxels)", "always", "Not drawn, for want of this error: 1."} <= set(steps)

    before = [(folder / name).read_bytes() for name in NAMES]
    assert draw(program, RUN, folder).returncode == 0
    assert before == [(folder / name).read_bytes() for name in NAMES], "the same run, the same bytes"


def check_failure(result, code, folder):
    assert result.returncode == code, result
    assert len(result.stderr.splitlines()) == 1 and result.stderr.startswith("draw_trade.py: "), result.stderr
    assert not folder.exists(), "something was left behind"


def without(key):
    """The run, lacking a part of its last case."""
    run = copy.deepcopy(RUN)
    del run["cases"][-1][key]
    return run


def check_bad_input(program, folder):
    free = case("sphere, lookups", 0.0, 0.1, True)
    wordless = case("sphere, lookups", 5.0, "much", True)
    hollow = case("sphere, lookups", 5.0, None, True)
    twin = case("shots; steps", 5.0, 0.1, True)
    costless = {**case("sphere, lookups", 5.0, 0.1, True), "cost": {"bytes": 3}}
    bad = ["", "{", "[]", "7", '{"cases": 3}', '{"cases": [3]}', {**RUN, "cases": []}, {"cases": LOOKUPS},
           *({**RUN, "cases": LOOKUPS + [one]} for one in (free, wordless, hollow)), {**RUN, "cases": STEPS + [twin]},
           *map(without, ("name", "group", "settings", "cost", "error", "pareto")), {**RUN, "cases": [costless]},
           {"machine": "m", "command": "c", "cases": [{"name": "union", "value": 3.0, "unit": "ms"}]}]
    for run in bad:
        check_failure(draw(program, run, folder), 3, folder)
    for arguments, code in (([], 2), ([folder.parent / "run.json"], 2), ([folder.parent / "none.json", folder], 3)):
        check_failure(subprocess.run([sys.executable, program, *arguments], capture_output=True, text=True), code, folder)
    # A folder that is a file.
    folder.write_text("kept")
    result = draw(program, RUN, folder)
    assert result.returncode == 1 and len(result.stderr.splitlines()) == 1, result
    assert folder.read_text() == "kept"


def main():
    program, folder = pathlib.Path(sys.argv[1]) / "tools/bench/draw_trade.py", pathlib.Path(sys.argv[2]).absolute()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    check_pictures(program, folder / "pictures")
    check_bad_input(program, folder / "nothing")
    assert sorted(os.listdir(folder)) == ["nothing", "pictures", "run.json"], os.listdir(folder)


main()
