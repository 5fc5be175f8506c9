// SPDX-License-Identifier: Apache-2.0
// A logarithmic axis on which zero has a place too: a floor line below the smallest value.

// How much of the axis is left free beyond the values, and between the smallest and the floor.
const AXIS_MARGIN = 0.07;
const FLOOR_GAP = 0.14;
// Values that hardly differ still get an axis this wide, in decades.
const LEAST_SPAN = 0.3;

function logAxis(values) {
  const positive = values.filter((value) => value > 0);
  const low = positive.length ? Math.min(...positive) : 1;
  const high = positive.length ? Math.max(...positive) : 1;
  const span = Math.max(Math.log10(high / low), LEAST_SPAN);
  const hasZero = values.some((value) => value === 0);
  const floor = low / 10 ** (span * FLOOR_GAP);
  const margin = 10 ** (span * AXIS_MARGIN);
  return {
    floor: hasZero ? floor : null,
    range: [(hasZero ? floor : low) / margin, high * margin],
    place: (value) => (value > 0 ? value : floor),
    ticks: (min, max, count) => {
      const ticks = logTicks(min, max, count);
      // Between the floor and the smallest value the axis means nothing.
      return hasZero ? [floor, ...ticks.filter((tick) => tick > low * 0.999)].filter((t) => t >= min) : ticks;
    },
  };
}

function logTicks(min, max, count) {
  const decades = Math.log10(max / min);
  const steps = decades * 3 <= count ? [1, 2, 5] : [1];
  if (decades < 0.8) return linearTicks(min, max, count);
  const every = steps.length > 1 ? 1 : Math.ceil(decades / count);
  const ticks = [];
  for (let power = Math.floor(Math.log10(min)); power <= Math.log10(max); ++power) {
    if (power % every !== 0) continue;
    for (const step of steps) ticks.push(Number(`${step}e${power}`));
  }
  return ticks.filter((tick) => tick >= min && tick <= max);
}

function linearTicks(min, max, count) {
  const power = 10 ** Math.floor(Math.log10((max - min) / count));
  const step = [1, 2, 5, 10].map((each) => each * power).find((each) => (max - min) / each <= count);
  const ticks = [];
  for (let i = Math.ceil(min / step); i * step <= max; ++i) ticks.push(Number((i * step).toPrecision(12)));
  return ticks;
}
