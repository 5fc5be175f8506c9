// SPDX-License-Identifier: Apache-2.0
// The shown cases as a table, sorted by the column whose head was clicked last.

const NO_MARK = { name: null, sign: "", title: null };

// Sets `sort` and `ordered`. Without a column to sort by the run's own order stays.
function orderView(view, wanted) {
  const text = wanted || view.firstSort || "";
  const column = view.columns.find((each) => each.key === text.replace(/^-/, ""));
  const descending = text.startsWith("-");
  view.sort = { key: column ? column.key : null, descending };
  view.ordered = column ? sortedPoints(view.points, column, descending) : view.points;
}

// What a case lacks comes last either way.
function sortedPoints(points, column, descending) {
  const sign = descending ? -1 : 1;
  return [...points].sort((a, b) => {
    const [left, right] = [column.read(a.case), column.read(b.case)];
    if (left === null || right === null) return (left === null) - (right === null);
    return sign * (left < right ? -1 : left > right ? 1 : 0);
  });
}

function headCell(column, sort, change) {
  const isSorted = sort.key === column.key;
  const order = isSorted ? (sort.descending ? "descending" : "ascending") : "none";
  const next = isSorted && !sort.descending ? `-${column.key}` : column.key;
  const arrow = isSorted ? (sort.descending ? " ▾" : " ▴") : "";
  const button = element("button", { type: "button", "data-key": column.key, onclick: () => change({ sort: next }) },
    column.head + arrow, ...(column.unit ? [element("small", {}, column.unit)] : []));
  return element("th", { scope: "col", "aria-sort": order, class: cellClass(column) }, button);
}

function cellClass(column) {
  return [column.isText ? "text" : "", column.isChosen ? "chosen" : ""].join(" ").trim() || null;
}

function bodyRow(point, view, onRow) {
  const cells = view.columns.map((column) => {
    const value = column.read(point.case);
    return element("td", { class: cellClass(column) }, value === null ? "–" : column.text(value, point.case));
  });
  const mark = view.markOf(point);
  return element("tr", {
    class: mark.name,
    tabindex: "-1",
    onpointerenter: () => onRow(point),
    onfocus: () => onRow(point),
    onpointerleave: () => onRow(null),
    onblur: () => onRow(null),
  }, element("td", { class: "mark", title: mark.title }, mark.sign), ...cells);
}

// The rows are one stop of the Tab key; the arrow keys go on from there.
function followArrows(body) {
  if (body.firstElementChild) body.firstElementChild.tabIndex = 0;
  body.addEventListener("keydown", (event) => {
    const row = event.target;
    const next = { ArrowDown: row.nextElementSibling, ArrowUp: row.previousElementSibling }[event.key];
    if (!next) return;
    event.preventDefault();
    next.focus();
  });
}

function showTable(host, view, change, onRow) {
  const body = element("tbody", {}, ...view.ordered.map((point) => bodyRow(point, view, onRow)));
  followArrows(body);
  const focused = host.contains(document.activeElement) ? document.activeElement.dataset.key : null;
  const heads = view.columns.map((each) => headCell(each, view.sort, change));
  host.replaceChildren(element("table", { class: view.kind }, element("thead", {}, element("tr", {}, element("td"), ...heads)), body));
  if (focused) host.querySelector(`[data-key="${CSS.escape(focused)}"]`).focus();
}
