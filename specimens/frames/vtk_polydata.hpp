// SPDX-License-Identifier: GPL-3.0-or-later
// ParaView's XML PolyData (.vtp) and its collection file (.pvd), written piece after piece: an array is packed while
// its values come, and a large one written, so that it never lies in memory. Arrays stand in the text as base64 of
// zlib-compressed little-endian bytes (vtkZLibDataCompressor). Format: VTK File Formats, "XML File Formats".
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

/// One DataArray, written while its values come. T: double, float, std::int64_t, std::int32_t or std::uint8_t, under
/// VTK's names for them.
template <class T>
class PackedArray {
  public:
    /// @param out         seekable: the sizes of packed blocks stand before them
    /// @param components  values a point or cell
    /// @param values      how many will come in all
    /// @param attributes  further ones, with a blank before each
    PackedArray(std::ostream& out, std::string_view name, std::size_t components, std::size_t values,
                std::string_view attributes = {});
    void add(T value) {
        block_.push_back(value);
        if (block_.size() == block_values) pack_block();
    }
    /// All values have come. @throws std::logic_error if they have not
    void finish();

  private:
    static constexpr std::size_t block_values = 3 << 12;  // whole records of one or three; stays in a core's cache
    static constexpr std::size_t most_held = 1 << 20;     // bytes, of values; larger arrays are written block by block
    void pack_block();
    void write_header();
    void write_packed(std::size_t bytes);

    std::ostream& out_;
    std::size_t values_;
    bool held_;  // nothing is written before the whole is packed: no way back to the header
    std::vector<T> block_;
    std::vector<unsigned char> packed_;  // not written yet
    std::vector<std::uint64_t> header_;  // number of blocks, bytes of one, bytes of a shorter last one (0: it is
                                         // whole), packed bytes of each
    std::size_t blocks_ = 0, added_ = 0;
    std::streampos header_at_;
};

struct CollectionEntry {
    double time = 0.0;
    int part = 0;
    std::string file;  ///< relative to the collection
};

/// The text of a .pvd file.
std::string pvd_text(const std::vector<CollectionEntry>& entries);

}  // namespace crackle
