// SPDX-License-Identifier: Apache-2.0
// The settings of cases: which of them vary, and their values as text. Null is what a case does not have.

function settingText(value) {
  return value === null || value === undefined ? "none" : String(value);
}

// "0.004 s", for reading; settingText is what filters and the address compare.
function settingWords(key, value) {
  const text = settingText(typeof value === "number" ? Number(value.toPrecision(5)) : value);
  return SETTING_UNITS[key] && text !== "none" ? `${text} ${SETTING_UNITS[key]}` : text;
}

function settingName(key) {
  return SETTING_NAMES[key] || key.replaceAll("_", " ");
}

function settingKeys(cases) {
  const keys = new Set(Object.keys(SETTING_NAMES));
  for (const one of cases) Object.keys(one.settings || {}).forEach((key) => keys.add(key));
  return [...keys];
}

// Values in rising order where they are numbers, else as the run has them, what is missing last.
function settingValues(cases, key) {
  const values = new Map();
  for (const one of cases) {
    const value = (one.settings || {})[key] ?? null;
    values.set(settingText(value), value);
  }
  const found = [...values.values()];
  const areNumbers = found.every((value) => value === null || typeof value === "number");
  return found.sort(areNumbers ? (a, b) => a - b : (a, b) => (a === null) - (b === null));
}

// Only what varies is worth a filter, a column, a word in a label.
function varyingSettings(cases) {
  return settingKeys(cases).filter((key) => settingValues(cases, key).length > 1);
}

function isKept(one, kept) {
  for (const [key, texts] of kept) {
    if (!texts.has(settingText((one.settings || {})[key]))) return false;
  }
  return true;
}
