// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/frames/read_frames.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <pugixml.hpp>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/frames/base64.hpp"

namespace crackle {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the little-endian numbers of VTK files are read without conversion");

using Bytes = std::vector<unsigned char>;

std::uint64_t word_at(const Bytes& bytes, std::size_t index) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + 8 * index, 8);
    return word;
}

/// Decodes the format of vtkZLibDataCompressor. It is the base64 text of {number of blocks, block size, size of a
/// shorter last block, compressed sizes...}, followed by the base64 text of the blocks.
class ArrayReader {
  public:
    ArrayReader(const std::filesystem::path& in_file, const pugi::xml_node& array)
        : file(in_file), name(array.attribute("Name").value()), text(array.child_value()) {
        const auto is_space = [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; };
        std::erase_if(text, is_space);
        if (std::string_view(array.attribute("format").value()) != "binary") {
            refuse_frame(file, fmt::format("array '{}': found format '{}', expected 'binary'", name,
                                           array.attribute("format").value()));
        }
    }

    Bytes read() const {
        if (text.empty()) return {};
        const std::uint64_t blocks = word_at(decode(0, 32, 24), 0);
        if (blocks == 0) return {};
        if (blocks > text.size())
            refuse_frame(file,
                         fmt::format("array '{}': found a header with {} blocks, more than its {} characters can hold",
                                     name, blocks, text.size()));
        const std::size_t header_bytes = 8 * (3 + static_cast<std::size_t>(blocks));
        const std::size_t header_letters = (header_bytes + 2) / 3 * 4;
        const Bytes header = decode(0, header_letters, header_bytes);
        const Bytes packed = decode(header_letters, std::string::npos, 0);

        Bytes values;
        std::size_t at = 0;
        for (std::size_t block = 0; block < blocks; ++block) {
            const bool shorter = block + 1 == blocks && word_at(header, 2) != 0;
            const std::uint64_t size = word_at(header, shorter ? 2 : 1);
            const std::uint64_t packed_size = word_at(header, 3 + block);
            // zlib compresses by a factor of at most about 1000, so a larger size indicates damage.
            if (packed_size > packed.size() - at || size > 1100 * packed_size) {
                refuse_frame(file, fmt::format("array '{}': found block sizes that its {} bytes of data cannot hold",
                                               name, packed.size()));
            }
            const std::size_t begin = values.size();
            values.resize(begin + static_cast<std::size_t>(size));
            auto got = static_cast<uLongf>(size);
            const int status =
                uncompress(values.data() + begin, &got, packed.data() + at, static_cast<uLong>(packed_size));
            if (status != Z_OK || got != size)
                refuse_frame(file, fmt::format("array '{}': its zlib data are damaged", name));
            at += static_cast<std::size_t>(packed_size);
        }
        return values;
    }

  private:
    Bytes decode(std::size_t begin, std::size_t count, std::size_t expected_bytes) const {
        if (begin > text.size()) refuse_frame(file, fmt::format("array '{}': ends early", name));
        const std::optional<Bytes> bytes = decode_base64(std::string_view(text).substr(begin, count));
        if (!bytes || bytes->size() < expected_bytes)
            refuse_frame(file, fmt::format("array '{}': found text that is not base64", name));
        return *bytes;
    }

    const std::filesystem::path& file;
    std::string name;
    std::string text;
};

template <class T>
std::vector<double> as_doubles(const Bytes& bytes) {
    std::vector<double> values(bytes.size() / sizeof(T));
    for (std::size_t i = 0; i < values.size(); ++i) {
        T value;
        std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
        values[i] = static_cast<double>(value);
    }
    return values;
}

std::vector<double> read_array(const std::filesystem::path& file, const pugi::xml_node& array) {
    const std::string_view type = array.attribute("type").value();
    const Bytes bytes = ArrayReader(file, array).read();
    if (type == "Float64") return as_doubles<double>(bytes);
    if (type == "Float32") return as_doubles<float>(bytes);
    if (type == "Int64") return as_doubles<std::int64_t>(bytes);
    if (type == "Int32") return as_doubles<std::int32_t>(bytes);
    if (type == "UInt8") return as_doubles<std::uint8_t>(bytes);
    if (type == "Int8") return as_doubles<std::int8_t>(bytes);
    refuse_frame(file,
                 fmt::format("array '{}': found type '{}', expected Float64, Float32, Int64, Int32, Int8 or UInt8",
                             array.attribute("Name").value(), type));
}

pugi::xml_node array_named(const pugi::xml_node& parent, const char* name) {
    return parent.find_child_by_attribute("DataArray", "Name", name);
}

