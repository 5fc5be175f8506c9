// SPDX-License-Identifier: Apache-2.0
// From the run and the address to what is seen, anew at every change.

function groupsOf(cases) {
  const byName = new Map();
  for (const one of cases) {
    const name = one.group || "all cases";
    if (!byName.has(name)) byName.set(name, []);
    byName.get(name).push(one);
  }
  return [...byName].map(([name, all]) => ({
    name,
    cases: all,
    varying: varyingSettings(all),
    costs: costMeasures(all),
    errors: errorMeasures(all),
  }));
}

function viewOf(group, state) {
  const x = group.costs.find((each) => each.key === state.x);
  const y = group.errors.find((each) => each.key === state.y);
  const kept = group.cases.filter((one) => isKept(one, state.kept));
  const points = kept
    .map((one) => ({ case: one, x: x.read(one), y: y.read(one), spread: (one.spread || {}).ns_per_particle_step }))
    .filter((point) => point.x !== null && point.y !== null);
  const xAxis = logAxis(points.map((point) => point.x));
  const yAxis = logAxis(points.map((point) => point.y));
  for (const point of points) Object.assign(point, { px: xAxis.place(point.x), py: yAxis.place(point.y) });
  // What the filters leave only one of needs no telling at each point.
  const telling = varyingSettings(points.map((point) => point.case));
  const words = (one) => telling.map((key) => settingWords(key, one.settings[key])).filter((text) => text !== "none");
  const labelOf = (point) => words(point.case).join(" · ");
  const labelKey = telling.map(settingName).join(" · ");
  return { ...group, x, y, points, xAxis, yAxis, labelOf, labelKey, optimal: markOptimal(points),
           lacking: kept.length - points.length };
}

function summaryText(view) {
  const { points, optimal, cases, lacking } = view;
  const shown = points.length === cases.length ? `All ${cases.length} cases are shown` :
    `${points.length} of ${cases.length} cases are shown`;
  const without = lacking === 0 ? "" : ` (${lacking} have no value on one of the axes)`;
  if (points.length === 0) return `${shown}${without}; widen the filters.`;
  return `${shown}${without}; ${optimal.length} ${optimal.length === 1 ? "is" : "are"} Pareto-optimal.`;
}

function start(run) {
  document.getElementById("machine").textContent = run.machine || "";
  const groups = groupsOf(run.cases || []).filter((group) => group.costs.length > 0 && group.errors.length > 0);
  const summary = document.getElementById("summary");
  const labelKey = document.getElementById("label-key");
  const tip = document.getElementById("tip");
  const root = document.documentElement.dataset;
  root.pointsShown = root.pointsTotal = root.pointsOptimal = 0;
  if (groups.length === 0) {
    summary.textContent = "The run holds no case with a cost and an error.";
    return;
  }
  let view = null;
  let shown = null;
  const chart = new Chart(document.getElementById("chart"), (point, place) => showTip(tip, point, place, view));
  const change = (changes) => {
    history.replaceState(null, "", hashFromState({ ...stateFromHash(location.hash), ...changes }));
    show();
  };
  const show = () => {
    const asked = stateFromHash(location.hash);
    const state = completeState(asked, groups);
    const group = groups.find((each) => each.name === state.group);
    // Another order of the table is no reason to forget what the reader has enlarged.
    const wanted = hashFromState({ ...state, sort: null });
    if (wanted !== shown) {
      view = viewOf(group, state);
      showControls(groups, group, state, change);
      summary.textContent = summaryText(view);
      labelKey.textContent = view.labelKey ? `Labels: ${view.labelKey}.` : "";
      showTip(tip, null, null, view);
      chart.show(view);
    }
    shown = wanted;
    view.sort = state.sort;
    showTable(document.getElementById("table"), view, change, (point) => chart.mark(point));
    Object.assign(root, { pointsShown: view.points.length, pointsTotal: group.cases.length,
                          pointsOptimal: view.optimal.length });
  };
  addEventListener("hashchange", show);
  show();
}

// Tests and the curious find here whether the page works. Nothing else would tell of an error on a page from disk.
document.documentElement.dataset.errors = 0;
addEventListener("error", () => ++document.documentElement.dataset.errors, true);
start(JSON.parse(document.getElementById("run").textContent));
