// SPDX-License-Identifier: Apache-2.0
#include "report/sample_run.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <random>

namespace vdbounce::test {
namespace {

using Json = nlohmann::ordered_json;

const double kVoxels[] = {0.4, 0.2, 0.1, 0.05, 0.025};

// Rises and falls as measured figures do; the same for each run of the test.
class Noise {
public:
    double operator()() { return std::exp(std::normal_distribution<double>(0.0, 0.12)(engine_)); }

private:
    std::mt19937 engine_{7};
};

struct Choice {
    const char* name;
    double cost;
    double error;
};

const Choice kLookups[] = {{"nearest", 0.5, 8.0}, {"trilinear", 1.0, 1.0}, {"cubic", 3.2, 0.06}};
const Choice kNormals[] = {{"central", 1.0, 1.0}, {"analytic", 0.8, 1.6}};
const Choice kStorages[] = {{"float", 1.0, 0.0}, {"half", 0.9, 0.0004}, {"fixed8", 0.85, 0.004}};
const Choice kSchemes[] = {{"once", 0.7, 6.0}, {"iterate", 1.0, 2.0}, {"collide-contact", 1.3, 0.6}};
const Choice kSweeps[] = {{"never", 1.0, 1.0}, {"always", 1.9, 0.02}};

void setCost(Json& one, double nanoseconds, double voxel, double bytesPerVoxel, Noise& noise)
{
    const double voxels = 3e3 / (voxel * voxel);
    one["value"] = nanoseconds;
    one["cost"] = {{"ns_per_particle_step", nanoseconds},
                   {"build_seconds", 2e-7 * voxels * noise()},
                   {"bytes", std::round(voxels * bytesPerVoxel)}};
    one["spread"] = {{"ns_per_particle_step", {nanoseconds * 0.96, nanoseconds * 1.07}}};
}

Json lookupCase(const std::string& group, double voxel, const Choice& lookup, const Choice& normal,
                const Choice& storage, Noise& noise)
{
    Json one = {{"name", group + ", voxel " + std::to_string(voxel)}, {"unit", "ns"}, {"group", group}};
    one["settings"] = {{"voxel", voxel},          {"lookup", lookup.name}, {"normal", normal.name},
                       {"storage", storage.name}, {"scheme", nullptr},     {"sweep", nullptr}};
    setCost(one, 14 * lookup.cost * normal.cost * storage.cost * std::pow(voxel, -0.25) * noise(), voxel,
            std::string(storage.name) == "float"  ? 10.4
            : std::string(storage.name) == "half" ? 5.2
                                                  : 2.6,
            noise);
    const double mean = (0.02 * voxel * lookup.error + storage.error) * noise();
    const double angle = 4.0 * voxel * (0.3 + lookup.error) * normal.error * noise();
    one["error"] = {{"phi_mean_vx", mean},      {"phi_p99_vx", 3.1 * mean},      {"phi_max_vx", 6.4 * mean},
                    {"phi_mean", mean * voxel}, {"phi_p99", 3.1 * mean * voxel}, {"phi_max", 6.4 * mean * voxel},
                    {"normal_mean_deg", angle}, {"normal_max_deg", 9 * angle}};
    return one;
}

Json stepCase(double voxel, const Choice& scheme, const Choice& sweep, double dt, Noise& noise)
{
    Json one = {{"name", "sphere, steps of " + std::to_string(dt)}, {"unit", "ns"}, {"group", "sphere, steps"}};
    one["settings"] = {
        {"voxel", voxel}, {"lookup", "trilinear"}, {"scheme", scheme.name}, {"sweep", sweep.name}, {"dt", dt}};
    setCost(one, 40 * scheme.cost * sweep.cost * std::pow(voxel, -0.2) * std::pow(dt / 0.008, -0.1) * noise(), voxel,
            10.4, noise);
    const double error = dt * 100 * scheme.error * sweep.error * noise();
    const bool never = std::string(sweep.name) == "never";
    one["error"] = {{"time_of_impact_s", error * 0.004},
                    {"place_of_impact_vx", (0.01 + error) * 0.1 / voxel},
                    {"penetration_vx", never ? Json(error * 0.4) : Json(0.0)},
                    {"energy_drift", -0.002 * error},
                    {"sliding_distance_relative", dt > 0.03 ? Json(nullptr) : Json(0.01 * error)}};
    return one;
}

Json ratioCase(const std::string& name, double value, const char* peer, double ratio)
{
    return {{"name", name},   {"unit", "ns/particle step"},
            {"value", value}, {"peer", {{"name", peer}, {"value", value * ratio}}},
            {"ratio", ratio}, {"kind", "collide"}};
}

// Far ahead, ahead, alike, behind, and two that have no ratio.
void addRatios(Json& cases)
{
    const double ratios[] = {2e5, 14.2, 1.5, 1.004, 0.8, 0.05};
    for (const char* threads : {"1 thread", "2 threads"}) {
        int i = 0;
        for (const double ratio : ratios) {
            const std::string name = "box " + std::to_string(++i) + ", " + threads;
            cases.push_back(ratioCase(name, 3.0 * i, "NanoVDB's example", ratio));
            if (i < 5) cases.push_back(ratioCase(name, 3.0 * i, "gravity, <b>nothing</b> else", 0.9 * ratio));
        }
        cases.push_back(ratioCase("box of nothing, " + std::string(threads), 0.0, "NanoVDB's example", 1.0));
        cases.back()["ratio"] = nullptr;
        cases.push_back({{"name", "steps with contact"}, {"unit", "%"}, {"value", 4.5}, {"kind", "collide"}});
    }
    cases.push_back({{"name", "triangles"}, {"unit", "triangles"}, {"value", 3674.0}});
    cases.push_back({{"name", "mesh"}, {"unit", "MB"}, {"value", 0.088}});
}

} // namespace

std::string sampleRun()
{
    Noise noise;
    Json cases = Json::array();
    for (const char* group : {"sphere, lookups", "torus, lookups"})
        for (const double voxel : kVoxels)
            for (const Choice& lookup : kLookups)
                for (const Choice& normal : kNormals)
                    for (const Choice& storage : kStorages)
                        cases.push_back(lookupCase(group, voxel, lookup, normal, storage, noise));
    for (const double voxel : {0.2, 0.1, 0.05, 0.025})
        for (const Choice& scheme : kSchemes)
            for (const Choice& sweep : kSweeps)
                for (const double dt : {0.002, 0.004, 0.008, 0.016, 0.032})
                    cases.push_back(stepCase(voxel, scheme, sweep, dt, noise));
    addRatios(cases);
    cases[0]["name"] = "</script><script>throw 1</script><!-- <script>";
    const Json run = {{"machine", "A processor <b>of & many</b> names, 2 threads, AVX3"}, {"cases", cases}};
    return run.dump();
}

} // namespace vdbounce::test
