// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/files/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"

namespace crackle {
namespace {

using namespace std::string_view_literals;

struct Beginning {
    std::string_view bytes, kind;
};
constexpr std::array beginnings{
    Beginning{"PK\x03\x04", "a spreadsheet (xlsx, ods) or another zip archive"},
    Beginning{"\xd0\xcf\x11\xe0", "a spreadsheet (xls) or another old Office file"},
    Beginning{"\x1f\x8b", "a file compressed by gzip"},
    Beginning{"SQLite format 3", "a GeoPackage or another SQLite database"},
    Beginning{"\0\0\x27\x0a"sv, "a shapefile"},
    Beginning{"AutoCAD Binary DXF", "a binary DXF file"},
    Beginning{"AC10", "a DWG drawing"},
    Beginning{"%PDF", "a PDF file"},
    Beginning{"%!PS", "a PostScript file"},
    Beginning{"\x89PNG", "a PNG image"},
    Beginning{"\xff\xd8\xff", "a JPEG image"},
    Beginning{"{\\rtf", "a rich text file"},
    Beginning{"# vtk DataFile", "a VTK file"},
    Beginning{"ITEM: TIMESTEP", "a LAMMPS dump"},
};

constexpr std::size_t looked_at = 4096;  // bytes of a text that are examined to determine its kind

std::string lower(std::string_view text) {
    std::string low(text);
    std::transform(low.begin(), low.end(), low.begin(), [](unsigned char c) { return std::tolower(c); });
    return low;
}

std::string_view kind_of_markup(const std::string& text) {
    const auto has = [&](std::string_view word) { return text.find(word) != std::string::npos; };
    if (has("<svg")) return "an SVG drawing";
    if (has("<kml")) return "a KML file";
    if (has("<gpx")) return "a GPX track";
    if (has("<vtkfile")) return "a VTK file";
    if (has("<html")) return "a web page";
    return "an XML file";
}

std::string_view kind_of_braces(const std::string& text) {
    const auto has = [&](std::string_view word) { return text.find(word) != std::string::npos; };
    if (has("\"topology\"")) return "TopoJSON";
    for (const char* word : {"\"featurecollection\"", "\"feature\"", "\"geometrycollection\"", "\"linestring\"",
                             "\"multilinestring\"", "\"coordinates\""})
        if (has(word)) return "GeoJSON";
    return "a JSON file";
}

}  // namespace

std::string_view foreign_kind(std::string_view bytes) {
    for (const Beginning& known : beginnings)
        if (bytes.starts_with(known.bytes)) return known.kind;
    std::string_view text = without_byte_order_mark(bytes);
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    const std::string head = lower(text.substr(0, looked_at));
    if (head.starts_with('<')) return kind_of_markup(head);
    if (head.starts_with('{')) return kind_of_braces(head);
    const std::size_t inside = head.find_first_not_of('[');
    const bool named =
        inside > 0 && inside < head.size() && std::isalpha(static_cast<unsigned char>(head[inside])) != 0;
    if (named) return "a TOML file";
    if (head.starts_with('[')) return kind_of_braces(head);
    return {};
}

void refuse_foreign(const std::string& name, std::string_view bytes, const std::string& expected) {
    if (const std::string_view kind = foreign_kind(bytes); !kind.empty())
        throw InputError(fmt::format("{}: found {}, expected {}", name, kind, expected));
}

}  // namespace crackle
