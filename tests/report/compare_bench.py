#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/bench/compare.py on runs of a few cases: it names what got slower or less exact, and only that.
usage: compare_bench.py SOURCE_FOLDER WORK_FOLDER"""
import json
import pathlib
import subprocess
import sys


def peer_case(number, ratio, unit="ns/point"):
    return {"name": f"case {number}", "unit": unit, "value": 10.0, "peer": {"name": "theirs", "value": 10.0 * ratio},
            "ratio": ratio}


def trade_case(lookup, value, error):
    settings = {"voxel": 0.1, "lookup": lookup, "normal": "central", "storage": "float", "scheme": None, "sweep": None,
                "dt": None}
    return {"name": f"ball, {lookup}", "unit": "ns", "value": value, "group": "ball", "settings": settings,
            "error": {"phi_p99": error}, "pareto": True}


def run_of(changes=(), trilinear=20.0, cubic=40.0, error=1e-3):
    """Ratios that wander by some hundredths, but for those that are changed."""
    wander = [1.0 + 0.02 * ((7 * i) % 5 - 2) for i in range(20)]
    cases = [peer_case(i, 3.0 * wander[(i + len(changes)) % 20] * dict(changes).get(i, 1.0)) for i in range(20)]
    memory = peer_case(99, 0.1 if changes else 3.0, "MB")
    return {"cases": cases + [memory, trade_case("trilinear", trilinear, 1e-2), trade_case("cubic", cubic, error)]}


def compare(program, folder, run, before):
    paths = [folder / "bench-all.json", folder / "before.json"]
    for path, content in zip(paths, (run, before)):
        path.write_text(json.dumps(content))
    done = subprocess.run([sys.executable, program, *paths], capture_output=True, text=True, timeout=60, check=True)
    return [line.strip() for line in done.stdout.splitlines() if line.startswith("  ")]


def main(source, work):
    program = pathlib.Path(source) / "tools/bench/compare.py"
    folder = pathlib.Path(work)
    folder.mkdir(parents=True, exist_ok=True)
    before = run_of()
    same = compare(program, folder, run_of([(40, 1.0)]), before)
    assert same[-1] == "nothing got slower beyond the noise" and len(same) == 2, same
    # As slow on a machine that is twice as slow.
    assert compare(program, folder, run_of(trilinear=40.0, cubic=80.0), before)[-1] == same[-1]
    slow = compare(program, folder, run_of([(3, 0.6), (11, 1.5)]), before)
    assert [line.split(":")[1].strip() for line in slow if line.startswith("slower")] == ["case 3"], slow
    cubic = compare(program, folder, run_of(cubic=80.0), before)
    assert "ball, cubic" in cubic[1] and "the usual choice" in cubic[1] and len(cubic) == 2, cubic
    wrong = compare(program, folder, run_of(error=2e-3), before)
    assert wrong[-1].startswith("less exact: ball, cubic: phi_p99 0.002, before 0.001"), wrong
    usual = compare(program, folder, run_of(trilinear=40.0), {"cases": run_of()["cases"][-2:]})
    assert usual[1].startswith("nearly all ratios changed"), usual
    none = compare(program, folder, {"cases": []}, before)
    assert none[0] == "nothing to compare: no case is in both" and none[1] == "gone: ball, cubic", none
    assert none[-1] == "gone: 13 more", none


main(*sys.argv[1:])
