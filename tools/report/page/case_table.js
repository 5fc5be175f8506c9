// SPDX-License-Identifier: Apache-2.0
// The shown cases as a table, sorted by the column whose head was clicked last.

function tableColumns(view) {
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

function bodyRow(point, columns, onRow) {
  const cells = columns.map((column) => {
    const value = column.read(point.case);
    return element("td", { class: cellClass(column) }, value === null ? "–" : column.text(value));
  });
  const mark = element("td", { class: "mark" }, point.optimal ? "●" : "");
  if (point.optimal) mark.title = "no other shown is both cheaper and more exact";
  return element("tr", {
    class: point.optimal ? "optimal" : null,
    tabindex: "-1",
    onpointerenter: () => onRow(point),
    onfocus: () => onRow(point),
    onpointerleave: () => onRow(null),
    onblur: () => onRow(null),
  }, mark, ...cells);
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
  const columns = tableColumns(view);
  const wanted = (view.sort || view.x.key).replace(/^-/, "");
  const column = columns.find((each) => each.key === wanted) || columns[0];
  const sort = { key: column.key, descending: (view.sort || "").startsWith("-") };
  const body = element("tbody", {},
    ...sortedPoints(view.points, column, sort.descending).map((point) => bodyRow(point, columns, onRow)));
  followArrows(body);
  const focused = host.contains(document.activeElement) ? document.activeElement.dataset.key : null;
  host.replaceChildren(element("table", {},
    element("thead", {}, element("tr", {}, element("td"), ...columns.map((each) => headCell(each, sort, change)))), body));
  if (focused) host.querySelector(`[data-key="${CSS.escape(focused)}"]`).focus();
}
