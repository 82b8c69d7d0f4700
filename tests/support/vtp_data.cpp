// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/vtp_data.hpp"

#include <sstream>

#include "specimens/frames/vtk_polydata.hpp"

namespace crackle::testing {
namespace {

template <class T>
void write_array(std::ostream& out, const std::string& name, std::size_t components, const std::vector<T>& values) {
    PackedArray<T> array(out, name, components, values.size());
    for (const T value : values) array.add(value);
    array.finish();
}

}  // namespace

std::string vtp_text(const VtpData& data) {
    std::ostringstream out, cells;
    std::vector<float> points;
    for (const auto& [name, list] : {std::pair("Lines", &data.lines), std::pair("Polys", &data.polygons)}) {
        std::vector<std::int32_t> connectivity, offsets;
        for (const auto& corners : *list) {
            for (const Vec2 corner : corners) {
                connectivity.push_back(static_cast<std::int32_t>(points.size() / 3));
                points.insert(points.end(), {static_cast<float>(corner.x), static_cast<float>(corner.y), 0.0F});
            }
            offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
        }
        begin_element(cells, name);
        write_array(cells, "connectivity", 1, connectivity);
        write_array(cells, "offsets", 1, offsets);
        end_element(cells, name);
    }
    write_vtp_head(out, data.field_values, {points.size() / 3, data.lines.size(), data.polygons.size()});
    begin_element(out, "Points");
    write_array(out, "points", 3, points);
    end_element(out, "Points");
    out << cells.str();
    begin_element(out, "CellData");
    for (const CellArray& array : data.cell_arrays) {
        if (array.integer.empty()) {
            write_array(out, array.name, array.components, array.real);
        } else {
            write_array(out, array.name, array.components, array.integer);
        }
    }
    end_element(out, "CellData");
    write_vtp_end(out);
    return std::move(out).str();
}

}  // namespace crackle::testing
