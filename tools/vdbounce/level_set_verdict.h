// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "level_set_survey.h"
#include "report.h"

#include <string>
#include <vector>

namespace vdbounce::tool {

enum class Fitness {
    Fit,
    WithReservations, ///< collisions work, but somewhere not as the shape has it
    Unfit,            ///< collisions would be wrong everywhere
};

/// Something that is wrong with a level set, and what to do about it.
struct Fault {
    Fitness fitness;
    std::string what;   ///< "its band is 1.5 voxels wide, lookups need 2"
    std::string remedy; ///< a command, or what to do in words
};

/// Whether a level set is fit to collide with.
struct Verdict {
    std::vector<Fault> faults; ///< the gravest first

    Fitness fitness() const { return faults.empty() ? Fitness::Fit : faults.front().fitness; }

    /// "fit to collide with", "not fit to collide with: WHAT; REMEDY", and with reservations "fit to collide with, but
    /// WHAT; REMEDY", for the gravest fault.
    std::string sentence() const;
};

Verdict judge(const LevelSetSurvey& survey);

/// {verdict, fit ("yes", "with reservations", "no"), faults: [{what, remedy}]} are added to `json`.
void addVerdict(const Verdict& verdict, Json& json);

/// "12%", two digits, of a share between 0 and 1.
std::string percentText(double share);

/// The verb that restores distances in the file `path`, with further options.
std::string redistanceCommand(const std::string& path, const std::string& options = "");

} // namespace vdbounce::tool
