// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/error.h"

namespace vdbounce {
namespace {

// The exit codes of the command-line contract.
constexpr int kExitRunFailed = 1;
constexpr int kExitUsage = 2;
constexpr int kExitInput = 3;
constexpr int kExitTolerance = 4;
constexpr int kExitInterrupted = 130; // 128 + SIGINT, as shells report it

} // namespace

Error::Error(int exitCode, const std::string& where, const std::string& what, const std::string& remedy)
    : std::runtime_error(where + ": " + what + "; " + remedy), exitCode_(exitCode)
{
}

RunError::RunError(const std::string& where, const std::string& what, const std::string& remedy)
    : Error(kExitRunFailed, where, what, remedy)
{
}

UsageError::UsageError(const std::string& where, const std::string& what, const std::string& remedy)
    : Error(kExitUsage, where, what, remedy)
{
}

InputError::InputError(const std::string& where, const std::string& what, const std::string& remedy)
    : Error(kExitInput, where, what, remedy)
{
}

ToleranceError::ToleranceError(const std::string& where, const std::string& what, const std::string& remedy)
    : Error(kExitTolerance, where, what, remedy)
{
}

Interrupted::Interrupted()
    : Error(kExitInterrupted, "interrupted", "stopped on request", "run the command again to start over")
{
}

} // namespace vdbounce
