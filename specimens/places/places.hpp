// SPDX-License-Identifier: GPL-3.0-or-later
// Where the values of a test were written. The parts of a resolved case carry these places, so that an error found long
// after reading still names file, line and key. Code that finds the error names the value by an enumerator.
// Tested by tests/specimens/places/places_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "solver/base/names.hpp"

namespace crackle {

/// A value of a case to which errors found after reading can refer.
enum class CaseKey : std::uint8_t {
    particles_file,
    packing,
    packing_width,
    packing_height,
    packing_count,
    packing_radius_min,
    packing_radius_max,
    packing_radius_median,
    packing_radius_log_deviation,
    packing_cell_spread,
    packing_mean_overlap,
    packing_void_ratio,
    mesh,
    mesh_kind,
    mesh_thick,
    minerals_labels,
    minerals_image,
    mineral,
    joints_snap,
    joint_set_length_mean,
    joint_set_length_min,
    joint_set_length_max,
    joint_set_gap_mean,
    joint_set_number,
    joint_set_p10,
    joint_set_p20,
    joint_set_p21,
    joint_set_spacing,
    joint_set_scan_line,
    joint_set_through,
    joint_set_aperture,
    trace,
    trace_file,
    trace_aperture,
    bond_law,
    bond_thick,
    shape_diameter,
    shape_notch,
    loading_kind,
    loading_axial_strain_rate,
    loading_rate_tolerance,
    loading_max_axial_strain,
    loading_platens,
    loading_span,
    loading_pad_width,
    loading_normal_stress,
    loading_normal_stiffness,
    loading_box_gap,
    loading_control,
    confinement_pressure,
    numerics_time_step
};
constexpr auto list_names(CaseKey) {
    return in_order(
        "particles.file", "packing", "packing.width", "packing.height", "packing.count", "packing.radius_min",
        "packing.radius_max", "packing.radius_median", "packing.radius_log_deviation", "packing.cell_spread",
        "packing.mean_overlap", "packing.void_ratio", "mesh", "mesh.kind", "mesh.thick", "minerals.labels",
        "minerals.image", "mineral", "joints.snap", "joint_set.length_mean", "joint_set.length_min",
        "joint_set.length_max", "joint_set.gap_mean", "joint_set.number", "joint_set.p10", "joint_set.p20",
        "joint_set.p21", "joint_set.spacing", "joint_set.scan_line", "joint_set.through", "joint_set.aperture", "trace",
        "trace.file", "trace.aperture", "bond.law", "bond.thick", "shape.diameter", "shape.notch", "loading.kind",
        "loading.axial_strain_rate", "loading.rate_tolerance", "loading.max_axial_strain", "loading.platens",
        "loading.span", "loading.pad_width", "loading.normal_stress", "loading.normal_stiffness", "loading.box_gap",
        "loading.control", "confinement.pressure", "numerics.time_step");
}

/// The places of all keys of a case, as its reader stores them.
struct WrittenPlaces {
    std::filesystem::path source;                 ///< the case file
    std::map<std::string, std::string> position;  ///< "table.key" or "list[2].key" → "file:line"

    /// «file:line: table.key», or «file: table.key» for a key that is not set in any file.
    std::string at(const std::string& key) const;
};

/// Names the place of a value in errors. A default-constructed object belongs to parts that were not read from a case.
class Places {
  public:
    Places() = default;
    /// @param written  the case that was read
    explicit Places(std::shared_ptr<const WrittenPlaces> written) : written_(std::move(written)) {}

    /// «file:line: table.key», or the key alone if no case was read.
    std::string at(CaseKey key) const { return named(name_of(key)); }
    /// Place of a key of a table that may occur several times. @param entry  index of the table, from 0
    std::string at(CaseKey key, std::size_t entry) const;
    /// Whether a file or a setting sets the key.
    bool gives(CaseKey key) const { return written_ && written_->position.contains(name_of(key)); }
    /// The case that was read; null if there is none.
    const std::shared_ptr<const WrittenPlaces>& written() const { return written_; }

    /// Whether both objects refer to the same case.
    bool operator==(const Places&) const = default;

  private:
    std::string named(const std::string& key) const { return written_ ? written_->at(key) : key; }

    std::shared_ptr<const WrittenPlaces> written_;
};

}  // namespace crackle
