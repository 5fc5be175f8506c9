// SPDX-License-Identifier: Apache-2.0
// The chart: uPlot has the axes, the grid and the selection; what lies between them is drawn by chart_points.js.

// Pixels from the pointer within which a point is the one that is meant.
const REACH = 36;
// Pixels that a tick's text takes along each axis.
const TICK_WIDTH = 84;
const TICK_HEIGHT = 44;

function color(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function chartSize(host) {
  const width = host.clientWidth;
  return { width, height: Math.round(Math.min(560, Math.max(380, width * 0.5))) };
}

function uplotAxis(axis, measure, room, across) {
  return {
    scale: across ? "x" : "y",
    label: measure.title,
    labelFont: "600 13px system-ui, sans-serif",
    font: "12px system-ui, sans-serif",
    size: across ? 44 : 74,
    labelSize: 26,
    stroke: () => color("--muted"),
    grid: { stroke: () => color("--grid"), width: 1 },
    ticks: { stroke: () => color("--grid"), width: 1, size: 6 },
    splits: (plot, index, min, max) => axis.ticks(min, max, Math.max(2, (across ? plot.width : plot.height) / room)),
    // uPlot's own would keep decades only.
    filter: (plot, splits) => splits,
    values: (plot, splits) => splits.map((split) => (split === axis.floor ? "0" : measure.text(split))),
  };
}

// The frame that the reader has dragged, in values; null where it is too small to be meant.
function selectedRange(plot) {
  const { left, top, width, height } = plot.select;
  if (width < 8 || height < 8) return null;
  return {
    x: [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")],
    y: [plot.posToVal(top + height, "y"), plot.posToVal(top, "y")],
  };
}

function nearestPoint(plot, points, left, top) {
  let nearest = null;
  let least = REACH;
  for (const point of points) {
    const away = Math.hypot(plot.valToPos(point.px, "x") - left, plot.valToPos(point.py, "y") - top);
    if (away < least) [nearest, least] = [point, away];
  }
  return nearest;
}

// onPoint(point or null, place on the page's chart) is called as the pointer goes from point to point.
class Chart {
  constructor(host, onPoint) {
    this.host = host;
    this.onPoint = onPoint;
    this.plot = null;
    new ResizeObserver(() => this.plot && this.plot.setSize(chartSize(host))).observe(host);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.plot && this.plot.redraw());
  }

  show(view) {
    this.hide();
    this.view = view;
    this.zoom = null;
    this.marked = null;
    const byCost = [...view.points].sort((a, b) => a.px - b.px);
    this.plot = new uPlot(this.options(), [byCost.map((p) => p.px), byCost.map((p) => p.py)], this.host);
    this.listen(this.plot.over);
  }

  hide() {
    if (this.plot) this.plot.destroy();
    this.plot = null;
  }

  options() {
    const { view } = this;
    return {
      ...chartSize(this.host),
      legend: { show: false },
      padding: [18, 22, 0, 0],
      cursor: { x: false, y: false, points: { show: false }, drag: { x: true, y: true, setScale: false } },
      scales: {
        x: { time: false, distr: 3, range: () => (this.zoom ? this.zoom.x : view.xAxis.range) },
        y: { distr: 3, range: () => (this.zoom ? this.zoom.y : view.yAxis.range) },
      },
      axes: [uplotAxis(view.xAxis, view.x, TICK_WIDTH, true), uplotAxis(view.yAxis, view.y, TICK_HEIGHT, false)],
      series: [{}, { paths: () => null, points: { show: false } }],
      hooks: {
        draw: [(plot) => drawPoints(plot, view, this.marked)],
        setSelect: [(plot) => this.zoomTo(selectedRange(plot))],
      },
    };
  }

  zoomTo(range) {
    this.plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    if (range) this.rescale(range);
  }

  rescale(range) {
    this.zoom = range;
    this.mark(null);
    this.plot.setData(this.plot.data);
  }

  listen(over) {
    over.addEventListener("pointermove", (event) => {
      const box = over.getBoundingClientRect();
      const seen = this.view.points.filter((point) => this.isSeen(point));
      this.mark(nearestPoint(this.plot, seen, event.clientX - box.left, event.clientY - box.top));
    });
    over.addEventListener("pointerleave", () => this.mark(null));
    over.addEventListener("dblclick", () => this.rescale(null));
  }

  isSeen(point) {
    const { x, y } = this.plot.scales;
    return point.px >= x.min && point.px <= x.max && point.py >= y.min && point.py <= y.max;
  }

  mark(point) {
    if (point === this.marked) return;
    this.marked = point;
    this.plot.redraw(false);
    this.onPoint(point, point && this.isSeen(point) ? this.placeOf(point) : null);
  }

  // In pixels from the host's corner.
  placeOf(point) {
    const { offsetLeft, offsetTop } = this.plot.over;
    return {
      left: offsetLeft + this.plot.valToPos(point.px, "x"),
      top: offsetTop + this.plot.valToPos(point.py, "y"),
    };
  }
}
