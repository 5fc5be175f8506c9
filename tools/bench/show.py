#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the cases of a bench's JSON as a table, and beside them the ratios of the newest baseline."""
import json
import pathlib
import sys

# What a line of the table of bench mesh shows of each mesh: title, the case's last words, which number, format.
MESH_COLUMNS = [
    ("triangles", "triangles", "value", ",.0f"),
    ("CPU s", "processor time", "value", ".3f"),
    ("OpenVDB", "processor time", "peer", ".3f"),
    ("ratio", "processor time", "ratio", ".2f"),
    ("before", "processor time", "before", ".2f"),
    ("error vx", "largest error", "value", ".1e"),
    ("OpenVDB", "largest error", "peer", ".1e"),
    ("peak MB", "peak memory", "value", ".1f"),
    ("OpenVDB", "peak memory", "peer", ".1f"),
    ("grid MB", "finished grid", "value", ".1f"),
]


def ratios(path):
    """(case, peer) -> ratio; a file of the library's bench."""
    cases = json.loads(pathlib.Path(path).read_text())["cases"]
    return {(case["name"], case["peer"]["name"]): case["ratio"] for case in cases if "peer" in case}


def number(case, which, before):
    """The case's own number, the peer's, their ratio or the ratio of the baseline; None where there is none."""
    if which in ("value", "ratio"):
        return case.get(which)
    peer = case.get("peer")
    if peer is None:
        return None
    return peer["value"] if which == "peer" else before.get((case["name"], peer["name"]))


def show_meshes(cases, before):
    """A line a mesh."""
    meshes = {}
    for case in cases:
        mesh, what = case["name"].rsplit(", ", 1)
        meshes.setdefault(mesh, {})[what] = case
    columns = [column for column in MESH_COLUMNS if before or column[2] != "before"]
    rows = [["mesh"] + [column[0] for column in columns]]
    for mesh, figures in meshes.items():
        values = [number(figures.get(what, {}), which, before) for _, what, which, _ in columns]
        rows.append([mesh] + ["-" if v is None else format(v, c[3]) for v, c in zip(values, columns)])
    widths = [max(map(len, column)) for column in zip(*rows)]
    for row in rows:
        print("  ".join([row[0].ljust(widths[0])] + [text.rjust(w) for text, w in zip(row[1:], widths[1:])]))


def show_cases(cases, before):
    """A line a case and a line a peer; of bench trade those that nothing beats."""
    name = None
    for case in cases:
        if case.get("pareto") is False:
            continue
        if case["name"] != name:
            name = case["name"]
            print(f"{name}: {case['value']:.4g} {case['unit']}")
        if "peer" not in case:
            continue
        peer = case["peer"]
        old = before.get((name, peer["name"]))
        beside = f" [{old:.3g}]" if old else ""
        print(f"    {peer['name']}: {peer['value']:.4g}, ratio {case['ratio']:.3g}{beside}")


def main(path):
    run = json.loads(pathlib.Path(path).read_text())
    print(run["machine"])
    kind = pathlib.Path(path).stem.removeprefix("bench-")
    baselines = sorted(pathlib.Path(__file__).parent.glob(f"baselines/{kind}-*.json"))
    before = ratios(baselines[-1]) if baselines else {}
    if kind == "mesh":
        if baselines:
            print("ratio before: " + baselines[-1].name)
        show_meshes(run["cases"], before)
        return
    if baselines:
        print("ratios in brackets: " + baselines[-1].name)
    show_cases(run["cases"], before)


main(sys.argv[1])
