// SPDX-License-Identifier: Apache-2.0
// Ratios as bars from 1, on a logarithmic axis that stays on top while the rows are scrolled.

// Gridlines, of which the one at 1 is added in any case.
const RATIO_TICKS = 6;

// Per cent of the axis.
function ratioPlace(axis, ratio) {
  const [low, high] = axis.range;
  return (100 * Math.log(ratio / low)) / Math.log(high / low);
}

function ratioTicks(axis) {
  const one = ratioPlace(axis, 1);
  // Beside the 1 there has to be room for its number.
  const others = axis.ticks(...axis.range, RATIO_TICKS).filter((tick) => Math.abs(ratioPlace(axis, tick) - one) > 6);
  return [1, ...others];
}

// The same gridlines behind every row, as the background of its track.
function gridlines(axis, ticks) {
  return ticks
    .map((tick) => {
      const line = tick === 1 ? "var(--muted)" : "var(--grid)";
      return `linear-gradient(${line}, ${line}) ${ratioPlace(axis, tick).toFixed(3)}% 0 / 1px 100% no-repeat`;
    })
    .join(", ");
}

function ratioHead(axis, ticks) {
  const numbers = ticks.map((tick) =>
    element("span", { class: tick === 1 ? "one" : null, style: `left: ${ratioPlace(axis, tick)}%` }, numberText(tick)));
  return element("div", { class: "ratio-row ratio-head" },
    element("div", { class: "ratio-label" }, "case and peer"),
    element("div", { class: "ratio-track" }, ...numbers),
    element("div", { class: "ratio-value" }, "ratio"));
}

// One name stands for all rows below it that share it.
function ratioRow(axis, point, before) {
  const { case: one, ratio, standing } = point;
  const place = ratioPlace(axis, ratio);
  const from = Math.min(place, ratioPlace(axis, 1));
  const to = Math.max(place, ratioPlace(axis, 1));
  const isSame = before && before.case.name === one.name;
  return element("div", { class: `ratio-row ${standing.name}${isSame ? " same" : ""}` },
    element("div", { class: "ratio-label" },
      ...(isSame ? [] : [element("div", {}, one.name)]), element("div", { class: "peer" }, one.settings.peer || "")),
    element("div", { class: "ratio-track" },
      element("span", { class: "bar", style: `left: ${from}%; width: ${to - from}%` }),
      element("span", { class: `dot ${standing.name}`, style: `left: ${place}%` })),
    element("div", { class: "ratio-value" }, numberText(ratio)));
}

// onPoint(point or null, place on the page's chart) is called as the pointer goes from row to row.
class RatioChart {
  constructor(host, onPoint) {
    this.host = host;
    this.onPoint = onPoint;
    this.list = element("div", { class: "ratios", tabindex: "0", hidden: true });
    this.list.addEventListener("scroll", () => this.tell());
    host.prepend(this.list);
    this.rows = new Map();
    this.marked = null;
  }

  show(view) {
    const points = view.ordered.filter((point) => point.ratio !== null);
    const ticks = ratioTicks(view.axis);
    this.rows = new Map(points.map((point, i) => [point, ratioRow(view.axis, point, points[i - 1])]));
    for (const [point, row] of this.rows) {
      row.addEventListener("pointerenter", () => this.markSeen(point));
      row.addEventListener("pointerleave", () => this.mark(null));
    }
    this.marked = null;
    this.list.hidden = false;
    this.host.hidden = points.length === 0;
    this.list.style.setProperty("--gridlines", gridlines(view.axis, ticks));
    this.list.replaceChildren(ratioHead(view.axis, ticks), ...this.rows.values());
    this.list.scrollTop = 0;
  }

  hide() {
    this.list.hidden = true;
    this.list.replaceChildren();
    this.rows = new Map();
    this.marked = null;
    this.host.hidden = false;
  }

  // From the table: the row may have to be scrolled to.
  mark(point) {
    const row = this.rows.get(point);
    if (row) this.scrollTo(row);
    this.markSeen(row ? point : null);
  }

  markSeen(point) {
    if (point === this.marked) return;
    for (const [each, marks] of [[this.marked, false], [point, true]]) {
      if (each) this.rows.get(each).classList.toggle("marked", marks);
    }
    this.marked = point;
    this.tell();
  }

  tell() {
    this.onPoint(this.marked, this.marked && this.placeOf(this.rows.get(this.marked)));
  }

  scrollTo(row) {
    const head = this.list.firstElementChild.offsetHeight;
    const least = row.offsetTop + row.offsetHeight - this.list.clientHeight;
    const most = row.offsetTop - head;
    this.list.scrollTop = Math.max(least, Math.min(most, this.list.scrollTop));
  }

  // The dot's, in pixels from the host's corner; null where it is scrolled away.
  placeOf(row) {
    const host = this.host.getBoundingClientRect();
    const dot = row.querySelector(".dot").getBoundingClientRect();
    if (dot.top < host.top || dot.bottom > host.bottom) return null;
    return { left: dot.left + dot.width / 2 - host.left, top: dot.top + dot.height / 2 - host.top };
  }
}
