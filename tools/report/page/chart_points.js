// SPDX-License-Identifier: Apache-2.0
// Draws between the axes: the floor for zeros, spreads, the step curve of the optimal points, the points.
// All lengths are CSS pixels; the context is scaled by the device's.

function drawPoints(plot, view, marked) {
  const { ctx } = plot;
  const ratio = uPlot.pxRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(plot.bbox.left, plot.bbox.top, plot.bbox.width, plot.bbox.height);
  ctx.clip();
  // From here on (0, 0) is the corner of the plotting area.
  ctx.translate(plot.bbox.left, plot.bbox.top);
  ctx.scale(ratio, ratio);
  const area = { width: plot.bbox.width / ratio, height: plot.bbox.height / ratio };
  const placed = view.points.map((point) => ({ point, ...placeOn(plot, point) }));
  drawFloors(ctx, plot, view, area);
  if (view.x.key === "ns_per_particle_step") drawSpreads(ctx, plot, placed);
  for (const each of placed.filter(({ point }) => !point.optimal)) drawDot(ctx, each, "--dominated", 3.5);
  const optimal = view.optimal.map((point) => ({ point, ...placeOn(plot, point) }));
  drawSteps(ctx, optimal, area);
  for (const each of optimal) drawDot(ctx, each, "--accent", 5);
  drawLabels(ctx, optimal, placed, area, view.labelOf);
  if (marked) drawRing(ctx, { point: marked, ...placeOn(plot, marked) });
  ctx.restore();
}

function placeOn(plot, point) {
  return { left: plot.valToPos(point.px, "x"), top: plot.valToPos(point.py, "y") };
}

function drawLine(ctx, from, to, style, width, dash = []) {
  ctx.beginPath();
  ctx.moveTo(...from);
  ctx.lineTo(...to);
  ctx.strokeStyle = style;
  ctx.lineWidth = width;
  ctx.setLineDash(dash);
  ctx.stroke();
  ctx.setLineDash([]);
}

function drawFloors(ctx, plot, view, area) {
  const style = color("--muted");
  if (view.xAxis.floor !== null) {
    const left = plot.valToPos(view.xAxis.floor, "x");
    drawLine(ctx, [left, 0], [left, area.height], style, 1, [4, 4]);
  }
  if (view.yAxis.floor !== null) {
    const top = plot.valToPos(view.yAxis.floor, "y");
    drawLine(ctx, [0, top], [area.width, top], style, 1, [4, 4]);
  }
}

function drawSpreads(ctx, plot, placed) {
  for (const { point, top } of placed) {
    if (!point.spread || !(point.spread[0] > 0)) continue;
    const [from, to] = point.spread.map((value) => plot.valToPos(value, "x"));
    drawLine(ctx, [from, top], [to, top], color(point.optimal ? "--accent-faint" : "--dominated-faint"), 2);
  }
}

// Right, then down: what lies below the curve cannot be had. Its ends go on to the edges.
function drawSteps(ctx, optimal, area) {
  if (optimal.length === 0) return;
  ctx.beginPath();
  ctx.moveTo(optimal[0].left, 0);
  let { top } = optimal[0];
  for (const each of optimal) {
    ctx.lineTo(each.left, top);
    ctx.lineTo(each.left, each.top);
    top = each.top;
  }
  ctx.lineTo(area.width, top);
  ctx.strokeStyle = color("--accent");
  ctx.globalAlpha = 0.55;
  ctx.lineWidth = 1.5;
  ctx.stroke();
  ctx.globalAlpha = 1;
}

function drawDot(ctx, { left, top }, name, radius) {
  ctx.beginPath();
  ctx.arc(left, top, radius, 0, 2 * Math.PI);
  ctx.fillStyle = color(name);
  ctx.fill();
  ctx.strokeStyle = color("--surface");
  ctx.lineWidth = 1;
  ctx.stroke();
}

function drawRing(ctx, { point, left, top }) {
  drawDot(ctx, { left, top }, point.optimal ? "--accent" : "--text", 5.5);
  ctx.beginPath();
  ctx.arc(left, top, 9.5, 0, 2 * Math.PI);
  ctx.strokeStyle = color("--text");
  ctx.lineWidth = 2;
  ctx.stroke();
}
