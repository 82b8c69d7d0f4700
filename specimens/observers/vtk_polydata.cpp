// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/vtk_polydata.hpp"

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

#include "specimens/observers/base64.hpp"

namespace crackle {
namespace {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they lie in memory, declared LittleEndian");

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

/// One zlib stream by ISA-L: measured numbers are noise but for their exponents, and other packers spend ten times the
/// time on looking for repeats in it.
void append_packed(std::span<const unsigned char> bytes, std::string& packed) {
    constexpr std::size_t slack = 512;  // heads of the stream and of blocks that do not shrink
    std::vector<std::uint8_t> memory(ISAL_DEF_LVL1_DEFAULT);
    isal_zstream stream{};  // all of it: what the library leaves unset steers its search for repeats
    isal_deflate_stateless_init(&stream);
    stream.level = 1;
    stream.level_buf = memory.data();
    stream.level_buf_size = static_cast<std::uint32_t>(memory.size());
    stream.gzip_flag = IGZIP_ZLIB;
    stream.end_of_stream = 1;
    // The library reads only, but its pointer is not const.
    stream.next_in = const_cast<std::uint8_t*>(bytes.data());
    stream.avail_in = static_cast<std::uint32_t>(bytes.size());
    const std::size_t begin = packed.size();
    packed.resize(begin + bytes.size() + bytes.size() / 256 + slack);
    stream.next_out = reinterpret_cast<std::uint8_t*>(packed.data()) + begin;
    stream.avail_out = static_cast<std::uint32_t>(packed.size() - begin);
    const int outcome = isal_deflate_stateless(&stream);
    if (outcome != COMP_OK) throw std::runtime_error(fmt::format("frames: packing failed ({})", outcome));
    packed.resize(packed.size() - stream.avail_out);
}

/// A piece of text after the other: the whole would be as large as the array again.
void write_base64(std::ostream& out, std::span<const unsigned char> bytes) {
    constexpr std::size_t piece = 3 << 14;  // whole groups of three
    for (std::size_t at = 0; at < bytes.size(); at += piece)
        out << encode_base64(bytes.subspan(at, std::min(piece, bytes.size() - at)));
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
PackedArray<T>::PackedArray(std::string name, std::size_t components)
    : name_(std::move(name)), components_(components) {
    block_.reserve(block_values);
}

template <class T>
void PackedArray<T>::pack_block() {
    const std::size_t before = packed_.size();
    append_packed(bytes_of(block_), packed_);
    packed_bytes_.push_back(packed_.size() - before);
    last_block_bytes_ = block_.size() * sizeof(T);
    block_.clear();
}

template <class T>
void PackedArray<T>::write(std::ostream& out, std::string_view attributes) {
    if (!block_.empty()) pack_block();
    fmt::print(out, "<DataArray type=\"{}\" Name=\"{}\"", vtk_name<T>(), in_attribute(name_));
    if (components_ > 1) fmt::print(out, " NumberOfComponents=\"{}\"", components_);
    out << attributes << " format=\"binary\">";
    // Header: number of blocks, bytes of one, bytes of a shorter last one (0: it is whole), packed bytes of each.
    constexpr std::size_t block_bytes = block_values * sizeof(T);
    std::vector<std::uint64_t> header{packed_bytes_.size(), block_bytes,
                                      last_block_bytes_ == block_bytes ? 0 : last_block_bytes_};
    header.insert(header.end(), packed_bytes_.begin(), packed_bytes_.end());
    write_base64(out, bytes_of(header));
    write_base64(out, {reinterpret_cast<const unsigned char*>(packed_.data()), packed_.size()});
    out << "</DataArray>\n";
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
        PackedArray<double> array(name, 1);
        array.add(value);
        array.write(out, " NumberOfTuples=\"1\"");
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
