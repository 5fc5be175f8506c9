// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vdbounce::test {

/// What a browser takes for the run that a report page holds: the text up to the first end of a script.
inline std::string runInPage(const std::string& page)
{
    const std::string opening = R"(<script type="application/json" id="run">)";
    const std::size_t begin = page.find(opening) + opening.size();
    return page.substr(begin, page.find("</script", begin) - begin);
}

} // namespace vdbounce::test
