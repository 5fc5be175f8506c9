#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Opens the report page from disk in a headless Chromium that reaches no network, and looks at what it then holds.
Skipped (77) where there is no Chromium.
usage: page.py SAMPLE_PAGE_PROGRAM WORK_FOLDER"""
import json
import os
import re
import shutil
import subprocess
import sys

SKIPPED = 77


def open_page(page, folder, address=""):
    """The document after its scripts have run, and what they complained of."""
    browser = shutil.which("chromium") or sys.exit(SKIPPED)
    run = subprocess.run(
        [browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
         "--host-resolver-rules=MAP * ~NOTFOUND", "--disable-background-networking", f"--user-data-dir={folder}/profile",
         "--enable-logging=stderr", "--virtual-time-budget=3000", "--window-size=1200,900", "--dump-dom",
         f"file://{page}#{address}"],
        capture_output=True, text=True, timeout=120, check=True, env={**os.environ, "HOME": folder})
    complaints = [line for line in run.stderr.splitlines() if "CONSOLE" in line]
    assert not complaints, complaints
    assert attribute(run.stdout, "errors") == 0, "the page counted errors"
    return run.stdout


def attribute(document, name):
    return int(re.search(rf'<html[^>]* data-{name}="(\d+)"', document).group(1))


def optimal(cases, cost, error):
    """By the definition, each against each."""
    points = [(c["cost"][cost], abs(c["error"][error])) for c in cases if c["error"].get(error) is not None]
    beats = lambda a, b: a[0] <= b[0] and a[1] <= b[1] and a != b
    return sum(not any(beats(other, one) for other in points) for one in points), len(points)


def check_view(open_it, address, cases, total, cost, error):
    document = open_it(address)
    best, shown = optimal(cases, cost, error)
    counts = {name: attribute(document, name) for name in ("points-shown", "points-total", "points-optimal")}
    assert counts == {"points-shown": shown, "points-total": total, "points-optimal": best}, (address, counts, shown, best)
    assert document.count("<canvas") == 1
    assert document.count("<tr") == shown + 1, "a row for each case and the head"
    return document


# What a reader does: keep one lookup, sort by memory, go down the table with the keys.
READER = """<script>
[...document.querySelectorAll("#filters button")].find((button) => button.textContent === "cubic").click();
document.querySelector('[data-key="bytes"]').click();
document.querySelector('[data-key="bytes"]').click();
setTimeout(() => {
  document.querySelector("tbody tr").focus();
  document.activeElement.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowDown", bubbles: true }));
}, 100);
document.body.dataset.address = location.hash;
</script></body>"""


def check_reader(page, folder):
    with open(page, encoding="utf-8") as file:
        text = file.read()
    with open(f"{folder}/reader.html", "w", encoding="utf-8") as file:
        file.write(text.replace("</body>", READER))
    document = open_page(f"{folder}/reader.html", folder)
    assert attribute(document, "points-shown") == 30
    assert 'data-address="#sort=-bytes&amp;lookup=cubic"' in document, re.search(r'data-address="[^"]*"', document)
    assert 'aria-sort="descending"' in document
    tip = re.search(r'<div id="tip"[^>]*>.*?</div></dl></div>', document).group(0)
    for words in ("<dt>lookup</dt><dd>cubic</dd>", "<dt>memory</dt><dd>49.9 MB</dd>", "<dt>normal, largest</dt>"):
        assert words in tip, (words, tip)
    assert "hidden" not in tip.split(">")[0]


def main():
    program, folder = sys.argv[1], os.path.abspath(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    page, run = f"{folder}/report.html", f"{folder}/run.json"
    subprocess.run([program, page, run], check=True)
    open_it = lambda address: open_page(page, folder, address)
    groups = {}
    for case in json.load(open(run, encoding="utf-8"))["cases"]:
        groups.setdefault(case["group"], []).append(case)
    having = lambda name, **wanted: [
        c for c in groups[name] if all(c["settings"].get(key) in values for key, values in wanted.items())]

    # Without an address: the first group, time over distance in world units.
    first = check_view(open_it, "", groups["sphere, lookups"], 90, "ns_per_particle_step", "phi_p99")
    assert "A processor &lt;b&gt;of &amp; many&lt;/b&gt; names" in first
    # Filters, other axes, another group.
    check_view(open_it, "group=torus%2C%20lookups&x=bytes&y=normal_max_deg&lookup=cubic,nearest&voxel=0.1",
               having("torus, lookups", lookup=["cubic", "nearest"], voxel=[0.1]), 90, "bytes", "normal_max_deg")
    # Zeros have their place; what lacks the error has none.
    steps = check_view(open_it, "group=sphere,%20steps&y=penetration_vx", groups["sphere, steps"], 120,
                       "ns_per_particle_step", "penetration_vx")
    assert 'aria-sort="ascending"' in steps
    check_view(open_it, "group=sphere,%20steps&y=sliding_distance_relative&sort=-dt", groups["sphere, steps"], 120,
               "ns_per_particle_step", "sliding_distance_relative")
    # What the run does not have is left out of an address.
    check_view(open_it, "group=cube&x=money&lookup=psychic&100%", groups["sphere, lookups"], 90, "ns_per_particle_step",
               "phi_p99")
    check_reader(page, folder)


main()
