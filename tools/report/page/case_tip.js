// SPDX-License-Identifier: Apache-2.0
// All that is known of one case, beside its point.

function tipRow(name, text, isChosen) {
  return element("div", { class: isChosen ? "chosen" : null }, element("dt", {}, name), element("dd", {}, text));
}

// Beside the point, on the side that has room, and wholly above the chart's host.
function showTip(tip, point, place, view) {
  tip.hidden = !point || !place;
  if (tip.hidden) return;
  tip.replaceChildren(...view.tipOf(point));
  const host = tip.parentElement;
  const { offsetWidth: width, offsetHeight: height } = tip;
  const after = place.left + 18;
  const left = after + width <= host.clientWidth ? after : place.left - 18 - width;
  const top = Math.min(place.top - 24, host.clientHeight - height);
  tip.style.left = `${Math.max(0, left)}px`;
  tip.style.top = `${Math.max(0, top)}px`;
}
