// SPDX-License-Identifier: Apache-2.0
// All that is known of one case, beside its point.

function tipRow(name, text, isChosen) {
  return element("div", { class: isChosen ? "chosen" : null }, element("dt", {}, name), element("dd", {}, text));
}

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

function fillTip(tip, point, view) {
  const one = point.case;
  tip.replaceChildren(
    element("strong", {}, one.name || view.labelOf(point)),
    element("dl", {}, ...settingRows(one)),
    element("dl", {}, ...measureRows(view.costs, one, view.x)),
    element("dl", {}, ...measureRows(view.errors, one, view.y)),
  );
}

// Beside the point, on the side that has room, and wholly above the chart's host.
function showTip(tip, point, place, view) {
  tip.hidden = !point || !place;
  if (tip.hidden) return;
  fillTip(tip, point, view);
  const host = tip.parentElement;
  const { offsetWidth: width, offsetHeight: height } = tip;
  const after = place.left + 18;
  const left = after + width <= host.clientWidth ? after : place.left - 18 - width;
  const top = Math.min(place.top - 24, host.clientHeight - height);
  tip.style.left = `${Math.max(0, left)}px`;
  tip.style.top = `${Math.max(0, top)}px`;
}