pugi::xml_document load(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
    if (!result)
        refuse_frame(file, fmt::format("found malformed XML ({} at byte {})", result.description(), result.offset));
    return document;
}

void append_cells(const std::filesystem::path& file, const pugi::xml_node& list, bool line, PolyData& data) {
    const pugi::xml_node offsets_array = array_named(list, "offsets");
    if (!offsets_array) return;
    const std::vector<double> offsets = read_array(file, offsets_array);
    const std::vector<double> connectivity = read_array(file, array_named(list, "connectivity"));
    double begin = 0;
    for (const double end : offsets) {
        if (!(end >= begin && end <= static_cast<double>(connectivity.size())))
            refuse_frame(file, "found cell offsets that decrease, or exceed the length of the connectivity array");
        PolyData::Cell cell{line, {}};
        for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
            if (!(connectivity[k] >= 0 && connectivity[k] < static_cast<double>(data.points.size()))) {
                refuse_frame(file, fmt::format("found a cell with point {}, expected points 0 to {}", connectivity[k],
                                               static_cast<double>(data.points.size()) - 1));
            }
            cell.points.push_back(static_cast<std::size_t>(connectivity[k]));
        }
        data.cells.push_back(std::move(cell));
        begin = end;
    }
}

std::map<std::string, double> field_values_of(const std::filesystem::path& file, const pugi::xml_node& fields) {
    std::map<std::string, double> all;
    for (const pugi::xml_node array : fields.children("DataArray")) {
        const std::vector<double> values = read_array(file, array);
        if (values.size() == 1) all[array.attribute("Name").value()] = values.front();
    }
    return all;
}

}  // namespace

PolyData read_polydata(const std::filesystem::path& file) {
    const pugi::xml_document document = load(file);
    const pugi::xml_node root = document.child("VTKFile");
    const auto expect = [&](const char* attribute, std::string_view expected) {
        const std::string_view found = root.attribute(attribute).value();
        if (found != expected)
            refuse_frame(file, fmt::format("VTKFile: {}: found '{}', expected '{}'", attribute, found, expected));
    };
    expect("type", "PolyData");
    expect("byte_order", "LittleEndian");
    expect("header_type", "UInt64");
    expect("compressor", "vtkZLibDataCompressor");
    const pugi::xml_node piece = root.child("PolyData").child("Piece");
    if (!piece) refuse_frame(file, "found no element Piece in PolyData");

    PolyData data;
    if (const pugi::xml_node points = piece.child("Points").child("DataArray")) {
        const std::vector<double> coordinates = read_array(file, points);
        for (std::size_t k = 0; k + 2 < coordinates.size(); k += 3)
            data.points.push_back({coordinates[k], coordinates[k + 1]});
    }
    append_cells(file, piece.child("Lines"), true, data);
    append_cells(file, piece.child("Polys"), false, data);
    for (const pugi::xml_node array : piece.child("CellData").children("DataArray")) {
        data.cell_data[array.attribute("Name").value()] = read_array(file, array);
    }
    data.field_values = field_values_of(file, root.child("PolyData").child("FieldData"));
    return data;
}

std::map<std::string, double> read_field_values(const std::filesystem::path& file) {
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        fail_reading(errno, fmt::format("{}: cannot be read ({}), expected a frame of a test", file.string(),
                                        std::strerror(errno)));
    }
    std::string text, line;
    constexpr std::size_t most = 1 << 16;  // bytes; enough for a few numbers
    while (text.size() < most && line != "</FieldData>" && std::getline(in, line)) text += line + '\n';
    refuse_failed(in, file.string());
    const std::size_t begin = text.find("<FieldData>");
    pugi::xml_document document;
    if (begin == std::string::npos || line != "</FieldData>" || !document.load_string(text.c_str() + begin))
        refuse_frame(file, "found no element FieldData at the start");
    return field_values_of(file, document.child("FieldData"));
}

const std::vector<double>& cell_values(const std::filesystem::path& file, const PolyData& data, const char* name,
                                       std::size_t components) {
    const auto found = data.cell_data.find(name);
    const std::size_t count = found == data.cell_data.end() ? 0 : found->second.size(),
                      expected = components * data.cells.size();
    if (found == data.cell_data.end() || count != expected)
        refuse_frame(file, fmt::format("cell data '{}': found {} values, expected {}", name, count, expected));
    return found->second;
}

void refuse_frame(const std::filesystem::path& file, const std::string& what) {
    throw InputError(fmt::format("{}: {}; write the frames again with `crackle test --force`", file.string(), what));
}

}  // namespace crackle
