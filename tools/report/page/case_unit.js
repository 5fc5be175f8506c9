// SPDX-License-Identifier: Apache-2.0
// Units of cases as the run has them, "ms" or "ns/point": what they measure, and values of them for reading.

// The unit that values are compared and scaled in, how many of it one is, and what both measure.
const UNIT_BASES = {
  s: ["s", 1, "time"],
  ms: ["s", 1e-3, "time"],
  "µs": ["s", 1e-6, "time"],
  ns: ["s", 1e-9, "time"],
  GB: ["B", 1e9, "memory"],
  MB: ["B", 1e6, "memory"],
  kB: ["B", 1e3, "memory"],
  bytes: ["B", 1, "memory"],
  vx: ["vx", 1, "distance"],
  "%": ["%", 1, "share"],
  voxels: ["voxels", 1, "count"],
  triangles: ["triangles", 1, "count"],
};

// "ns/point" is nanoseconds, told for each point.
function caseUnit(unit = "") {
  const [, plain, each] = unit.match(/^([^/]*)(.*)$/);
  const [base, factor, quantity] = UNIT_BASES[plain] || [plain, 1, plain || "number"];
  return {
    quantity,
    inBase: (value) => (Number.isFinite(value) ? value * factor : null),
    text: (value) => quantityText(value, base) + (value === 0 ? "" : each),
  };
}
