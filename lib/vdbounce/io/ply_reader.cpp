// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/ply_reader.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"

namespace vdbounce {
namespace {

struct TypeName {
    const char* name;
    PlyType type;
};
constexpr TypeName kTypeNames[] = {
    {"char", PlyType::Int8},      {"int8", PlyType::Int8},       {"uchar", PlyType::UInt8},
    {"uint8", PlyType::UInt8},    {"short", PlyType::Int16},     {"int16", PlyType::Int16},
    {"ushort", PlyType::UInt16},  {"uint16", PlyType::UInt16},   {"int", PlyType::Int32},
    {"int32", PlyType::Int32},    {"uint", PlyType::UInt32},     {"uint32", PlyType::UInt32},
    {"float", PlyType::Float32},  {"float32", PlyType::Float32}, {"double", PlyType::Float64},
    {"float64", PlyType::Float64}};

std::size_t sizeOf(PlyType type)
{
    switch (type) {
    case PlyType::Int8:
    case PlyType::UInt8: return 1;
    case PlyType::Int16:
    case PlyType::UInt16: return 2;
    case PlyType::Int32:
    case PlyType::UInt32:
    case PlyType::Float32: return 4;
    case PlyType::Float64: return 8;
    }
    return 0;
}

double loadAs(PlyType type, const char* bytes, ByteOrder order)
{
    switch (type) {
    case PlyType::Int8: return loadNumber<std::int8_t>(bytes, order);
    case PlyType::UInt8: return loadNumber<std::uint8_t>(bytes, order);
    case PlyType::Int16: return loadNumber<std::int16_t>(bytes, order);
    case PlyType::UInt16: return loadNumber<std::uint16_t>(bytes, order);
    case PlyType::Int32: return loadNumber<std::int32_t>(bytes, order);
    case PlyType::UInt32: return loadNumber<std::uint32_t>(bytes, order);
    case PlyType::Float32: return loadNumber<float>(bytes, order);
    case PlyType::Float64: return loadNumber<double>(bytes, order);
    }
    return 0.0;
}

PlyType requireType(const TextCursor& text, std::string_view name)
{
    for (const TypeName& known : kTypeNames) {
        if (name == known.name) return known.type;
    }
    text.fail("'" + std::string(name.substr(0, 40)) + "' is no PLY type",
              "use char, uchar, short, ushort, int, uint, float or double");
}

} // namespace

int PlyElement::find(const std::string& property) const
{
    for (std::size_t i = 0; i < properties.size(); ++i) {
        if (properties[i].name == property) return static_cast<int>(i);
    }
    return -1;
}

PlyReader::PlyReader(const std::string& path)
    : path_(path), bytes_(path), text_(path, bytes_.view(), TextCursor::Comments::None)
{
    readHeader();
}

void PlyReader::readHeader()
{
    if (text_.takeLine() != "ply") {
        throw InputError(path_ + ":1", "does not start with 'ply'", "name a PLY file");
    }
    bool haveFormat = false;
    for (;;) {
        if (text_.atEnd()) text_.fail("the file ends within its header", "the file is cut short; export it again");
        const std::string_view keyword = text_.tokenOnLine();
        if (keyword == "end_header") break;
        if (keyword == "format") {
            readFormat();
            haveFormat = true;
        } else if (keyword == "element") {
            readElementLine();
        } else if (keyword == "property") {
            readPropertyLine();
        } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
            text_.fail("'" + std::string(keyword.substr(0, 40)) + "' is no PLY header line", "export the file again");
        }
        text_.nextLine();
    }
    text_.nextLine();
    if (!haveFormat) text_.fail("the header names no format", "add 'format ascii 1.0' or export the file again");
    binary_ = text_.rest();
}

void PlyReader::readFormat()
{
    const std::string_view name = text_.tokenOnLine();
    if (name == "ascii") {
        format_ = Format::Text;
    } else if (name == "binary_little_endian") {
        format_ = Format::BinaryLittle;
    } else if (name == "binary_big_endian") {
        format_ = Format::BinaryBig;
    } else {
        text_.fail("'" + std::string(name.substr(0, 40)) + "' is no PLY format",
                   "use ascii, binary_little_endian or binary_big_endian");
    }
}

void PlyReader::readElementLine()
{
    PlyElement element;
    element.name = std::string(text_.tokenOnLine());
    const auto count = parseInteger(text_.tokenOnLine());
    if (element.name.empty() || !count || *count < 0)
        text_.fail("an element without name or count", "write 'element NAME COUNT'");
    element.count = static_cast<std::uint64_t>(*count);
    elements_.push_back(std::move(element));
}

void PlyReader::readPropertyLine()
{
    if (elements_.empty()) text_.fail("a property before any element", "export the file again");
    PlyProperty property;
    std::string_view type = text_.tokenOnLine();
    if (type == "list") {
        property.listCount = requireType(text_, text_.tokenOnLine());
        type = text_.tokenOnLine();
    }
    property.type = requireType(text_, type);
    property.name = std::string(text_.tokenOnLine());
    if (property.name.empty()) text_.fail("a property without a name", "write 'property TYPE NAME'");
    elements_.back().properties.push_back(std::move(property));
}

const PlyElement* PlyReader::nextElement()
{
    if (nextElement_ > 0) {
        while (rowsRead_ < elements_[nextElement_ - 1].count) readRow();
    }
    if (nextElement_ == elements_.size()) return nullptr;
    const PlyElement& element = elements_[nextElement_++];
    rowsRead_ = 0;
    values_.assign(element.properties.size(), 0.0);
    lists_.assign(element.properties.size(), {});
    if (element.properties.empty() && element.count > 0) {
        throw InputError(path_, "element '" + element.name + "' has no properties", "export the file again");
    }
    return &element;
}

std::string PlyReader::place() const
{
    if (format_ == Format::Text) return path_ + ":" + std::to_string(text_.line());
    return path_ + ": " + elements_[nextElement_ - 1].name + " " + std::to_string(rowsRead_ > 0 ? rowsRead_ - 1 : 0);
}

double PlyReader::readNumber(PlyType type)
{
    if (format_ == Format::Text) return text_.requireNumber("a value");
    const std::size_t bytes = sizeOf(type);
    if (binary_.size() < bytes) {
        throw InputError(place(), "the file ends before this row does",
                         "the file is cut short or its counts are too large; export it again");
    }
    const double value =
        loadAs(type, binary_.data(), format_ == Format::BinaryBig ? ByteOrder::Big : ByteOrder::Little);
    binary_.remove_prefix(bytes);
    return value;
}

void PlyReader::readList(const PlyProperty& property, std::vector<double>& entries)
{
    const double count = readNumber(*property.listCount);
    const std::size_t left = format_ == Format::Text ? text_.rest().size() + 1 : binary_.size();
    if (!(count >= 0.0) || count > static_cast<double>(left)) {
        throw InputError(place(), "a list of " + numberText(count) + " entries does not fit the file",
                         "export the file again");
    }
    entries.clear();
    for (double i = 0; i < count; ++i) entries.push_back(readNumber(property.type));
}

void PlyReader::readRow()
{
    ++rowsRead_;
    const PlyElement& element = elements_[nextElement_ - 1];
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.listCount) {
            readList(property, lists_[p]);
        } else {
            values_[p] = readNumber(property.type);
        }
    }
}

} // namespace vdbounce
