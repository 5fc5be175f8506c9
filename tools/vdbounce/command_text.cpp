// SPDX-License-Identifier: Apache-2.0
#include "command_text.h"

#include <algorithm>
#include <cctype>

namespace vdbounce::tool {
namespace {

bool isPlain(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string("_./+-,:=@%").find(c) != std::string::npos;
}

std::string quoted(const std::string& word)
{
    if (!word.empty() && std::all_of(word.begin(), word.end(), isPlain)) return word;
    std::string text = "'";
    for (const char c : word) {
        if (c == '\'') {
            text += "'\\''";
        } else {
            text += c;
        }
    }
    return text + "'";
}

} // namespace

void CommandText::add(const std::vector<std::string>& words)
{
    for (const std::string& word : words) text_ += " " + quoted(word);
}

} // namespace vdbounce::tool
