// SPDX-License-Identifier: GPL-3.0-or-later
// Writes ParaView's XML PolyData (.vtp) and its collection file (.pvd) incrementally. An array is compressed while its
// values are added. A large array is also written at the same time, so it is never in memory as a whole. Arrays are
// stored as base64 of zlib-compressed little-endian bytes (vtkZLibDataCompressor). The format is described in VTK File
// Formats, "XML File Formats".
//
//     write_vtp_head(out, fields, counts)
//     begin_element(out, "Points"), a PackedArray, end_element(out, "Points"); Lines and Polys with connectivity and
//     offsets; CellData: lines first, then polygons, as VTK counts cells
//     write_vtp_end(out)
// Tested by tests/specimens/frames/frame_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace crackle {

/// Numbers of points and cells in a file.
struct VtpCounts {
    std::size_t points = 0, lines = 0, polygons = 0;
};

/// Writes the beginning of a file. @param fields  names and values of numbers for the whole file
void write_vtp_head(std::ostream& out, const std::vector<std::pair<std::string, double>>& fields,
                    const VtpCounts& counts);
/// Writes the end of a file.
void write_vtp_end(std::ostream& out);
/// Writes the start tag of an XML element without attributes.
void begin_element(std::ostream& out, std::string_view name);
/// Writes the end tag of an XML element.
void end_element(std::ostream& out, std::string_view name);

/// A DataArray element, written while values are added. T is double, float, std::int64_t, std::int32_t or std::uint8_t;
/// the file uses VTK's names for these types.
template <class T>
class PackedArray {
  public:
    /// @param out         seekable stream; the sizes of compressed blocks, which precede the blocks, are written last
    /// @param components  values per point or cell
    /// @param values      total number of values
    /// @param attributes  further attributes, each preceded by a space
    PackedArray(std::ostream& out, std::string_view name, std::size_t components, std::size_t values,
                std::string_view attributes = {});
    /// Adds the next value of the array.
    void add(T value) {
        block_.push_back(value);
        if (block_.size() == block_values) pack_block();
    }
    /// Ends the array. @throws std::logic_error if values are missing
    void finish();

  private:
    // Number of values per block. It is divisible by 3, the number of components of a vector, and a block fits in the
    // cache.
    static constexpr std::size_t block_values = 3 << 12;
    static constexpr std::size_t most_held = 1 << 20;  // bytes of values; larger arrays are written block by block
    void pack_block();
    void write_header();
    void write_packed(std::size_t bytes);

    std::ostream& out_;
    std::size_t values_;
    bool held_;  // whether the array is written only when complete, without seeking back to the header
    std::vector<T> block_;
    std::vector<unsigned char> packed_;  // compressed bytes not yet written
    // Number of blocks, bytes per block, bytes of a shorter last block (0 if there is none), compressed bytes of each
    // block.
    std::vector<std::uint64_t> header_;
    std::size_t blocks_ = 0, added_ = 0;
    std::streampos header_at_;
};

/// Writes a whole array. @param add  function that passes each value to the function that it receives as an argument
template <class T, class Add>
void write_array(std::ostream& out, const char* name, std::size_t values, const Add& add) {
    PackedArray<T> array(out, name, 1, values);
    add([&](auto value) { array.add(static_cast<T>(value)); });
    array.finish();
}

/// Writes an array of indices, as Int32 if `largest` fits into that type, otherwise as Int64.
template <class Add>
void write_indices(std::ostream& out, const char* name, std::size_t values, std::size_t largest, const Add& add) {
    constexpr std::size_t most_in_int32 = std::numeric_limits<std::int32_t>::max();
    largest <= most_in_int32 ? write_array<std::int32_t>(out, name, values, add)
                             : write_array<std::int64_t>(out, name, values, add);
}

/// Writes a line for each pair of points: from each even-numbered point to the next one.
inline void write_pairs_as_lines(std::ostream& out, std::size_t lines) {
    begin_element(out, "Lines");
    write_indices(out, "connectivity", 2 * lines, 2 * lines, [&](const auto& add) {
        for (std::size_t point = 0; point < 2 * lines; ++point) add(point);
    });
    write_indices(out, "offsets", lines, 2 * lines, [&](const auto& add) {
        for (std::size_t line = 1; line <= lines; ++line) add(2 * line);
    });
    end_element(out, "Lines");
}

/// A file in a collection, and the simulated time of its contents.
struct CollectionEntry {
    double time = 0.0;
    int part = 0;
    std::string file;  ///< path relative to the collection file
};

/// Text of a .pvd file.
std::string pvd_text(const std::vector<CollectionEntry>& entries);

}  // namespace crackle
