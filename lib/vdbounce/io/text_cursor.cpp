// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/text_cursor.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"

#include <cctype>

namespace vdbounce {
namespace {

// Text quoted in an error stays readable whatever the file holds.
constexpr std::size_t kQuotedCharacters = 40;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

} // namespace

std::string quotedText(std::string_view token)
{
    std::string text = "'";
    for (char c : token.substr(0, kQuotedCharacters))
        text += (std::isprint(static_cast<unsigned char>(c)) != 0) ? c : '?';
    return text + (token.size() > kQuotedCharacters ? "...'" : "'");
}

TextCursor::TextCursor(std::string file, std::string_view text, Comments comments)
    : file_(std::move(file)), rest_(text), comments_(comments)
{
}

void TextCursor::fail(const std::string& what, const std::string& remedy) const
{
    throw InputError(file_ + ":" + std::to_string(line_), what, remedy);
}

std::string_view TextCursor::tokenOnLine()
{
    std::size_t i = 0;
    while (i < rest_.size()) {
        if (isBlank(rest_[i])) {
            ++i;
        } else if (rest_[i] == '\\') {
            std::size_t j = i + 1;
            while (j < rest_.size() && rest_[j] == '\r') ++j;
            if (j >= rest_.size() || rest_[j] != '\n') break;
            ++line_;
            i = j + 1;
        } else {
            break;
        }
    }
    rest_.remove_prefix(i);
    if (rest_.empty() || rest_[0] == '\n' || (comments_ == Comments::Hash && rest_[0] == '#')) return {};
    std::size_t length = 1;
    while (length < rest_.size() && !isBlank(rest_[length]) && rest_[length] != '\n') ++length;
    const std::string_view token = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return token;
}

void TextCursor::nextLine() { takeLine(); }

std::string_view TextCursor::takeLine()
{
    const std::size_t end = rest_.find('\n');
    std::string_view text = rest_.substr(0, end);
    if (end == std::string_view::npos) {
        rest_ = {};
    } else {
        rest_.remove_prefix(end + 1);
        ++line_;
    }
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
}

bool TextCursor::skipToToken()
{
    while (!rest_.empty()) {
        if (rest_[0] == '\n') {
            ++line_;
            rest_.remove_prefix(1);
        } else if (isBlank(rest_[0])) {
            rest_.remove_prefix(1);
        } else if (comments_ == Comments::Hash && rest_[0] == '#') {
            nextLine();
        } else {
            return true;
        }
    }
    return false;
}

std::string_view TextCursor::requireToken(const char* what)
{
    if (!skipToToken()) {
        fail(std::string("the file ends where ") + what + " is expected",
             "the file is cut short or its counts are too large; export it again");
    }
    return tokenOnLine();
}

double TextCursor::requireNumber(const char* what)
{
    const std::string_view token = requireToken(what);
    const auto value = parseDouble(token);
    if (!value)
        fail(quotedText(token) + " is not a number where " + what + " is expected",
             "correct the file or export it again");
    return *value;
}

std::int64_t TextCursor::requireInteger(const char* what)
{
    const std::string_view token = requireToken(what);
    const auto value = parseInteger(token);
    if (!value) {
        fail(quotedText(token) + " is not a whole number where " + what + " is expected",
             "correct the file or export it again");
    }
    return *value;
}

} // namespace vdbounce
