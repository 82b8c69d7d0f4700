// SPDX-License-Identifier: GPL-3.0-or-later
// ParaView's XML PolyData (.vtp) and its collection file (.pvd), written piece after piece: an array is packed while
// its values come, and never lies in memory unpacked. Arrays stand in the text as base64 of zlib-compressed
// little-endian bytes (vtkZLibDataCompressor). Format: VTK File Formats, "XML File Formats".
//
//     write_vtp_head(out, fields, counts)
//     begin_element(out, "Points"), a PackedArray, end_element(out, "Points"); Lines and Polys with connectivity and
//     offsets; CellData: lines first, then polygons, as VTK counts cells
//     write_vtp_end(out)
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace crackle {

struct VtpCounts {
    std::size_t points = 0, lines = 0, polygons = 0;
};

/// @param fields  one number each, for the whole file
void write_vtp_head(std::ostream& out, const std::vector<std::pair<std::string, double>>& fields,
                    const VtpCounts& counts);
void write_vtp_end(std::ostream& out);
void begin_element(std::ostream& out, std::string_view name);
void end_element(std::ostream& out, std::string_view name);

/// One DataArray. T: double, float, std::int64_t, std::int32_t or std::uint8_t, under VTK's names for them.
template <class T>
class PackedArray {
  public:
    /// @param components  values a point or cell
    PackedArray(std::string name, std::size_t components);
    void add(T value) {
        block_.push_back(value);
        if (block_.size() == block_values) pack_block();
    }
    /// All values are there: the element's text. @param attributes  further ones, with a blank before each
    void write(std::ostream& out, std::string_view attributes = {});

  private:
    static constexpr std::size_t block_values = 3 << 12;  // whole records of one or three; stays in a core's cache
    void pack_block();

    std::string name_;
    std::size_t components_;
    std::vector<T> block_;
    std::string packed_;
    std::vector<std::uint64_t> packed_bytes_;  // by block
    std::size_t last_block_bytes_ = 0;
};

struct CollectionEntry {
    double time = 0.0;
    int part = 0;
    std::string file;  ///< relative to the collection
};

/// The text of a .pvd file.
std::string pvd_text(const std::vector<CollectionEntry>& entries);

}  // namespace crackle
