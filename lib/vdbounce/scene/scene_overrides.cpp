// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/scene_overrides.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"

#include <vector>

namespace vdbounce {
namespace {

std::vector<std::string> splitAtDots(const std::string& key)
{
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (;;) {
        const std::size_t dot = key.find('.', begin);
        parts.push_back(key.substr(begin, dot - begin));
        if (dot == std::string::npos) return parts;
        begin = dot + 1;
    }
}

toml::table* findInArray(toml::array& array, const std::string& name)
{
    for (std::size_t i = 0; i < array.size(); ++i) {
        toml::table* entry = array[i].as_table();
        if (entry == nullptr) continue;
        if ((*entry)["name"].value<std::string>() == name || std::to_string(i) == name) return entry;
    }
    return nullptr;
}

void setValue(toml::table& table, const std::string& key, const std::string& value)
{
    try {
        const toml::table parsed = toml::parse("value = " + value);
        table.insert_or_assign(key, *parsed.get("value"));
    } catch (const toml::parse_error&) {
        table.insert_or_assign(key, value);
    }
}

} // namespace

void applyOverride(toml::table& scene, const std::string& override)
{
    const std::string where = "--set " + override;
    const std::size_t equals = override.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError(where, "is not KEY=VALUE", "write for example --set time.dt=0.002");
    const std::vector<std::string> parts = splitAtDots(override.substr(0, equals));

    toml::table* table = &scene;
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        toml::node* next = table->get(parts[i]);
        if (next == nullptr) next = &table->insert(parts[i], toml::table{}).first->second;
        if (toml::array* array = next->as_array(); array != nullptr && i + 2 < parts.size()) {
            table = findInArray(*array, parts[++i]);
        } else {
            table = next->as_table();
        }
        if (table == nullptr)
            throw UsageError(where, "there is no '" + parts[i] + "' in the scene", "name a key as the scene file does");
    }
    setValue(*table, parts.back(), override.substr(equals + 1));
}

} // namespace vdbounce
