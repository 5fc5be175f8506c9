// SPDX-License-Identifier: Apache-2.0
// Numbers for reading: three significant digits and a unit of handy size.

const SUPERSCRIPTS = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

function powerText(exponent) {
  return "10" + [...String(exponent)].map((digit) => SUPERSCRIPTS[digit]).join("");
}

function numberText(value) {
  if (value === 0) return "0";
  const rounded = Number(value.toPrecision(3));
  const size = Math.abs(rounded);
  if (size >= 1e-3 && size < 1e6) return String(rounded);
  const [mantissa, exponent] = rounded.toExponential().split("e");
  const power = powerText(Number(exponent));
  return mantissa === "1" ? power : `${mantissa}·${power}`;
}

// The same quantity in larger or smaller units, largest first.
const SCALED_UNITS = {
  B: [[1e9, "GB"], [1e6, "MB"], [1e3, "kB"], [1, "B"]],
  s: [[1, "s"], [1e-3, "ms"], [1e-6, "µs"], [1e-9, "ns"]],
  "µs": [[1e6, "s"], [1e3, "ms"], [1, "µs"]],
  ns: [[1e9, "s"], [1e6, "ms"], [1e3, "µs"], [1, "ns"]],
};

function quantityText(value, unit) {
  if (value === 0 || unit === "" || unit === "of 1") return numberText(value);
  if (unit === "°") return numberText(value) + "°";
  const units = SCALED_UNITS[unit] || [[1, unit]];
  const size = Math.abs(Number(value.toPrecision(3)));
  const [factor, name] = units.find(([one]) => size >= one) || units[units.length - 1];
  return `${numberText(value / factor)} ${name}`;
}
