// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/scene_table.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace vdbounce {
namespace {

const toml::table kEmptyTable;

std::string valueText(const toml::node& node)
{
    std::ostringstream text;
    node.visit([&](const auto& value) { text << value; });
    return text.str();
}

std::string listed(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

} // namespace

SceneTable::SceneTable(const std::string& file, std::string name, const toml::table& table)
    : file_(file), name_(std::move(name)), table_(table)
{
}

std::string SceneTable::place(const toml::node* node) const
{
    // Values that the command line set have no line.
    if (node == nullptr || node->source().begin.line == 0) return file_;
    return file_ + ":" + std::to_string(node->source().begin.line);
}

const toml::node* SceneTable::find(const char* key)
{
    known_.emplace_back(key);
    return table_.get(key);
}

void SceneTable::fail(const char* key, const std::string& what, const std::string& remedy) const
{
    const toml::node* node = table_.get(key);
    const std::string full = name_.empty() ? key : name_ + "." + key;
    throw InputError(place(node != nullptr ? node : &table_), full + " " + what, remedy);
}

void SceneTable::failType(const char* key, const char* expected) const
{
    fail(key, "= " + valueText(*table_.get(key)) + " is not " + expected, std::string("give ") + expected);
}

double SceneTable::number(const char* key, double otherwise)
{
    const toml::node* node = find(key);
    if (node == nullptr) return otherwise;
    if (!node->is_number()) failType(key, "a number");
    return *node->value<double>();
}

int SceneTable::integer(const char* key, int otherwise)
{
    const toml::node* node = find(key);
    if (node == nullptr) return otherwise;
    if (!node->is_integer()) failType(key, "a whole number");
    const std::int64_t value = *node->value<std::int64_t>();
    if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
        failType(key, "a whole number of 32 bits");
    return static_cast<int>(value);
}

bool SceneTable::boolean(const char* key, bool otherwise)
{
    const toml::node* node = find(key);
    if (node == nullptr) return otherwise;
    if (!node->is_boolean()) failType(key, "true or false");
    return *node->value<bool>();
}

std::string SceneTable::text(const char* key, const std::string& otherwise)
{
    const toml::node* node = find(key);
    if (node == nullptr) return otherwise;
    if (!node->is_string()) failType(key, "a text in quotes");
    return *node->value<std::string>();
}

void SceneTable::readNumbers(const toml::node& node, const char* key, double* numbers, std::size_t count,
                             const char* expected) const
{
    const toml::array* array = node.as_array();
    if (array == nullptr || array->size() != count) failType(key, expected);
    for (std::size_t i = 0; i < count; ++i) {
        const toml::node& entry = (*array)[i];
        if (!entry.is_number()) failType(key, expected);
        numbers[i] = *entry.value<double>();
    }
}

Vec3d SceneTable::vector(const char* key, const Vec3d& otherwise)
{
    const toml::node* node = find(key);
    if (node == nullptr) return otherwise;
    Vec3d vector;
    readNumbers(*node, key, vector.data(), 3, "a list of three numbers");
    return vector;
}

Eigen::Quaterniond SceneTable::quaternion(const char* key, const Eigen::Quaterniond& otherwise)
{
    const toml::node* node = find(key);
    if (node == nullptr) return otherwise;
    double wxyz[4];
    readNumbers(*node, key, wxyz, 4, "a list of four numbers, w, x, y, z");
    return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
}

Length SceneTable::length(const char* key, const Length& otherwise)
{
    const toml::node* node = find(key);
    if (node == nullptr) return otherwise;
    if (node->is_number()) return {*node->value<double>(), false};
    if (node->is_string()) {
        if (const auto length = parseLength(*node->value<std::string>())) return *length;
    }
    failType(key, "a length such as 0.1 or \"2vx\"");
}

std::size_t SceneTable::choice(const char* key, const std::vector<std::string>& choices, std::size_t otherwise)
{
    const toml::node* node = find(key);
    if (node == nullptr) return otherwise;
    const auto word = node->value_exact<std::string>();
    const auto found = word ? std::find(choices.begin(), choices.end(), *word) : choices.end();
    if (found == choices.end())
        fail(key, "= " + valueText(*node) + " is not a choice", "use one of: " + listed(choices));
    return static_cast<std::size_t>(found - choices.begin());
}

std::vector<std::string> SceneTable::texts(const char* key)
{
    const toml::node* node = find(key);
    std::vector<std::string> texts;
    if (node == nullptr) return texts;
    const toml::array* array = node->as_array();
    if (array == nullptr) failType(key, "a list of texts");
    for (const toml::node& entry : *array) {
        if (!entry.is_string()) failType(key, "a list of texts");
        texts.push_back(*entry.value<std::string>());
    }
    return texts;
}

SceneTable SceneTable::table(const char* key)
{
    const std::string full = name_.empty() ? key : name_ + "." + key;
    const toml::node* node = find(key);
    if (node == nullptr) return SceneTable(file_, full, kEmptyTable);
    const toml::table* inner = node->as_table();
    if (inner == nullptr) failType(key, "a table");
    return SceneTable(file_, full, *inner);
}

std::vector<SceneTable> SceneTable::tables(const char* key)
{
    const toml::node* node = find(key);
    std::vector<SceneTable> tables;
    if (node == nullptr) return tables;
    const toml::array* array = node->as_array();
    if (array == nullptr) failType(key, "a list of tables");
    for (std::size_t i = 0; i < array->size(); ++i) {
        const toml::table* entry = (*array)[i].as_table();
        if (entry == nullptr) failType(key, "a list of tables");
        tables.emplace_back(file_, (name_.empty() ? "" : name_ + ".") + key + "[" + std::to_string(i) + "]", *entry);
    }
    return tables;
}

void SceneTable::require(const char* key) const
{
    if (!has(key)) fail(key, "is missing", std::string("give ") + key);
}

void SceneTable::finish() const
{
    for (const auto& [key, node] : table_) {
        if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
        const std::string full = name_.empty() ? std::string(key.str()) : name_ + "." + std::string(key.str());
        throw InputError(place(&node), "unknown key '" + full + "'", "the keys here are: " + listed(known_));
    }
}

} // namespace vdbounce
