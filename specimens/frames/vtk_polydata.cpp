// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/frames/vtk_polydata.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <bit>
#include <ostream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "specimens/frames/base64.hpp"

namespace crackle {
namespace {

static_assert(std::endian::native == std::endian::little,
              "arrays are written without conversion and declared LittleEndian");

template <class T>
constexpr const char* vtk_name() {
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, float>) return "Float32";
    if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
    if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

template <class T>
std::span<const unsigned char> bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(T)};
}

/// Memory that ISA-L needs to compress `bytes` bytes at once: its tables, and at most one token per byte. Clearing the
/// default size of 280 kB would take longer than compressing the few kB of a small specimen's array.
std::size_t packing_room(std::size_t bytes) {
    constexpr std::size_t tables = ISAL_DEF_LVL3_REQ, token = ISAL_DEF_LVL3_TOKEN_SIZE, spare = 64;
    return std::clamp<std::size_t>(tables + token * (bytes + spare), ISAL_DEF_LVL3_MIN, ISAL_DEF_LVL3_DEFAULT);
}

/// Appends one zlib stream compressed by ISA-L. Except for their exponents, the values are like noise, and other
/// compressors take ten times as long because they search for repeats. Levels 1 and 2 are 1.5 times as fast but are not
/// used: in one of 500 processes, their output for the same bytes depends on memory addresses (version 2.30.0).
void append_packed(std::span<const unsigned char> bytes, std::vector<unsigned char>& packed) {
    constexpr std::size_t slack = 512;  // bytes for the headers of the stream, and for blocks that cannot be compressed
    std::vector<std::uint8_t> memory(packing_room(bytes.size()));
    isal_zstream stream{};  // zero everything, because members that the library leaves unset would affect the output
    isal_deflate_stateless_init(&stream);
    stream.level = 3;
    stream.level_buf = memory.data();
    stream.level_buf_size = static_cast<std::uint32_t>(memory.size());
    stream.gzip_flag = IGZIP_ZLIB;
    stream.end_of_stream = 1;
    // The library only reads from this pointer, although it is not const.
    stream.next_in = const_cast<std::uint8_t*>(bytes.data());
    stream.avail_in = static_cast<std::uint32_t>(bytes.size());
    const std::size_t begin = packed.size();
    packed.resize(begin + bytes.size() + bytes.size() / 256 + slack);
    stream.next_out = packed.data() + begin;
    stream.avail_out = static_cast<std::uint32_t>(packed.size() - begin);
    const int outcome = isal_deflate_stateless(&stream);
    if (outcome != COMP_OK) throw std::runtime_error(fmt::format("frames: packing failed ({})", outcome));
    packed.erase(packed.end() - stream.avail_out, packed.end());
}

void write_root(std::ostream& out, const char* type) {
    fmt::print(out,
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" "
               "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n",
               type);
}

std::string in_attribute(const std::string& text) {
    std::string out;
    for (const char letter : text) {
        switch (letter) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += letter;
        }
    }
    return out;
}

}  // namespace

template <class T>
PackedArray<T>::PackedArray(std::ostream& out, std::string_view name, std::size_t components, std::size_t values,
                            std::string_view attributes)
    : out_(out),
      values_(values),
      held_(values * sizeof(T) <= most_held),
      header_(3 + (values + block_values - 1) / block_values) {
    block_.reserve(std::min(values, block_values));
    fmt::print(out, "<DataArray type=\"{}\" Name=\"{}\"", vtk_name<T>(), in_attribute(std::string(name)));
    if (components > 1) fmt::print(out, " NumberOfComponents=\"{}\"", components);
    out << attributes << " format=\"binary\">";
    header_[0] = header_.size() - 3;
    header_[1] = block_values * sizeof(T);
    if (held_) return;
    header_at_ = out.tellp();
    write_header();
}

template <class T>
void PackedArray<T>::pack_block() {
    added_ += block_.size();
    if (added_ > values_) throw std::logic_error("frames: an array received more values than declared");
    if (block_.size() < block_values) header_[2] = block_.size() * sizeof(T);
    const std::size_t before = packed_.size();
    append_packed(bytes_of(block_), packed_);
    header_[3 + blocks_] = packed_.size() - before;
    ++blocks_;
    block_.clear();
    // Writes only whole base64 groups, because the encoding continues across blocks.
    if (!held_) write_packed(packed_.size() / 3 * 3);
}

template <class T>
void PackedArray<T>::write_header() {
    out_ << encode_base64(bytes_of(header_));
}

template <class T>
void PackedArray<T>::write_packed(std::size_t bytes) {
    out_ << encode_base64(std::span(packed_).first(bytes));
    packed_.erase(packed_.begin(), packed_.begin() + static_cast<std::ptrdiff_t>(bytes));
}

template <class T>
void PackedArray<T>::finish() {
    if (!block_.empty()) pack_block();
    if (added_ != values_) throw std::logic_error("frames: an array received fewer values than declared");
    if (held_) write_header();
    write_packed(packed_.size());
    if (!held_) {
        const std::streampos end = out_.tellp();
        out_.seekp(header_at_);
        write_header();
        out_.seekp(end);
    }
    out_ << "</DataArray>\n";
}

template class PackedArray<double>;
template class PackedArray<float>;
template class PackedArray<std::int64_t>;
template class PackedArray<std::int32_t>;
template class PackedArray<std::uint8_t>;

void write_vtp_head(std::ostream& out, const std::vector<std::pair<std::string, double>>& fields,
                    const VtpCounts& counts) {
    write_root(out, "PolyData");
    out << "<PolyData>\n";
    begin_element(out, "FieldData");
    for (const auto& [name, value] : fields) {
        PackedArray<double> array(out, name, 1, 1, " NumberOfTuples=\"1\"");
        array.add(value);
        array.finish();
    }
    end_element(out, "FieldData");
    fmt::print(out,
               "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
               "NumberOfPolys=\"{}\">\n",
               counts.points, counts.lines, counts.polygons);
}

void write_vtp_end(std::ostream& out) { out << "</Piece>\n</PolyData>\n</VTKFile>\n"; }

void begin_element(std::ostream& out, std::string_view name) { out << '<' << name << ">\n"; }
void end_element(std::ostream& out, std::string_view name) { out << "</" << name << ">\n"; }

std::string pvd_text(const std::vector<CollectionEntry>& entries) {
    std::ostringstream text;
    write_root(text, "Collection");
    text << "<Collection>\n";
    for (const CollectionEntry& entry : entries) {
        fmt::print(text, "<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\" />\n", entry.time, entry.part,
                   in_attribute(entry.file));
    }
    text << "</Collection>\n</VTKFile>\n";
    return std::move(text).str();
}

}  // namespace crackle
