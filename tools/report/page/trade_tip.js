// SPDX-License-Identifier: Apache-2.0
// All that is known of one case that has costs and errors.

function measureRows(measures, one, chosen) {
  return measures
    .filter((each) => each.read(one) !== null)
    .flatMap((each) => {
      // Signs show here, where there is no logarithm.
      const value = one[each.kind][each.key];
      const name = each.unit === "" ? `${each.short} (world)` : each.short;
      return [tipRow(name, each.text(value), each.key === chosen.key), ...spreadRow(each, one)];
    });
}

// The least and the most of several runs.
function spreadRow(each, one) {
  const spread = (one.spread || {})[each.key];
  return spread ? [tipRow("", `${each.text(spread[0])} to ${each.text(spread[1])}`, false)] : [];
}

function settingRows(one) {
  return settingKeys([one])
    .filter((key) => (one.settings[key] ?? null) !== null)
    .map((key) => tipRow(settingName(key), settingWords(key, one.settings[key]), false));
}

function tradeTip(point, view) {
  const one = point.case;
  return [
    element("strong", {}, one.name || view.labelOf(point)),
    element("dl", {}, ...settingRows(one)),
    element("dl", {}, ...measureRows(view.costs, one, view.x)),
    element("dl", {}, ...measureRows(view.errors, one, view.y)),
  ];
}
