// SPDX-License-Identifier: Apache-2.0
// What the reader has chosen, as the part of the address after '#', so that a view can be kept and passed on:
//   #group=sphere%2C%20lookups&x=bytes&y=phi_max&lookup=cubic,trilinear&sort=-bytes
//   #group=collisions&find=bunny&peer=none
// Every key that is none of the page's own is a setting with the values that are kept.

const OWN_KEYS = ["group", "x", "y", "find", "sort"];

function stateFromHash(hash) {
  const state = { kept: new Map() };
  for (const part of hash.replace(/^#/, "").split("&")) {
    const equals = part.indexOf("=");
    if (equals < 0) continue;
    const key = decoded(part.slice(0, equals));
    const text = part.slice(equals + 1);
    if (OWN_KEYS.includes(key)) {
      state[key] = decoded(text);
    } else {
      state.kept.set(key, new Set(text.split(",").map(decoded)));
    }
  }
  return state;
}

function hashFromState(state) {
  const parts = OWN_KEYS.filter((key) => state[key]).map((key) => `${key}=${encodeURIComponent(state[key])}`);
  for (const [key, texts] of state.kept) {
    parts.push(`${encodeURIComponent(key)}=${[...texts].map(encodeURIComponent).join(",")}`);
  }
  return "#" + parts.join("&");
}

// An address typed by hand may hold a '%' that is none of ours.
function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

// What an old or mistyped address asks for and the run does not have is left out.
function completeState(state, groups) {
  const group = groups.find((each) => each.name === state.group) || groups[0];
  const has = (list, key) => list.some((each) => each.key === key);
  const kept = new Map();
  for (const key of group.varying) {
    const texts = settingValues(group.cases, key).map(settingText);
    const chosen = texts.filter((text) => state.kept.has(key) && state.kept.get(key).has(text));
    if (chosen.length > 0) kept.set(key, new Set(chosen));
  }
  return {
    group: group.name,
    x: has(group.costs, state.x) ? state.x : (group.costs[0] || {}).key,
    y: has(group.errors, state.y) ? state.y : firstError(group.errors),
    find: group.kind === "ratio" ? state.find : null,
    sort: state.sort,
    kept,
  };
}
