// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace vdbounce {

/// How inside is told from outside.
enum class SignMethod {
    Auto,     ///< chooses for each connected component; see chooseSigns()
    Winding,  ///< inside where the mesh winds around a point more than half, in either direction
    Parity,   ///< inside where rays cross the mesh an odd number of times; does not need consistent faces
    Flood,    ///< outside is what can be reached from far away, so cavities are filled
    Unsigned, ///< no inside: the mesh becomes a sheet of the stated thickness
};

/// The method's name on the command line and in JSON: "auto", "winding", "parity", "flood", "unsigned".
const char* signMethodName(SignMethod method);

/// What was chosen for a part of the mesh, and why.
struct SignChoice {
    SignMethod method = SignMethod::Winding;
    std::size_t components = 0;
    std::size_t triangles = 0;
    std::string reason; ///< "closed", "its holes are small", ...
    bool plain = false; ///< closed, and its faces agree as they are: there was nothing to choose
};

} // namespace vdbounce
