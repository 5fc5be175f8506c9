// SPDX-License-Identifier: Apache-2.0
// Cases that have costs and errors: a group, and what is seen of it: points on two axes and which of them are optimal.

function tradeGroup(name, cases) {
  return {
    name,
    cases,
    kind: "trade",
    heading: "Cost and error of each choice",
    chartLabel: "Error over cost, both logarithmic",
    varying: varyingSettings(cases),
    costs: costMeasures(cases),
    errors: errorMeasures(cases),
    viewOf: tradeView,
  };
}

function tradeView(group, state) {
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
  const view = { ...group, x, y, points, xAxis, yAxis, labelOf, labelKey, optimal: markOptimal(points),
                 lacking: kept.length - points.length, firstSort: x.key, markOf: tradeMark };
  return { ...view, summary: tradeSummary(view), columns: tradeColumns(view), tipOf: (point) => tradeTip(point, view) };
}

function tradeSummary(view) {
  const { points, optimal, cases, lacking } = view;
  const shown = points.length === cases.length ? `All ${cases.length} cases are shown` :
    `${points.length} of ${cases.length} cases are shown`;
  const without = lacking === 0 ? "" : ` (${lacking} have no value on one of the axes)`;
  if (points.length === 0) return `${shown}${without}; widen the filters.`;
  return `${shown}${without}; ${optimal.length} ${optimal.length === 1 ? "is" : "are"} Pareto-optimal.`;
}

function tradeMark(point) {
  return point.optimal ? { name: "optimal", sign: "●", title: "no other shown is both cheaper and more exact" } : NO_MARK;
}

function tradeColumns(view) {
  const settings = view.varying.map((key) => ({
    key,
    head: settingName(key),
    isText: settingValues(view.cases, key).some((value) => typeof value === "string"),
    read: (one) => (one.settings || {})[key] ?? null,
    text: (value) => settingWords(key, value),
  }));
  const name = { key: "name", head: "case", isText: true, read: (one) => one.name, text: String };
  // What is on the axes comes first, where it needs no scrolling.
  const onAxis = [view.x, view.y];
  const others = [...view.costs, ...view.errors].filter((each) => !onAxis.includes(each));
  const measured = [...onAxis, ...others].map((each) => ({
    key: each.key,
    head: each.short,
    // Units of handy size differ from cell to cell and stand there.
    unit: each.isScaled ? null : UNIT_WORDS[each.unit],
    isChosen: onAxis.includes(each),
    read: each.read,
    text: each.isScaled ? each.text : numberText,
  }));
  return [...(settings.length > 0 ? settings : [name]), ...measured];
}
