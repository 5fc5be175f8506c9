// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/byte_order.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/text_cursor.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vdbounce {

enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;
    std::optional<PlyType> listCount; ///< set for a list: the type of its length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Position of the property of that name, or -1.
    int find(const std::string& property) const;
};

/// Reads PLY files, text or binary of either byte order, element by element in the file's order. Every error is an
/// InputError that names the file and the line (text, header) or the element and row (binary).
///
///     PlyReader ply("cloud.ply");
///     while (const PlyElement* element = ply.nextElement())
///         for (std::uint64_t row = 0; row < element->count; ++row) { ply.readRow(); ply.value(0); }
///
/// Rows that are not read are passed over by nextElement().
class PlyReader {
public:
    explicit PlyReader(const std::string& path);

    /// Moves to the next element; null after the last.
    const PlyElement* nextElement();

    /// Reads the next row of the current element.
    void readRow();

    /// The value of a scalar property in the row just read; exact for every PLY type.
    double value(int property) const { return values_[static_cast<std::size_t>(property)]; }

    /// The entries of a list property in the row just read.
    const std::vector<double>& list(int property) const { return lists_[static_cast<std::size_t>(property)]; }

    /// The place of the row just read, for errors: file and line, or file, element and row.
    std::string place() const;

private:
    enum class Format { Text, BinaryLittle, BinaryBig };

    void readHeader();
    void readFormat();
    void readElementLine();
    void readPropertyLine();
    double readNumber(PlyType type);
    void readList(const PlyProperty& property, std::vector<double>& entries);

    std::string path_;
    FileBytes bytes_;
    TextCursor text_;
    Format format_ = Format::Text;
    std::vector<PlyElement> elements_;
    std::size_t nextElement_ = 0;
    std::uint64_t rowsRead_ = 0;
    std::string_view binary_;
    std::vector<double> values_;
    std::vector<std::vector<double>> lists_;
};

} // namespace vdbounce
