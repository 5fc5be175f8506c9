// SPDX-License-Identifier: Apache-2.0
#include "collide_report.h"

namespace vdbounce::tool {
namespace {

Json toJson(const FieldOptions& accuracy)
{
    return {{"lookup", nameOf(accuracy.lookup)},
            {"normal", nameOf(accuracy.normal)},
            {"storage", nameOf(accuracy.storage)}};
}

Json toJson(const RunReport& run)
{
    Json colliders = Json::array();
    for (std::size_t i = 0; i < run.colliderNames.size(); ++i) {
        colliders.push_back({{"name", run.colliderNames[i]},
                             {"impulse", tool::toJson(run.tally.impulse[i])},
                             {"angular_impulse", tool::toJson(run.tally.angularImpulse[i])}});
    }
    const StepTally& tally = run.tally;
    Json json = {{"particles", run.particles},
                 {"frames", run.frames},
                 {"steps", run.steps},
                 {"seconds", run.seconds},
                 {"particle_steps_per_second", run.particleStepsPerSecond()},
                 {"free", tally.free},
                 {"near", tally.near},
                 {"contacts", tally.contacts},
                 {"swept", tally.swept},
                 {"unresolved", tally.unresolved},
                 {"rejected", run.rejected},
                 {"deleted", run.deleted},
                 {"max_penetration", tally.maxPenetration},
                 {"energy_initial", run.energyInitial},
                 {"energy_final", run.energyFinal},
                 {"colliders", colliders},
                 {"files", run.files}};
    if (run.accuracy) {
        json["chosen"] = toJson(run.accuracy->chosen);
        json["measured_error_vx"] = run.accuracy->measuredErrorVx;
    }
    return json;
}

std::string toText(const RunReport& run)
{
    const StepTally& tally = run.tally;
    std::string text = grouped(run.particles) + " particles, " + std::to_string(run.frames) + " frames, " +
                       grouped(run.steps) + " steps in " + rounded(run.seconds) + " s (" +
                       rounded(run.particleStepsPerSecond() * 1e-6) + " million particle steps a second)\n";
    text += "particle steps: " + grouped(tally.free) + " free, " + grouped(tally.near) + " near, " +
            grouped(tally.contacts) + " in contact, " + grouped(tally.swept) + " swept, " + grouped(tally.unresolved) +
            " unresolved; " + grouped(run.rejected) + " particles rejected, " + grouped(run.deleted) + " deleted\n";
    text += "deepest penetration " + rounded(tally.maxPenetration) + "; energy " + rounded(run.energyInitial) + " to " +
            rounded(run.energyFinal);
    if (run.accuracy) {
        const FieldOptions& chosen = run.accuracy->chosen;
        text += std::string("\nchosen by max_error: ") + nameOf(chosen.lookup) + " lookup, " + nameOf(chosen.normal) +
                " normals, values kept as " + nameOf(chosen.storage) + "; measured error " +
                rounded(run.accuracy->measuredErrorVx) + " voxels";
    }
    if (!run.files.empty())
        text += "\nwrote " + std::to_string(run.files.size()) +
                (run.files.size() == 1 ? " file, " : " files, the last ") + run.files.back();
    return text;
}

} // namespace

void reportRun(const RunReport& run, const CommonOptions& common) { report(common, toJson(run), toText(run)); }

void reportExplanation(const Explanation& plan, const CommonOptions& common)
{
    const StepTally& tally = plan.trial.tally;
    std::string text;
    for (const std::string& line : plan.lines) text += (text.empty() ? "" : "\n") + line;
    Json json = {{"plan", plan.lines},
                 {"particles", plan.particles},
                 {"steps", plan.steps},
                 {"trial",
                  {{"particles", plan.trial.particles},
                   {"steps", plan.trial.steps},
                   {"free", tally.free},
                   {"near", tally.near},
                   {"contacts", tally.contacts},
                   {"swept", tally.swept},
                   {"ns_per_particle_step", plan.trial.nsPerParticleStep}}},
                 {"expected_seconds", nullptr},
                 {"expected_bytes", plan.bytes}};
    if (plan.seconds) json["expected_seconds"] = *plan.seconds;
    if (plan.accuracy) {
        json["chosen"] = toJson(plan.accuracy->chosen);
        json["measured_error_vx"] = plan.accuracy->measuredVx();
    }
    report(common, json, text);
}

} // namespace vdbounce::tool
