// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/length.h"
#include "vdbounce/base/vector.h"

#include <Eigen/Geometry>
#include <toml++/toml.h>

#include <string>
#include <vector>

namespace vdbounce {

/// Reads one table of a scene file: each key that is asked for is checked for its type, and finish() refuses those that
/// nobody asked for. All errors are InputErrors that name file, line and key.
class SceneTable {
public:
    /// `name` is the table's place in the scene, "contact" or "collider 'bunny'".
    SceneTable(const std::string& file, std::string name, const toml::table& table);

    bool has(const char* key) const { return table_.contains(key); }

    // Each returns the value, or `otherwise` where the key is left out.
    double number(const char* key, double otherwise);
    int integer(const char* key, int otherwise);
    bool boolean(const char* key, bool otherwise);
    std::string text(const char* key, const std::string& otherwise);
    Vec3d vector(const char* key, const Vec3d& otherwise);
    /// Four numbers, w x y z.
    Eigen::Quaterniond quaternion(const char* key, const Eigen::Quaterniond& otherwise);
    Length length(const char* key, const Length& otherwise);
    /// One of `choices`; returns its position.
    std::size_t choice(const char* key, const std::vector<std::string>& choices, std::size_t otherwise);
    /// A list of texts; none where the key is left out.
    std::vector<std::string> texts(const char* key);
    /// A table within this one; an empty one where the key is left out.
    SceneTable table(const char* key);

    /// A list of tables within this one.
    std::vector<SceneTable> tables(const char* key);

    /// Refuses a table that lacks this key.
    void require(const char* key) const;

    /// Notes a key that is read by other means.
    void markKnown(const char* key) { known_.emplace_back(key); }

    /// Refuses keys that were not asked for.
    void finish() const;

    [[noreturn]] void fail(const char* key, const std::string& what, const std::string& remedy) const;
    const std::string& name() const { return name_; }

private:
    const toml::node* find(const char* key);
    void readNumbers(const toml::node& node, const char* key, double* numbers, std::size_t count,
                     const char* expected) const;
    [[noreturn]] void failType(const char* key, const char* expected) const;
    std::string place(const toml::node* node) const;

    std::string file_;
    std::string name_;
    const toml::table& table_;
    std::vector<std::string> known_;
};

} // namespace vdbounce
