#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Says what got slower, or less exact, since the newest baseline: compare.py RUN.json [BASELINE.json]

Times are compared as ratios to what was measured in the same run: the peer's where there is one, else the usual choice's
of the same group, voxel and time step in bench trade. Noise is told from all ratios together: most cases did not change."""
import json
import math
import pathlib
import statistics
import sys

USUAL = {"lookup": "trilinear", "normal": "central", "storage": "float"}
USUAL_STEP = {"scheme": "collide-contact", "sweep": "auto"}

# A change must be beyond so many standard deviations, and these are taken for no less than a share of the ratio.
DEVIATIONS = 4.0
LEAST_NOISE = 0.04
FEWEST_KIN = 8  # of which a common change is told from one's own

# Errors do not depend on the machine but for the last digits; other repetitions have other points.
SAME_ERROR = 1e-3


def usual_of(cases, case):
    """The case that another of bench trade is compared with."""
    own = case["settings"]
    wanted = dict(USUAL, **(USUAL_STEP if own["scheme"] else {}))
    for other in cases:
        settings = other.get("settings")
        if settings is None or other["group"] != case["group"]:
            continue
        same = settings["voxel"] == own["voxel"] and (own["dt"] is None or settings["dt"] == own["dt"])
        if same and all(settings[key] == value for key, value in wanted.items()):
            return other
    return None


def ratios(cases):
    """(case, what it is compared with) -> how many times as long that takes."""
    found = {}
    for case in cases:
        if "peer" in case and case["value"] > 0:
            found[case["name"], case["peer"]["name"]] = case["ratio"]
        elif "settings" in case:
            usual = usual_of(cases, case)
            if usual is not None and usual is not case:
                found[case["name"], "the usual choice"] = usual["value"] / case["value"]
    return found


def times_only(cases):
    """Cases whose smaller values are faster."""
    return [case for case in cases if case.get("unit", "").split("/")[0] in ("s", "ns", "ms", "us")]


def noise_of(changes):
    """Of logarithms: a robust standard deviation."""
    middle = statistics.median(changes)
    return max(LEAST_NOISE, 1.4826 * statistics.median(abs(change - middle) for change in changes))


def kin_of(cases):
    """Case of bench trade -> what it shares with those that are compared with the same usual choice."""
    return {case["name"]: (case["group"], case["settings"]["voxel"], case["settings"]["dt"])
            for case in cases if "settings" in case}


def without_common(changes, kin):
    """Changes less that of all who share their usual choice, which one slow measurement of it makes; and their noise."""
    groups = {}
    for key, change in changes.items():
        groups.setdefault(kin.get(key[0]), []).append(change)
    common = {name: (statistics.median(group), noise_of(group)) for name, group in groups.items()
              if name is not None and len(group) >= FEWEST_KIN}
    return {key: (change - common.get(kin.get(key[0]), (0.0, 0.0))[0], common.get(kin.get(key[0]), (0.0, 0.0))[1])
            for key, change in changes.items()}


def slower(run, before):
    """Lines on cases that fell behind what they are compared with, and on how many were compared."""
    now, then = ratios(times_only(run)), ratios(times_only(before))
    changes = {key: math.log(now[key] / then[key]) for key in now if key in then and now[key] > 0 and then[key] > 0}
    if not changes:
        return ["nothing to compare: no case is in both"]
    noise = noise_of(list(changes.values()))
    middle = statistics.median(changes.values())
    lines = [f"compared {len(changes)} ratios, {math.exp(middle):.3f} of before in the middle, noise {100 * noise:.0f} %"]
    if abs(middle) > DEVIATIONS * noise:
        lines.append("nearly all ratios changed: what they are compared with did, the peers or the usual choice")
    own = without_common(changes, kin_of(run))
    worst = sorted((change, key) for key, (change, spread) in own.items() if change < -DEVIATIONS * max(noise, spread))
    for _, (name, peer) in worst:
        lines.append(f"slower: {name}: {now[name, peer]:.3g} times {peer}, before {then[name, peer]:.3g}")
    return lines + ([] if worst else ["nothing got slower beyond the noise"])


def less_exact(run, before):
    """Lines on errors of bench trade that grew."""
    then = {case["name"]: case["error"] for case in before if "error" in case}
    lines = []
    for case in run:
        for key, error in case.get("error", {}).items():
            old = then.get(case["name"], {}).get(key)
            if None not in (old, error) and abs(error) > abs(old) * (1 + SAME_ERROR) + 1e-9:
                lines.append(f"less exact: {case['name']}: {key} {error:.3g}, before {old:.3g}")
    return lines


def gone(run, before):
    """Lines on what the baseline has and the run has not."""
    names = {case["name"] for case in run}
    missing = sorted({case["name"] for case in before} - names)
    return [f"gone: {name}" for name in missing[:10]] + ([f"gone: {len(missing) - 10} more"] if len(missing) > 10 else [])


def newest_baseline(path):
    kind = pathlib.Path(path).stem.removeprefix("bench-")
    found = sorted(pathlib.Path(__file__).parent.glob(f"baselines/{kind}-*.json"))
    return found[-1] if found else None


def main(path, baseline=None):
    baseline = baseline or newest_baseline(path)
    if baseline is None:
        print("no baseline to compare with")
        return
    runs = [json.loads(pathlib.Path(each).read_text()) for each in (path, baseline)]
    run, before = (each["cases"] for each in runs)
    same = runs[0].get("command") == runs[1].get("command")
    exactness = less_exact(run, before) if same else ["errors are not compared: another command, with other points"]
    print(f"against {pathlib.Path(baseline).name}:")
    for line in slower(run, before) + exactness + gone(run, before):
        print("  " + line)


main(*sys.argv[1:])
