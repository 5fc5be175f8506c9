// SPDX-License-Identifier: Apache-2.0
// From the run and the address to what is seen, anew at every change.

// What belongs to one kind of group is there only with it.
function showKind(kind) {
  for (const each of document.querySelectorAll("[data-kind]")) each.hidden = each.dataset.kind !== kind;
}

function showWords(view) {
  const write = (id, text) => (document.getElementById(id).textContent = text);
  write("heading", view.heading);
  write("summary", view.summary);
  write("label-key", view.labelKey ? `Labels: ${view.labelKey}.` : "");
  document.getElementById("chart").setAttribute("aria-label", view.chartLabel);
}

// One chart of each kind, of which one is seen.
function makeCharts(host, onPoint) {
  const charts = { trade: new Chart(host, onPoint), ratio: new RatioChart(host, onPoint) };
  return (view) => {
    for (const [kind, chart] of Object.entries(charts)) if (kind !== view.kind) chart.hide();
    charts[view.kind].show(view);
    return charts[view.kind];
  };
}

function countPoints(shown, total, optimal) {
  Object.assign(document.documentElement.dataset, { pointsShown: shown, pointsTotal: total, pointsOptimal: optimal });
}

function start(run) {
  document.getElementById("machine").textContent = run.machine || "";
  const groups = groupsOf(run.cases || []);
  countPoints(0, 0, 0);
  if (groups.length === 0) {
    document.getElementById("summary").textContent = "The run holds no case.";
    return;
  }
  let view = null;
  let shown = null;
  let chart = null;
  const tip = document.getElementById("tip");
  const showChart = makeCharts(document.getElementById("chart"), (point, place) => showTip(tip, point, place, view));
  const change = (changes) => {
    history.replaceState(null, "", hashFromState({ ...stateFromHash(location.hash), ...changes }));
    show();
  };
  const show = () => {
    const state = completeState(stateFromHash(location.hash), groups);
    const group = groups.find((each) => each.name === state.group);
    // Another order of the table is no reason to forget what the reader has enlarged; ratios are in that order too.
    const wanted = hashFromState(group.kind === "trade" ? { ...state, sort: null } : state);
    const isNew = wanted !== shown;
    shown = wanted;
    if (isNew) view = group.viewOf(group, state);
    orderView(view, state.sort);
    if (isNew) {
      showKind(group.kind);
      showControls(groups, group, state, change);
      showWords(view);
      showTip(tip, null, null, view);
      chart = showChart(view);
    }
    showTable(document.getElementById("table"), view, change, (point) => chart.mark(point));
    countPoints(view.points.length, group.cases.length, view.optimal.length);
  };
  addEventListener("hashchange", show);
  show();
}

// Tests and the curious find here whether the page works. Nothing else would tell of an error on a page from disk.
document.documentElement.dataset.errors = 0;
addEventListener("error", () => ++document.documentElement.dataset.errors, true);
start(JSON.parse(document.getElementById("run").textContent));
