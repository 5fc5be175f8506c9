// SPDX-License-Identifier: Apache-2.0
// Sets `optimal` of each point: no other is as good in both x and y and better in one. Equal points are so together.

function markOptimal(points) {
  const byCost = [...points].sort((a, b) => a.x - b.x || a.y - b.y);
  let best = null;
  for (const point of byCost) {
    point.optimal = best === null || point.y < best.y || (point.y === best.y && point.x === best.x);
    if (point.optimal) best = point;
  }
  return byCost.filter((point) => point.optimal);
}
