// SPDX-License-Identifier: Apache-2.0
// What can be put on an axis and into a column: the costs and errors that cases have.

function measure(kind, key, names) {
  const known = names[key] || { label: key.replaceAll("_", " "), unit: "" };
  return {
    key,
    kind,
    label: known.label,
    short: known.short || known.label,
    unit: known.unit,
    isScaled: known.unit in SCALED_UNITS,
    title: `${known.label} (${UNIT_WORDS[known.unit]})`,
    // Errors and drifts may be signed; on a logarithmic axis their size counts.
    read: (one) => {
      const value = (one[kind] || {})[key];
      return Number.isFinite(value) ? Math.abs(value) : null;
    },
    text: (value) => quantityText(value, known.unit),
  };
}

function measures(cases, kind, names) {
  const keys = new Set(Object.keys(names));
  for (const one of cases) Object.keys(one[kind] || {}).forEach((key) => keys.add(key));
  return [...keys]
    .map((key) => measure(kind, key, names))
    .filter((each) => cases.some((one) => each.read(one) !== null));
}

const costMeasures = (cases) => measures(cases, "cost", COST_NAMES);
const errorMeasures = (cases) => measures(cases, "error", ERROR_NAMES);

function firstError(errors) {
  return FIRST_ERRORS.find((key) => errors.some((each) => each.key === key)) || (errors[0] || {}).key;
}
