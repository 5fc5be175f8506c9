// SPDX-License-Identifier: Apache-2.0
// Cases that are compared with a peer or stand alone: a group, and what is seen of it: a ratio for each case and peer.

const STANDINGS = {
  ahead: { name: "ahead", sign: "●", title: "vdbounce is ahead of the peer" },
  behind: { name: "behind", sign: "◇", title: "vdbounce is behind the peer" },
  alike: { name: "alike", sign: "○", title: "vdbounce and the peer are alike" },
};

// Measuring again differs by as much.
const ALIKE = 0.01;

// What has nothing on one of both sides has no ratio that could be drawn.
function ratioOf(one) {
  return Number.isFinite(one.ratio) && one.ratio > 0 ? one.ratio : null;
}

function standingOf(ratio) {
  if (ratio === null) return NO_MARK;
  if (Math.abs(ratio - 1) <= ALIKE) return STANDINGS.alike;
  return ratio > 1 ? STANDINGS.ahead : STANDINGS.behind;
}

// What a case can be filtered by becomes its settings.
function ratioCase(one) {
  const unit = caseUnit(one.unit);
  const peer = one.peer ? one.peer.name : null;
  return { ...one, unit, settings: { standing: standingOf(ratioOf(one)).name, quantity: unit.quantity, peer } };
}

function ratioGroup(name, cases) {
  const known = cases.map(ratioCase);
  return {
    name,
    cases: known,
    kind: "ratio",
    heading: "Measured against others",
    chartLabel: "The peer's value over that of vdbounce for each case, logarithmic",
    varying: varyingSettings(known),
    costs: [],
    errors: [],
    viewOf: ratioView,
  };
}

// Every word has to be there, wherever it is.
function isFound(one, words) {
  const text = `${one.name} ${one.settings.peer || ""}`.toLowerCase();
  return words.every((word) => text.includes(word));
}

function ratioView(group, state) {
  const words = (state.find || "").toLowerCase().split(/\s+/);
  const kept = group.cases.filter((one) => isKept(one, state.kept) && isFound(one, words));
  const points = kept.map((one) => ({ case: one, ratio: ratioOf(one), standing: standingOf(ratioOf(one)) }));
  const axis = logAxis([1, ...points.map((point) => point.ratio).filter((ratio) => ratio !== null)]);
  return {
    ...group,
    points,
    axis,
    optimal: [],
    summary: ratioSummary(points, group.cases.length),
    columns: RATIO_COLUMNS,
    markOf: (point) => point.standing,
    tipOf: ratioTip,
  };
}

function ratioSummary(points, total) {
  const shown = points.length === total ? `All ${total} cases are shown` : `${points.length} of ${total} cases are shown`;
  if (points.length === 0) return "No case is left; look for less or widen the filters.";
  const count = (mark) => points.filter((point) => point.standing === mark).length;
  const parts = [
    [count(STANDINGS.ahead), "ahead of the peer"],
    [count(STANDINGS.behind), "behind"],
    [count(STANDINGS.alike), "alike"],
    [count(NO_MARK), "without a ratio"],
  ];
  return `${shown}: ${parts.filter(([some]) => some > 0).map(([some, what]) => `${some} ${what}`).join(", ")}.`;
}

const RATIO_COLUMNS = [
  { key: "name", head: "case", isText: true, read: (one) => one.name, text: String },
  { key: "value", head: "vdbounce", read: (one) => one.unit.inBase(one.value), text: (value, one) => one.unit.text(value) },
  { key: "peer", head: "peer", isText: true, read: (one) => one.settings.peer, text: String },
  {
    key: "peer_value",
    head: "peer's value",
    read: (one) => (one.peer ? one.unit.inBase(one.peer.value) : null),
    text: (value, one) => one.unit.text(value),
  },
  { key: "ratio", head: "ratio", isChosen: true, read: ratioOf, text: numberText },
];

// All that is known of one case: what the table has and what it is filtered by.
function ratioTip(point) {
  const one = point.case;
  const rows = RATIO_COLUMNS.slice(1)
    .filter((column) => column.read(one) !== null)
    .map((column) => tipRow(column.head, column.text(column.read(one), one), column.isChosen));
  return [
    element("strong", {}, one.name),
    element("dl", {}, ...rows),
    element("dl", {}, tipRow("", point.standing.title || "nothing to compare with", false)),
  ];
}
