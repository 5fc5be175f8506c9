// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vdbounce {

/// The start of `token` in quotes, for an error message: readable whatever the file holds.
std::string quotedText(std::string_view token);

/// Walks through a text file token by token, counts lines, and reports what it does not understand as an
/// InputError that names file and line. Tokens are separated by blanks; '#' starts a comment where `comments` says.
class TextCursor {
public:
    enum class Comments { None, Hash };

    TextCursor(std::string file, std::string_view text, Comments comments);

    bool atEnd() const { return rest_.empty(); }
    std::size_t line() const { return line_; }

    /// Skips blanks, comments and line ends; false at the end of the text.
    bool skipToToken();

    /// The next token on this line, or an empty view at the line's end. A backslash before the line's end continues it.
    std::string_view tokenOnLine();

    /// Moves to the start of the next line.
    void nextLine();

    /// What is left of the current line, without its end, then moves to the next.
    std::string_view takeLine();

    /// The next token anywhere, as a number; throws when there is none or it is not one. `what` names it in the error.
    double requireNumber(const char* what);
    std::int64_t requireInteger(const char* what);

    /// Throws an InputError at the current line.
    [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;

    /// The unread bytes.
    std::string_view rest() const { return rest_; }

private:
    std::string_view requireToken(const char* what);

    std::string file_;
    std::string_view rest_;
    Comments comments_;
    std::size_t line_ = 1;
};

} // namespace vdbounce
