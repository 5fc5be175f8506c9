#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the cases of a bench's JSON as a table, and beside them the ratios of the newest baseline."""
import json
import pathlib
import sys


def ratios(path):
    """(case, peer) -> ratio; a file of the library's bench."""
    cases = json.loads(pathlib.Path(path).read_text())["cases"]
    return {(case["name"], case["peer"]["name"]): case["ratio"] for case in cases if "peer" in case}


def main(path):
    run = json.loads(pathlib.Path(path).read_text())
    print(run["machine"])
    kind = pathlib.Path(path).stem.removeprefix("bench-")
    baselines = sorted(pathlib.Path(__file__).parent.glob(f"baselines/{kind}-*.json"))
    before = ratios(baselines[-1]) if baselines else {}
    if baselines:
        print("ratios in brackets: " + baselines[-1].name)
    name = None
    for case in run["cases"]:
        if case["name"] != name:
            name = case["name"]
            print(f"{name}: {case['value']:.4g} {case['unit']}")
        if "peer" not in case:
            continue
        peer = case["peer"]
        old = before.get((name, peer["name"]))
        beside = f" [{old:.3g}]" if old else ""
        print(f"    {peer['name']}: {peer['value']:.4g}, ratio {case['ratio']:.3g}{beside}")


main(sys.argv[1])
