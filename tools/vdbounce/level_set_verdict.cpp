// SPDX-License-Identifier: Apache-2.0
#include "level_set_verdict.h"

#include "thin_report.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace vdbounce::tool {
namespace {

// Half a band of two voxels is the least that trilinear lookup with central differences at the surface needs; less what
// half floats lose.
constexpr double kThinnestBandVx = 2.0 - 1e-3;

// How much steeper than a distance a field may be before "distance" is the wrong word for it.
constexpr double kSteepest = 1.75; // the square root of three, and rounding

// From this median residual on half the band or more is off by a tenth at least, the radius of every particle with it.
constexpr double kNoDistance = EikonalResidual::kOff;

// A share of voxels that are off above this is more than what edges of small shapes cause.
constexpr double kOffShare = 0.1;

// A share of the surface in thin walls or gaps above which they are more than the tip of an ear or an edge here and
// there, of which a warning is enough.
constexpr double kThinShare = 0.05;

class Judge {
public:
    explicit Judge(const LevelSetSurvey& survey) : survey_(survey) {}

    Verdict judge()
    {
        if (survey_.range.notFinite > 0) {
            const Vec3i& voxel = survey_.range.firstNotFinite;
            add(Fitness::Unfit,
                counted(survey_.range.notFinite, "value") + " in it " + (survey_.range.notFinite == 1 ? "is" : "are") +
                    " not finite, the first at voxel (" + std::to_string(voxel.x()) + ", " + std::to_string(voxel.y()) +
                    ", " + std::to_string(voxel.z()) + ")",
                "write it again with the program that made it");
        } else if (survey_.summary.activeVoxels == 0) {
            add(Fitness::Unfit, "it is empty", kMakeAgain);
        } else if (!survey_.measures) {
            add(Fitness::Unfit, "large tiles of different values meet without a band between", kMakeAgain);
        } else {
            judgeSurface();
            judgeDistances();
            judgeBand();
            judgeShape();
        }
        std::stable_sort(verdict_.faults.begin(), verdict_.faults.end(), [](const Fault& a, const Fault& b) {
            return a.fitness == Fitness::Unfit && b.fitness != Fitness::Unfit;
        });
        return verdict_;
    }

private:
    static constexpr const char* kMakeAgain = "make it again from its mesh: vdbounce mesh2ls MESH -o OUT.vdb --dim 128";

    void add(Fitness fitness, const std::string& what, const std::string& remedy)
    {
        verdict_.faults.push_back({fitness, what, remedy});
    }

    void judgeSurface()
    {
        const LevelSetMeasures& m = *survey_.measures;
        if (!m.surface.pieces.empty()) return;
        if (m.clipped) {
            add(Fitness::Unfit, "all of its box is inside, and holds no surface",
                "give its box more room when making it");
        } else {
            add(Fitness::Unfit, "nothing in it is inside, so it has no surface", kMakeAgain);
        }
    }

    void judgeBand()
    {
        const Band& band = survey_.measures->band;
        const double voxel = survey_.transform.voxelSize().maxCoeff();
        const bool outside = band.exterior < kThinnestBandVx * voxel;
        const bool inside = !band.wholeInterior && band.interior < kThinnestBandVx * voxel;
        if (!outside && !inside) return;
        const double width = (outside ? band.exterior : band.interior) / voxel;
        add(Fitness::Unfit,
            "its band is only " + rounded(width) + " voxels wide " + (outside ? "outside" : "inside") +
                ", and lookups need 2",
            redistanceCommand(survey_.path, "--band 3vx"));
    }

    void judgeDistances()
    {
        const EikonalResidual& eikonal = survey_.measures->eikonal;
        if (eikonal.voxels > 0 && eikonal.median > kNoDistance) {
            add(Fitness::Unfit,
                "its values are no distances: |grad phi| is " + rounded(eikonal.slope) + " on average and should be 1",
                redistanceCommand(survey_.path));
            return;
        }
        if (eikonal.offShare() > kOffShare)
            add(Fitness::WithReservations,
                "its values are off from distances by a tenth or more in " + percentText(eikonal.offShare()) +
                    " of its voxels",
                redistanceCommand(survey_.path));
        // Where its box cuts it off, phi jumps to the background.
        if (!survey_.measures->clipped && survey_.measures->steepest > kSteepest)
            add(Fitness::WithReservations,
                "its values jump somewhere, by " + rounded(survey_.measures->steepest) +
                    " times as much as distances do",
                redistanceCommand(survey_.path));
    }

    void judgeShape()
    {
        const LevelSetMeasures& m = *survey_.measures;
        if (m.clipped && !m.surface.pieces.empty())
            add(Fitness::WithReservations, "only inside its box, whose sides cut its surface off",
                "keep particles in the box, or give it more room when making it");
        judgeThin(m.thin.walls, "walls", "particles may pass");
        judgeThin(m.thin.gaps, "gaps", "particles may not pass");
        if (survey_.gridClass != "level set")
            add(Fitness::WithReservations,
                "its class is '" + survey_.gridClass + "', which other programs take for no level set",
                redistanceCommand(survey_.path));
    }

    // A wall has two sides, and a voxel in its middle.
    void judgeThin(const ThinFeatures::Kind& kind, const std::string& name, const std::string& consequence)
    {
        const double voxel = survey_.transform.smallestVoxelSize();
        const double share = 2.0 * double(kind.voxels) * voxel * voxel / survey_.measures->surface.area;
        if (!(share > kThinShare)) return;
        const bool known = kind.thinnest > kEdgeVx * voxel;
        add(Fitness::WithReservations,
            percentText(std::min(share, 1.0)) + " of its surface are " + name +
                " about as thin as a voxel or thinner, and " + consequence,
            "make it again with smaller voxels, --voxel " +
                rounded(known ? kind.thinnest / kVoxelsAcross : 0.5 * voxel) + (known ? "" : " or less"));
    }

    const LevelSetSurvey& survey_;
    Verdict verdict_;
};

// As a shell takes it.
std::string quoted(const std::string& path)
{
    const bool plain = std::all_of(path.begin(), path.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || std::string("/._-+,=@%").find(char(c)) != std::string::npos;
    });
    if (plain) return path;
    std::string text = "'";
    for (char c : path) text += c == '\'' ? "'\\''" : std::string(1, c);
    return text + "'";
}

} // namespace

std::string Verdict::sentence() const
{
    if (faults.empty()) return "fit to collide with";
    const Fault& gravest = faults.front();
    return (gravest.fitness == Fitness::Unfit ? "not fit to collide with: " : "fit to collide with, but ") +
           gravest.what + "; " + gravest.remedy;
}

Verdict judge(const LevelSetSurvey& survey) { return Judge(survey).judge(); }

void addVerdict(const Verdict& verdict, Json& json)
{
    const Fitness fitness = verdict.fitness();
    json["fit"] = fitness == Fitness::Fit ? "yes" : fitness == Fitness::Unfit ? "no" : "with reservations";
    json["faults"] = Json::array();
    for (const Fault& fault : verdict.faults)
        json["faults"].push_back({{"what", fault.what}, {"remedy", fault.remedy}});
    json["verdict"] = verdict.sentence();
}

std::string percentText(double share)
{
    char text[32];
    std::snprintf(text, sizeof text, share < 0.995 ? "%.2g%%" : "%.0f%%", 100.0 * share);
    return text;
}

std::string redistanceCommand(const std::string& path, const std::string& options)
{
    return "vdbounce redistance " + quoted(path) + (options.empty() ? "" : " " + options) + " -o OUT.vdb";
}

} // namespace vdbounce::tool
