// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/resolve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>

#include "solver/base/errors.hpp"
#include "specimens/case/mineral_checks.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/joints/joint_network.hpp"

namespace crackle {
namespace {

constexpr double radians = std::numbers::pi / 180.0;

parts::Packing packing_of(const TestCase& test) {
    const TestCase::Packing& keys = test.packing;
    parts::Packing packing;
    if (keys.count)
        packing.box = parts::CircleCount{*keys.count, keys.height_to_width.value_or(2.0)};
    else
        packing.box = parts::Box{*keys.width, *keys.height};
    if (keys.mean_overlap)
        packing.target = parts::MeanOverlap{*keys.mean_overlap};
    else
        packing.target = parts::VoidRatio{*keys.void_ratio};
    if (keys.cell_diameter)
        packing.sizes = parts::CellDiameters{keys.sizes, *keys.cell_diameter, *keys.cell_spread};
    else if (keys.sizes == RadiusLaw::sieve)
        packing.sizes = parts::SieveFile{test.resolve_path("packing.sieve", *keys.sieve)};
    else if (keys.sizes == RadiusLaw::lognormal)
        packing.sizes = LognormalRadii{*keys.radius_median, *keys.radius_log_deviation, keys.radius_min.value_or(0.0),
                                       keys.radius_max.value_or(0.0)};
    else
        packing.sizes = UniformRadii{*keys.radius_min, *keys.radius_max};
    packing.seed = keys.seed;
    return packing;
}

parts::Mesh mesh_of(const TestCase::Mesh& keys) {
    parts::Mesh mesh{keys, *keys.kind, parts::DerivedGap{}};
    if (keys.thick || keys.inset) mesh.gap = parts::MeshGap{keys.thick ? *keys.thick : 2.0 * *keys.inset, keys.inset};
    return mesh;
}

/// @param correction  c_κ of the mesh (solver/laws/face_bond.hpp)
parts::MaterialValues values_of(const TestCase::MaterialKeys& keys, double correction) {
    parts::MaterialValues values = keys;
    if (keys.youngs_modulus) {
        values.mesh_correction = correction;
        const FaceModuli moduli = values.face_moduli();
        values.normal_stiffness = moduli.contact;
        values.shear_stiffness = moduli.shear_ratio * moduli.contact;
    }
    if (keys.contact_modulus) {
        values.normal_stiffness = keys.contact_modulus;
        values.shear_stiffness = *keys.contact_modulus / *keys.stiffness_ratio;
    }
    return values;
}

parts::Material material_of(const TestCase& test) {
    parts::Material material{values_of(test.material, test.face_correction()), test.material.units, false};
    const bool damped = material.damping_ratio || material.normal_damping || material.shear_damping;
    if (test.has_table("packing") && !damped) {
        material.damping_ratio = default_damping_ratio;
        material.damping_by_default = true;
    }
    return material;
}

parts::Minerals minerals_of(const TestCase& test) {
    parts::Minerals minerals;
    double sum = 0.0;
    bool open = false;
    for (const TestCase::Mineral& m : test.mineral) {
        sum += m.area_share.value_or(0.0);
        open = open || !m.area_share;
    }
    for (std::size_t k = 0; k < test.mineral.size(); ++k) {
        const TestCase::Mineral& m = test.mineral[k];
        minerals.list.push_back({m.name, values_of(mineral_material(test, k), test.face_correction()), m.area_share,
                                 !m.area_share ? 1.0 - sum
                                 : open        ? *m.area_share
                                               : *m.area_share / sum});
    }
    const auto index = [&](const std::string& name) {
        return static_cast<int>(std::ranges::find(minerals.list, name, &parts::Mineral::name) - minerals.list.begin());
    };
    for (const auto& [between, own] : test.mineral_pair) {
        const parts::MaterialValues values = values_of(own, test.face_correction());
        minerals.pairs.push_back({index(between[0]), index(between[1]), values.normal_stiffness, values.shear_stiffness,
                                  values.friction_angle, values});
    }
    const TestCase::Minerals& keys = test.minerals;
    if (keys.assign == MineralAssignment::size) minerals.assign = parts::GrainsBySize{};
    if (keys.assign == MineralAssignment::random) minerals.assign = parts::RandomGrains{keys.seed};
    if (keys.assign == MineralAssignment::labels)
        minerals.assign = parts::GrainLabels{test.resolve_path("minerals.labels", *keys.labels)};
    if (keys.assign == MineralAssignment::image) {
        parts::GrainImage image{test.resolve_path("minerals.image", *keys.image), *keys.image};
        for (const TestCase::Mineral& m : test.mineral) image.colours.push_back(*colour_of(*m.colour));
        minerals.assign = std::move(image);
    }
    return minerals;
}

/// A uniform distribution of mean ± deviation; without a deviation, the mean alone.
LengthLaw spread_law(double mean, const std::optional<double>& deviation) {
    return deviation ? LengthLaw::uniform(mean, *deviation) : LengthLaw::fixed(mean);
}

OrientationLaw directions_of(const TestCase& test, std::size_t set) {
    const TestCase::JointSet& keys = test.joint_set[set];
    if (keys.orientation == JointOrientation::fisher) {
        const double trend = *test.joints.section_trend * radians;
        const Section section =
            test.joints.section == JointSection::vertical ? Section::vertical(trend) : Section::horizontal(trend);
        try {
            return OrientationLaw::fisher(*keys.dip * radians, *keys.dip_direction * radians, *keys.fisher_k, section);
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", test.at(fmt::format("joint_set[{}].dip", set + 1)), error.what()));
        }
    }
    const double angle = *keys.angle * radians;
    if (keys.orientation == JointOrientation::uniform)
        return OrientationLaw::uniform(angle, *keys.angle_deviation * radians);
    if (keys.orientation == JointOrientation::von_mises) return OrientationLaw::von_mises(angle, *keys.kappa);
    return OrientationLaw::fixed(angle);
}

using TraceLengths = std::variant<PersistentTraces, TracesWithGaps, LengthLaw>;

TraceLengths lengths_of(const TestCase::JointSet& keys) {
    switch (keys.length) {
        case JointLength::persistent:
            return PersistentTraces{};
        case JointLength::gaps:
            return TracesWithGaps{spread_law(*keys.length_mean, keys.length_deviation),
                                  spread_law(*keys.gap_mean, keys.gap_deviation)};
        case JointLength::uniform:
            return LengthLaw::uniform(*keys.length_mean, *keys.length_deviation);
        case JointLength::lognormal:
            return LengthLaw::lognormal(*keys.length_mean, *keys.length_deviation);
        case JointLength::exponential:
            return LengthLaw::exponential(*keys.length_mean);
        case JointLength::power_law:
            return LengthLaw::power_law(*keys.length_min, *keys.length_max, *keys.length_exponent);
        case JointLength::fixed:
            break;
    }
    return LengthLaw::fixed(*keys.length_mean);
}

TraceAmount amount_of(const TestCase::JointSet& keys) {
    if (keys.number) return {AmountKind::number, static_cast<double>(*keys.number)};
    if (keys.p10) return {AmountKind::p10, *keys.p10};
    if (keys.p20) return {AmountKind::p20, *keys.p20};
    if (keys.p21) return {AmountKind::p21, *keys.p21};
    TraceAmount amount{AmountKind::spacing, *keys.spacing};
    if (keys.spacing_law == JointSpacing::exponential)
        amount.spacing = LengthLaw::exponential(*keys.spacing);
    else if (keys.spacing_law == JointSpacing::lognormal)
        amount.spacing = LengthLaw::lognormal(*keys.spacing, *keys.spacing_deviation);
    else
        amount.spacing = spread_law(*keys.spacing,
                                    keys.spacing_law == JointSpacing::uniform ? keys.spacing_deviation : std::nullopt);
    if (keys.through) amount.through = Vec2{(*keys.through)[0], (*keys.through)[1]};
    return amount;
}

std::optional<Joint> mechanics_of(const TestCase::JointKeys& keys) {
    if (keys.as_rock()) return std::nullopt;
    Joint joint;
    joint.bonded = !keys.open();
    joint.strength_factor = keys.strength_factor.value_or(1.0);
    joint.tensile_strength = keys.tensile_strength;
    joint.cohesion = keys.cohesion;
    joint.friction_angle = keys.friction_angle;
    joint.residual_friction_angle = keys.residual_friction_angle;
    joint.normal_stiffness = keys.normal_stiffness;
    joint.shear_stiffness = keys.shear_stiffness;
    joint.dilation_angle = keys.dilation_angle.value_or(0.0);
    if (keys.dilation_slip) joint.dilation_slip = *keys.dilation_slip;
    joint.aperture = keys.aperture.value_or(0.0);
    joint.residual_cohesion = keys.residual_cohesion;
    joint.softening_slip = keys.softening_slip;
    return joint;
}

MeasuredTraces traces_of(const TestCase& test, std::size_t number) {
    const TestCase::Trace& keys = test.trace[number];
    MeasuredTraces traces;
    if (keys.file) {
        const Vec2 offset = keys.offset ? Vec2{(*keys.offset)[0], (*keys.offset)[1]} : Vec2{};
        traces.from = TraceFile{test.resolve_path(fmt::format("trace[{}].file", number + 1), *keys.file),
                                keys.layer.value_or(""), keys.scale.value_or(1.0), offset};
    } else {
        std::vector<Vec2> points;
        for (std::size_t k = 0; k < keys.points->size(); k += 2)
            points.push_back({(*keys.points)[k], (*keys.points)[k + 1]});
        traces.from = std::move(points);
    }
    traces.name = keys.name   ? *keys.name
                  : keys.file ? std::filesystem::path(*keys.file).stem().string()
                              : fmt::format("trace {}", number + 1);
    traces.mechanics = mechanics_of(keys.own);
    return traces;
}

JointRequest joints_of(const TestCase& test, const Places& places) {
    JointRequest joints{test.joints, static_cast<std::uint64_t>(test.joints.seed), {}, {}, places};
    for (std::size_t k = 0; k < test.joint_set.size(); ++k) {
        const TestCase::JointSet& keys = test.joint_set[k];
        joints.sets.push_back({keys.name, directions_of(test, k), lengths_of(keys), amount_of(keys), keys.scan_line,
                               mechanics_of(keys.own)});
    }
    for (std::size_t k = 0; k < test.trace.size(); ++k) joints.traces.push_back(traces_of(test, k));
    return joints;
}

parts::Bonds bonds_of(const TestCase::Bond& keys) {
    parts::Bonds bonds{keys, {}};
    if (keys.strength_distribution != StrengthDistribution::none)
        bonds.random = parts::RandomStrengths{keys.strength_distribution, *keys.strength_cv, *keys.strength_seed};
    return bonds;
}

parts::Loading loading_of(const TestCase::Loading& keys) {
    parts::Loading loading;
    static_cast<parts::LoadingValues&>(loading) = keys;
    if (keys.axial_strain_rate)
        loading.rate = parts::StrainRate{*keys.axial_strain_rate};
    else
        loading.rate = parts::RateTolerance{*keys.rate_tolerance};
    const auto take = [](auto& value, const auto& given) {
        if (given) value = *given;
    };
    take(loading.grip, keys.grip);
    take(loading.platen_friction_angle, keys.platen_friction_angle);
    take(loading.half_angle, keys.half_angle);
    take(loading.jaws, keys.jaws);
    take(loading.normal_stress, keys.normal_stress);
    take(loading.normal_stiffness, keys.normal_stiffness);
    take(loading.control, keys.control);
    loading.unloading.by_strain = keys.unload_at_strain.has_value();
    take(loading.unloading.at, keys.unload_at_strain);
    take(loading.unloading.at, keys.unload_at_stress);
    take(loading.unloading.to, keys.unload_to);
    return loading;
}

/// If the variant `parts` holds a Part, which names a file, adds the path of that file to `files`.
template <class Part, class Variant>
void add_file(std::vector<std::filesystem::path>& files, const Variant& parts) {
    if (const auto* part = std::get_if<Part>(&parts)) files.push_back(part->path);
}

void add_files(std::vector<std::filesystem::path>& files, const JointRequest& joints) {
    for (const MeasuredTraces& traces : joints.traces) add_file<TraceFile>(files, traces.from);
}

}  // namespace

ResolvedCase resolve(const std::shared_ptr<const TestCase>& written) {
    const TestCase& test = *written;
    ResolvedCase resolved;
    resolved.places = Places(written);
    resolved.title = test.title;
    if (test.has_table("packing"))
        resolved.source = packing_of(test);
    else
        resolved.source = parts::ParticleFile{test.resolve_path("particles.file", *test.particles.file)};
    if (test.has_table("mesh")) resolved.mesh = mesh_of(test.mesh);
    resolved.material = material_of(test);
    resolved.minerals = minerals_of(test);
    resolved.joints = joints_of(test, resolved.places);
    resolved.bond = bonds_of(test.bond);
    resolved.shape = test.shape;
    resolved.loading = loading_of(test.loading);
    if (test.confinement.pressure)
        resolved.confinement = {*test.confinement.pressure, test.confinement.side.value_or(ConfiningSide::membrane)};
    resolved.numerics = test.numerics;
    resolved.output = test.output;
    if (resolved.mesh)
        if (const auto* gap = std::get_if<parts::MeshGap>(&resolved.mesh->gap))
            check_apertures(resolved.joints, gap->between_edges(), true);
    resolved.case_files = test.inputs;
    std::vector<std::filesystem::path>& files = resolved.data_files;
    add_file<parts::ParticleFile>(files, resolved.source);
    if (const parts::Packing* packing = resolved.packing()) add_file<parts::SieveFile>(files, packing->sizes);
    add_file<parts::GrainLabels>(files, resolved.minerals.assign);
    add_file<parts::GrainImage>(files, resolved.minerals.assign);
    add_files(files, resolved.joints);
    return resolved;
}

JointCase resolve_joints(const std::shared_ptr<const TestCase>& written) {
    JointCase found{joints_of(*written, Places(written)), written->packing.width, written->packing.height,
                    written->inputs};
    add_files(found.files, found.joints);
    return found;
}

std::shared_ptr<const TestCase> written_case(const ResolvedCase& test) {
    if (!test.places.written())
        throw InputError(
            fmt::format("{}: found a test whose parts were not read from a case, expected one that was", test.title));
    auto written = std::static_pointer_cast<const TestCase>(test.places.written());
    ResolvedCase read = resolve(written);
    read.numerics.threads = test.numerics.threads;
    read.numerics.allow_unstable = test.numerics.allow_unstable;
    read.step_scale = test.step_scale;
    if (test != read)
        throw InputError(
            fmt::format("{}: found a test whose parts were changed after its case was read, expected the "
                        "parts of the case; change its keys with settings (CaseFiles::with)",
                        test.title));
    return written;
}

}  // namespace crackle
