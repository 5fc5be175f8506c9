// SPDX-License-Identifier: Apache-2.0
// What the keys of the run's JSON are called on the page. A key that is missing here is shown by its own name.

const SETTING_NAMES = {
  voxel: "voxel",
  lookup: "lookup",
  normal: "normal",
  storage: "storage",
  scheme: "scheme",
  sweep: "sweep",
  dt: "time step",
};

// In the unit that a setting's values are read with; other settings are words.
const SETTING_UNITS = { dt: "s" };

// The kinds of bench whose cases have no settings.
const KIND_NAMES = {
  field: "lookups against others",
  mesh: "level sets of meshes against others",
  make: "level sets made otherwise against others",
  collide: "collisions against others",
};

const COST_NAMES = {
  us_per_particle_second: { label: "time per particle and second of the scene", short: "time for a second", unit: "µs" },
  ns_per_particle_step: { label: "time per particle and step", short: "time", unit: "ns" },
  build_seconds: { label: "time to build the field", short: "build time", unit: "s" },
  bytes: { label: "memory of the field", short: "memory", unit: "B" },
};

const ERROR_NAMES = {
  phi_mean_vx: { label: "distance error, mean", short: "distance, mean", unit: "vx" },
  phi_p99_vx: { label: "distance error, 99th percentile", short: "distance, p99", unit: "vx" },
  phi_max_vx: { label: "distance error, largest", short: "distance, largest", unit: "vx" },
  phi_mean: { label: "distance error, mean", short: "distance, mean", unit: "" },
  phi_p99: { label: "distance error, 99th percentile", short: "distance, p99", unit: "" },
  phi_max: { label: "distance error, largest", short: "distance, largest", unit: "" },
  normal_mean_deg: { label: "normal error, mean", short: "normal, mean", unit: "°" },
  normal_max_deg: { label: "normal error, largest", short: "normal, largest", unit: "°" },
  time_of_impact_s: { label: "time of impact, error", short: "time of impact", unit: "s" },
  time_of_impact_max_s: { label: "time of impact, largest error", short: "time of impact, largest", unit: "s" },
  place_of_impact_vx: { label: "place of impact, error", short: "place of impact", unit: "vx" },
  place_of_impact_max_vx: { label: "place of impact, largest error", short: "place of impact, largest", unit: "vx" },
  place_of_impact: { label: "place of impact, error", short: "place of impact", unit: "" },
  place_of_impact_max: { label: "place of impact, largest error", short: "place of impact, largest", unit: "" },
  missed: { label: "particles that missed", short: "missed", unit: "of 1" },
  penetration_vx: { label: "penetration", unit: "vx" },
  penetration: { label: "penetration", unit: "" },
  energy_drift: { label: "energy drift", unit: "of 1" },
  final_position_vx: { label: "final position, error", short: "final position", unit: "vx" },
  final_position: { label: "final position, error", short: "final position", unit: "" },
  sliding_distance_relative: { label: "sliding distance, error", short: "sliding distance", unit: "of 1" },
};

// What units are called where there is room for words.
const UNIT_WORDS = { ns: "ns", "µs": "µs", s: "seconds", B: "bytes", vx: "voxels", "": "world units", "°": "degrees", "of 1": "relative" };

// The error shown first: in world units, which compare across voxel sizes.
const FIRST_ERRORS = ["phi_p99", "phi_p99_vx", "place_of_impact_vx", "place_of_impact"];
