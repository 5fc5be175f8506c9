// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

/// @file
/// The kinds of failure that the library reports by exception.
///
/// Every message has three parts, so that one line is enough for the reader: where it happened (file and
/// place, option, scene key), what is wrong (with the value), and what to do about it.
/// Outcomes that are expected while running (a particle that cannot be resolved) are counters, not errors.

namespace vdbounce {

/// Base of all errors of the library. `what()` is "WHERE: WHAT; REMEDY".
class Error : public std::runtime_error {
public:
    /// The tool's exit code for an error of this kind, as the command-line contract lists them.
    int exitCode() const { return exitCode_; }

protected:
    Error(int exitCode, const std::string& where, const std::string& what, const std::string& remedy);

private:
    int exitCode_;
};

/// Something failed while running that the input is not to blame for: a full disk, a refused permission.
class RunError : public Error {
public:
    RunError(const std::string& where, const std::string& what, const std::string& remedy);
};

/// The caller asked for something that cannot be asked for: an option out of range, two that exclude each other.
class UsageError : public Error {
public:
    UsageError(const std::string& where, const std::string& what, const std::string& remedy);
};

/// A file or a value in it is not what it must be.
class InputError : public Error {
public:
    InputError(const std::string& where, const std::string& what, const std::string& remedy);
};

/// A tolerance that the caller set was not met.
class ToleranceError : public Error {
public:
    ToleranceError(const std::string& where, const std::string& what, const std::string& remedy);
};

/// The user asked to stop; thrown at the next point where work can be dropped without harm.
class Interrupted : public Error {
public:
    Interrupted();
};

} // namespace vdbounce
