// SPDX-License-Identifier: Apache-2.0
// The choices of group and axes, the words looked for, and a row of toggles for each setting that varies.

function fillSelect(select, options, chosen) {
  select.replaceChildren(
    ...options.map(({ value, text }) => element("option", { value, selected: value === chosen }, text)),
  );
  select.value = chosen;
}

const measureOptions = (measures) => measures.map((each) => ({ value: each.key, text: each.title }));

function toggle(text, isPressed, onclick) {
  return element("button", { type: "button", "aria-pressed": String(isPressed), onclick }, text);
}

// Nothing picked keeps all; so the first click keeps one value, and "all" undoes it.
function filterRow(group, key, state, change) {
  const picked = state.kept.get(key) || new Set();
  const keep = (texts) => {
    const kept = new Map(state.kept);
    if (texts.size > 0) kept.set(key, texts);
    else kept.delete(key);
    change({ kept });
  };
  const flip = (text) => {
    const texts = new Set(picked);
    if (!texts.delete(text)) texts.add(text);
    keep(texts);
  };
  const buttons = settingValues(group.cases, key).map((value) => {
    const text = settingText(value);
    return toggle(settingWords(key, value), picked.has(text), () => flip(text));
  });
  const name = settingName(key);
  return element("div", { class: "filter", role: "group", "aria-label": `Filter by ${name}` },
    element("span", {}, name), toggle("all", picked.size === 0, () => keep(new Set())), ...buttons);
}

// Redrawn at every change; the focus stays on the button it was on.
function showFilters(host, group, state, change) {
  const buttons = [...host.querySelectorAll("button")];
  const focused = buttons.indexOf(document.activeElement);
  host.replaceChildren(...group.varying.map((key) => filterRow(group, key, state, change)));
  if (focused >= 0) (host.querySelectorAll("button")[focused] || document.body).focus();
}

function showControls(groups, group, state, change) {
  const select = (id, options, chosen) => {
    const each = document.getElementById(id);
    fillSelect(each, options, chosen);
    each.onchange = () => change({ [id]: each.value });
  };
  select("group", groups.map(({ name }) => ({ value: name, text: name })), state.group);
  select("x", measureOptions(group.costs), state.x);
  select("y", measureOptions(group.errors), state.y);
  const find = document.getElementById("find");
  if (find.value !== (state.find || "")) find.value = state.find || "";
  find.oninput = () => change({ find: find.value });
  // Return would load the page anew.
  find.form.onsubmit = (event) => event.preventDefault();
  showFilters(document.getElementById("filters"), group, state, change);
}
