// SPDX-License-Identifier: Apache-2.0
// The groups that the reader chooses from, in the order of the run.

// Of a run of all kinds each kind is one; of another run all cases that have no settings are.
function groupName(one) {
  if (isTrade(one)) return one.group || "all cases";
  return KIND_NAMES[one.kind] || one.kind || "all cases against others";
}

function isTrade(one) {
  return Boolean(one.settings || one.cost);
}

function groupsOf(cases) {
  const byName = new Map();
  for (const one of cases) {
    const name = groupName(one);
    if (!byName.has(name)) byName.set(name, []);
    byName.get(name).push(one);
  }
  return [...byName]
    .map(([name, all]) => (isTrade(all[0]) ? tradeGroup(name, all) : ratioGroup(name, all)))
    .filter((group) => group.kind === "ratio" || (group.costs.length > 0 && group.errors.length > 0));
}
