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


def open_with(script, page, folder):
    """The page with a reader who does what the script does."""
    with open(page, encoding="utf-8") as file:
        text = file.read()
    with open(f"{folder}/reader.html", "w", encoding="utf-8") as file:
        file.write(text.replace("</body>", script))
    return open_page(f"{folder}/reader.html", folder)


def check_reader(page, folder):
    document = open_with(READER, page, folder)
    assert attribute(document, "points-shown") == 30
    assert 'data-address="#sort=-bytes&amp;lookup=cubic"' in document, re.search(r'data-address="[^"]*"', document)
    assert 'aria-sort="descending"' in document
    tip = re.search(r'<div id="tip"[^>]*>.*?</div></dl></div>', document).group(0)
    for words in ("<dt>lookup</dt><dd>cubic</dd>", "<dt>memory</dt><dd>49.9 MB</dd>", "<dt>normal, largest</dt>"):
        assert words in tip, (words, tip)
    assert "hidden" not in tip.split(">")[0]


def chart_rows(document):
    """Name, peer, standing and ratio of each row of the chart, and how far right its dot is, per cent."""
    rows, name = [], None
    for row in document.split('<div class="ratio-row ')[2:]:
        standing = row.split('"')[0].split()[0]
        label = re.match(r'[^>]*><div class="ratio-label">(?:<div>(.*?)</div>)?<div class="peer">(.*?)</div>', row)
        name = label.group(1) or name
        place = float(re.search(r'class="dot \w+" style="left: ([\d.]+)%', row).group(1))
        rows.append((name, label.group(2), standing, re.search(r'"ratio-value">(.*?)</div>', row).group(1), place))
    return rows


def check_ratios(open_it, cases, alone):
    group = "group=collisions%20against%20others"
    counts = lambda document: [attribute(document, name) for name in ("points-shown", "points-total", "points-optimal")]
    html = lambda text: text.replace("<", "&lt;").replace(">", "&gt;")
    document = open_it(group)
    compared = [case for case in cases if case.get("ratio") is not None]
    rows = chart_rows(document)
    assert counts(document) == [len(cases), len(cases), 0], counts(document)
    assert [row[:2] for row in rows] == [(case["name"], html(case["peer"]["name"])) for case in compared]
    assert document.count("<tr") == len(cases) + 1 and "<canvas" not in document
    one = float(re.search(r'class="one" style="left: ([\d.]+)%', document).group(1))
    for (_, _, standing, text, place), case in zip(rows, compared):
        ratio = case["ratio"]
        assert standing == ("alike" if abs(ratio - 1) <= 0.01 else "ahead" if ratio > 1 else "behind"), case
        assert (place > one) == (ratio > 1) and 0 < place < 100, (place, one, case)
        assert "·" in text or abs(float(text) / ratio - 1) < 0.006, (text, case)
    # Words, peers, order; in the table too.
    document = open_it(f"{group}&find=nano%20THREADS&sort=-ratio")
    found = [case for case in compared if "threads" in case["name"] and "Nano" in case["peer"]["name"]]
    found.sort(key=lambda case: -case["ratio"])
    assert [row[0] for row in chart_rows(document)] == [case["name"] for case in found]
    assert attribute(document, "points-shown") == len(found) + 1, "what has no ratio is in the table"
    assert 'aria-sort="descending"' in document
    document = open_it(f"{group}&peer=none&standing=none")
    assert chart_rows(document) == [] and counts(document)[0] == 2
    document = open_it(f"{group}&peer=gravity%2C%20%3Cb%3Enothing%3C%2Fb%3E%20else&standing=behind")
    assert [row[0] for row in chart_rows(document)] == ["box 4, 1 thread", "box 4, 2 threads"]
    assert "No case is left" in open_it(f"{group}&find=psychic")
    document = open_it("group=all%20cases%20against%20others")
    assert chart_rows(document) == [] and counts(document) == [alone, alone, 0]
    assert "88 kB" in document and "3670 triangles" in document


# What a reader does: look for a word, keep one peer, sort by name, point at the first row of the chart.
SEEKER = """<script>
location.hash = "#group=collisions%20against%20others";
setTimeout(() => {
  const find = document.getElementById("find");
  find.focus();
  find.value = "box threads";
  find.dispatchEvent(new InputEvent("input", { bubbles: true }));
  document.body.dataset.focus = document.activeElement.id;
  [...document.querySelectorAll("#filters button")].find((button) => button.textContent.startsWith("Nano")).click();
  document.querySelector('[data-key="ratio"]').click();
  document.querySelectorAll(".ratio-row")[1].dispatchEvent(new PointerEvent("pointerenter"));
  document.body.dataset.address = location.hash;
}, 100);
</script></body>"""


def check_seeker(page, folder):
    document = open_with(SEEKER, page, folder)
    assert 'data-focus="find"' in document
    assert "&amp;find=box%20threads&amp;sort=ratio&amp;peer=NanoVDB" in document, re.search(r'data-address="[^"]*"', document)
    ratios = [float(row[3].split("·")[0]) for row in chart_rows(document)]
    assert ratios == [0.05, 0.8, 1, 1.5, 14.2, 200000], ratios
    tip = re.search(r'<div id="tip"[^>]*>.*?</dl></div>', document).group(0)
    for words in ("box 6, 2 threads", "<dd>18 ns/particle step</dd>", "<dd>0.05</dd>", "NanoVDB's example", "behind"):
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
        groups.setdefault(case.get("group", case.get("kind")), []).append(case)
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
    check_ratios(open_it, groups["collide"], len(groups[None]))
    check_seeker(page, folder)


main()
