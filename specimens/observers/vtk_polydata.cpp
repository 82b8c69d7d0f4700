// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/vtk_polydata.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <bit>
#include <cstring>
#include <memory>
#include <new>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

#include "specimens/observers/base64.hpp"

namespace crackle {
namespace {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they lie in memory, declared LittleEndian");

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

std::string encoded(const std::string& bytes) {
    return encode_base64({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

/// zlib's format by libdeflate, which takes a third of zlib's time.
class Packer {
  public:
    Packer() : compressor_(libdeflate_alloc_compressor(fastest), &libdeflate_free_compressor) {
        if (!compressor_) throw std::bad_alloc();
    }

    /// Header (number of blocks, block size, size of a partial last block, compressed size of each block) and data,
    /// each base64.
    std::string pack(const std::string& bytes) const {
        constexpr std::uint64_t empty_block = 32768;  // what VTK writes for arrays without values
        if (bytes.empty()) return encoded(bytes_of(std::vector<std::uint64_t>{0, empty_block, 0}));
        std::string packed(libdeflate_zlib_compress_bound(compressor_.get(), bytes.size()), '\0');
        packed.resize(
            libdeflate_zlib_compress(compressor_.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
        return encoded(bytes_of(std::vector<std::uint64_t>{1, bytes.size(), 0, packed.size()})) + encoded(packed);
    }

  private:
    static constexpr int fastest = 1;
    std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor_;
};

void add_array(const Packer& packer, pugi::xml_node parent, const std::string& name, const char* type, int components,
               const std::string& bytes) {
    pugi::xml_node array = parent.append_child("DataArray");
    array.append_attribute("type") = type;
    array.append_attribute("Name") = name.c_str();
    if (components > 1) array.append_attribute("NumberOfComponents") = components;
    array.append_attribute("format") = "binary";
    array.text() = packer.pack(bytes).c_str();
}

void add_cells(const Packer& packer, pugi::xml_node parent, const CellList& cells) {
    add_array(packer, parent, "connectivity", "Int64", 1, bytes_of(cells.connectivity));
    add_array(packer, parent, "offsets", "Int64", 1, bytes_of(cells.offsets));
}

pugi::xml_node add_root(pugi::xml_document& document, const char* type) {
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    pugi::xml_node root = document.append_child("VTKFile");
    root.append_attribute("type") = type;
    root.append_attribute("version") = "1.0";
    root.append_attribute("byte_order") = "LittleEndian";
    root.append_attribute("header_type") = "UInt64";
    root.append_attribute("compressor") = "vtkZLibDataCompressor";
    return root;
}

std::string text_of(const pugi::xml_document& document) {
    std::ostringstream text;
    document.save(text, " ");
    return text.str();
}

}  // namespace

void VtpData::add(CellList& list, const std::vector<Vec2>& corners) {
    for (const Vec2 corner : corners) {
        list.connectivity.push_back(static_cast<std::int64_t>(points.size()));
        points.push_back(corner);
    }
    list.offsets.push_back(static_cast<std::int64_t>(list.connectivity.size()));
}

std::string vtp_text(const VtpData& data) {
    const Packer packer;
    pugi::xml_document document;
    pugi::xml_node poly = add_root(document, "PolyData").append_child("PolyData");
    pugi::xml_node fields = poly.append_child("FieldData");
    for (const auto& [name, value] : data.field_values) {
        pugi::xml_node array = fields.append_child("DataArray");
        array.append_attribute("type") = "Float64";
        array.append_attribute("Name") = name.c_str();
        array.append_attribute("NumberOfTuples") = 1;
        array.append_attribute("format") = "binary";
        array.text() = packer.pack(bytes_of(std::vector<double>{value})).c_str();
    }
    pugi::xml_node piece = poly.append_child("Piece");
    piece.append_attribute("NumberOfPoints") = data.points.size();
    piece.append_attribute("NumberOfVerts") = 0;
    piece.append_attribute("NumberOfLines") = data.lines.offsets.size();
    piece.append_attribute("NumberOfStrips") = 0;
    piece.append_attribute("NumberOfPolys") = data.polygons.offsets.size();

    std::vector<double> coordinates;
    coordinates.reserve(3 * data.points.size());
    for (const Vec2 p : data.points) coordinates.insert(coordinates.end(), {p.x, p.y, 0.0});
    add_array(packer, piece.append_child("Points"), "points", "Float64", 3, bytes_of(coordinates));
    add_cells(packer, piece.append_child("Lines"), data.lines);
    add_cells(packer, piece.append_child("Polys"), data.polygons);
    pugi::xml_node cell_data = piece.append_child("CellData");
    for (const CellArray& array : data.cell_arrays) {
        const bool whole = !array.integer.empty();
        add_array(packer, cell_data, array.name, whole ? "Int64" : "Float64", array.components,
                  whole ? bytes_of(array.integer) : bytes_of(array.real));
    }
    return text_of(document);
}

std::string pvd_text(const std::vector<CollectionEntry>& entries) {
    pugi::xml_document document;
    pugi::xml_node collection = add_root(document, "Collection").append_child("Collection");
    for (const CollectionEntry& entry : entries) {
        pugi::xml_node set = collection.append_child("DataSet");
        set.append_attribute("timestep") = fmt::format("{}", entry.time).c_str();
        set.append_attribute("part") = entry.part;
        set.append_attribute("file") = entry.file.c_str();
    }
    return text_of(document);
}

}  // namespace crackle
