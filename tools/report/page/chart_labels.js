// SPDX-License-Identifier: Apache-2.0
// Writes beside optimal points what they are, where that covers neither another label nor a point.

const LABEL_HEIGHT = 15;
const LABEL_GAP = 9;

function boxesOverlap(a, b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

// Above the curve to the right, where it has left room, else below it to the left.
function labelBoxes({ left, top }, width) {
  const right = { left: left + LABEL_GAP, right: left + LABEL_GAP + width };
  const before = { left: left - LABEL_GAP - width, right: left - LABEL_GAP };
  const rows = [top - LABEL_HEIGHT - 1, top + 1, top - LABEL_HEIGHT / 2];
  const box = (sides, row) => ({ ...sides, top: row, bottom: row + LABEL_HEIGHT });
  return [box(right, rows[0]), box(before, rows[1]), box(right, rows[1]), box(before, rows[0]), box(right, rows[2])];
}

function drawLabels(ctx, optimal, placed, area, labelOf) {
  ctx.font = "12px system-ui, sans-serif";
  ctx.textBaseline = "middle";
  ctx.textAlign = "left";
  const taken = placed.map(({ left, top }) => ({ left: left - 3, right: left + 3, top: top - 3, bottom: top + 3 }));
  for (const each of optimal) {
    const text = labelOf(each.point);
    const fits = (box) =>
      box.left >= 0 && box.right <= area.width && box.top >= 0 && box.bottom <= area.height &&
      !taken.some((other) => boxesOverlap(box, other));
    const box = labelBoxes(each, ctx.measureText(text).width).find(fits);
    if (!box) continue;
    taken.push(box);
    writeLabel(ctx, text, box.left, box.top + LABEL_HEIGHT / 2);
  }
}

// With a halo, so that lines behind it do not cross it out.
function writeLabel(ctx, text, left, middle) {
  ctx.strokeStyle = color("--surface");
  ctx.lineWidth = 4;
  ctx.lineJoin = "round";
  ctx.strokeText(text, left, middle);
  ctx.fillStyle = color("--text");
  ctx.fillText(text, left, middle);
}
