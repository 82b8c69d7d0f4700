// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "solver/base/version.hpp"
#include "specimens/emission/b_value.hpp"
#include "specimens/measures/crack_rose.hpp"
#include "specimens/measures/curve_analysis.hpp"
#include "specimens/measures/fragment_sizes.hpp"
#include "specimens/measures/parting.hpp"
#include "specimens/measures/shear_box.hpp"
#include "specimens/measures/verdicts.hpp"
#include "specimens/observers/profile_report.hpp"
#include "specimens/results/json_number.hpp"
#include "specimens/results/notices.hpp"
#include "specimens/results/numerical_errors.hpp"
#include "specimens/results/summary_keys.hpp"
#include "specimens/results/trace_figures.hpp"

namespace crackle {
namespace {

using Json = nlohmann::ordered_json;

/// How a key is declared. @param which of several meanings
const SummaryKey& declared_key(std::string_view name, int which = 0) {
    for (const SummaryKey& key : summary_keys())
        if (name == key.what.name && which-- == 0) return key;
    throw std::logic_error(fmt::format("summary.json: {} is written but not declared", name));
}

struct Writer {
    Json& json;
    Json& units;
    double out_of_plane_thickness;
    bool area_units;  ///< stresses are in Pa as they are

    std::string unit_of(const Quantity& what) const {
        std::string text = stated(what);
        const std::size_t at = area_units ? text.find("N/m") : std::string::npos;
        return at == std::string::npos ? text : text.replace(at, 3, "Pa");
    }

    void put(const std::string& key, Json value, int which = 0) {
        const SummaryKey& found = declared_key(key, which);
        json[key] = std::move(value);
        if (found.in_units) units[key] = unit_of(found.what);
    }
    /// A stress or modulus, with its conversion beside it.
    void stress(const std::string& key, double value) {
        put(key, finite_or_null(value));
        const std::string converted = key + converted_suffix;
        json[converted] = finite_or_null(area_units ? value : value / out_of_plane_thickness);
        units[converted] = area_units ? "Pa, the same number: units are of an area" : converted_unit;
    }
};

void describe(Writer& w, const TestCase& test, const TestSetup& setup, const TestState& state) {
    w.put("title", test.title);
    w.put("kind", test.loading.kind);
    w.put("specimen", setup.specimen);
    w.put("platens", test.loading.platens);
    w.put("bond_law", test.bond.law);
    w.put("material_units", test.material.units);
    w.put("failed", state.failure.failed);
    w.put("interrupted", state.ended_by == ended_by_interrupt);
    w.put("ended_by", state.ended_by.empty() ? Json(nullptr) : Json(state.ended_by));
    if (!state.failure.failed) {
        w.put(
            "note",
            fmt::format("the specimen has not failed (ended by {}): peak and moduli refer to the largest stress so far",
                        state.ended_by.empty() ? "nothing yet" : state.ended_by));
    }
}

void strength(Writer& w, const TestSetup& setup, const TestState& state, const FirstLoading& first) {
    const FailureTracker& f = state.failure;
    const std::string so_far = f.failed ? "" : "_so_far";
    w.stress("peak_stress" + so_far, f.peak_row < 0 ? NAN : f.peak_stress);
    w.put("peak_strain" + so_far, finite_or_null(f.peak_row < 0 ? NAN : f.peak_strain));
    w.stress("largest_stress", f.largest_row < 0 ? NAN : f.largest_stress);
    w.put("strain_at_largest_stress", finite_or_null(f.largest_row < 0 ? NAN : f.strain_at_largest));
    // Of other kinds stress over strain is none of the rock's moduli.
    w.stress("youngs_modulus", setup.uniaxial ? state.youngs_modulus : NAN);
    w.put("poissons_ratio", finite_or_null(state.poissons_ratio));
    w.stress("gauge_modulus", state.gauge_modulus);
    if (!setup.uniaxial) return;

    const Tangent initial = initial_tangent(first.rows, first.peak_row, setup.compression);
    w.stress("initial_tangent_modulus", initial.modulus);
    w.put("initial_poissons_ratio", finite_or_null(initial.poissons_ratio));
    w.put("initial_tangent_window", {{"rows", initial.rows},
                                     {"strain_to", initial.strain_to},
                                     {"bonds_broken", initial.bonds_broken},
                                     {"points_sliding", initial.points_sliding},
                                     {"contacts_gained", initial.contacts_gained}});
    const Tangent half = tangent_at_half_peak(first.rows, first.peak_row, setup.compression);
    w.stress("tangent_modulus_50", half.modulus);
    w.put("tangent_50_poissons_ratio", finite_or_null(half.poissons_ratio));
    const Tangent average = tangent_of_straightest(first.rows, first.peak_row, setup.compression);
    w.stress("average_modulus", average.modulus);
    w.put("average_poissons_ratio", finite_or_null(average.poissons_ratio));
    const Tangent secant = secant_to_half_peak(first.rows, first.peak_row, setup.compression);
    w.stress("secant_modulus_50", secant.modulus);
    w.put("secant_50_poissons_ratio", finite_or_null(secant.poissons_ratio));
    const double falling = f.failed ? tangent_beyond_peak(first.rows, first.peak_row, setup.compression).modulus : NAN;
    w.stress("post_peak_modulus", falling);
    w.put("brittleness_index", finite_or_null(brittleness_index(state.youngs_modulus, falling)));
}

/// Of a test that is not between platens: what its stress and strain are, and what follows from the peak.
void apparatus(Writer& w, const TestSetup& setup, const TestState& state, const FirstLoading& first) {
    if (setup.uniaxial) return;
    const FailureTracker& f = state.failure;
    const double peak = f.peak_row < 0 ? NAN : f.peak_stress;
    const std::string so_far = f.failed ? "" : "_so_far";
    w.put("stress_section", setup.section);
    w.put("strain_length", setup.length);
    w.put("peak_force" + so_far, finite_or_null(peak * setup.section));
    w.stress("nominal_modulus", state.youngs_modulus);
    if (setup.span > 0.0) w.put("span", setup.span);
    if (setup.notch > 0.0) {
        const double particle = std::sqrt(setup.area / static_cast<double>(setup.particles));
        w.put("notch", setup.notch);
        w.put("notch_over_particle", setup.notch / particle);
        w.put("fracture_toughness" + so_far, finite_or_null(setup.stress_intensity * peak));
    }
    if (setup.kind != "direct_shear") return;
    w.stress("normal_stress", setup.normal_force / setup.width);
    if (setup.normal_spring > 0.0) {
        // Where the box has risen by this share of the height.
        const auto grown = [&](double rise) {
            return (setup.normal_force + setup.normal_spring * rise * setup.height) / setup.width;
        };
        const bool known = first.peak_row >= 0;
        w.stress("normal_stress_at_peak" + so_far,
                 known ? grown(first.rows[static_cast<std::size_t>(first.peak_row)].lateral_strain) : NAN);
        w.stress("normal_stress_end", state.rows.empty() ? NAN : grown(state.rows.back().lateral_strain));
    }
    const ShearBoxFigures shear =
        measure_shear_box(first.rows, first.peak_row, state.ended_by == ended_by_strain, setup.height, setup.length);
    w.stress("residual_stress", shear.residual);
    w.put("dilation_angle_at_peak", finite_or_null(shear.dilation_at_peak));
    w.put("dilation_end", finite_or_null(state.rows.empty() ? NAN : state.rows.back().lateral_strain * setup.height));
}

/// Whether the test is one of what it is meant to be.
void validity(Writer& w, const TestSetup& setup, const TestState& state, const FirstLoading& first) {
    Json all = Json::array();
    bool every = true, known = true;
    for (const Verdict& verdict : verdicts_on(setup, first.rows, state.history, state.failure.failed)) {
        all.push_back({{"claim", verdict.claim},
                       {"holds", verdict.holds ? Json(*verdict.holds) : Json(nullptr)},
                       {"found", verdict.found}});
        every = every && verdict.holds.value_or(true);
        known = known && verdict.holds.has_value();
    }
    w.put("valid", !every ? Json(false) : known ? Json(true) : Json(nullptr));
    w.put("validity", all);
}

/// Of a confined test: what pressed it, and what a membrane has done.
void confinement(Writer& w, const TestSetup& setup, const TestState& state, const World& world) {
    if (!setup.confined()) return;
    const FailureTracker& f = state.failure;
    const std::string so_far = f.failed ? "" : "_so_far";
    w.stress("confining_pressure", setup.confining_pressure);
    w.stress("deviator_stress" + so_far, f.peak_row < 0 ? NAN : f.peak_stress - setup.confining_pressure);
    w.put("confining_side", setup.has_walls() ? "walls" : "membrane");
    if (setup.has_walls()) return;
    const Membrane& membrane = world.membrane;
    w.put("membrane", {{"points", membrane.points.size()},
                       {"wrapped", membrane.wrapped},
                       {"area_jumps", membrane.jumped},
                       {"open", membrane.open},
                       {"work", membrane.work}});
}

/// Stresses at which cracks begin and join, of a compression.
void cracking(Writer& w, const TestCase& test, const TestSetup& setup, const TestState& state) {
    const std::optional<CrackThresholds> known = crack_thresholds_of(test, setup, state);
    if (!known) return;
    const CrackThresholds& t = *known;
    const FailureTracker& f = state.failure;
    w.stress("crack_initiation_stress", t.count_break);
    w.put("crack_initiation_interval", {finite_or_null(t.low), finite_or_null(t.high)});
    w.put("crack_initiation_over_peak", finite_or_null(t.count_break / f.peak_stress));
    w.put("crack_initiation", {{"first_percent", finite_or_null(t.first_percent)},
                               {"crack_strain", finite_or_null(t.crack_strain)},
                               {"lateral_strain", finite_or_null(t.lateral_strain)},
                               {"spread", finite_or_null(t.spread())}});
    w.stress("crack_damage_stress", t.damage);
    w.put("crack_damage_strain", finite_or_null(t.damage_strain));
    w.put("crack_damage_over_peak", finite_or_null(t.damage / f.peak_stress));
}

/// What unloading and loading again has shown.
void cycles(Writer& w, const TestCase& test, const TestSetup& setup, const TestState& state) {
    if (!test.loading.unloads()) return;
    Json all = Json::array();
    for (LoadingCycle cycle : find_cycles(state.rows, setup.compression)) {
        if (cycle.linear && std::isfinite(state.youngs_modulus)) {
            cycle.modulus = state.youngs_modulus;
            cycle.permanent_strain = cycle.modulus_error = 0.0;
        }
        const double damage = cycle.unbroken ? 0.0 : 1.0 - cycle.modulus / state.youngs_modulus;
        all.push_back({{"strain", cycle.strain},
                       {"stress", cycle.stress},
                       {"low_strain", cycle.low_strain},
                       {"low_stress", cycle.low_stress},
                       {"modulus", finite_or_null(cycle.modulus)},
                       {"poissons_ratio", finite_or_null(setup.uniaxial ? cycle.poissons_ratio : NAN)},
                       {"modulus_error", finite_or_null(cycle.modulus_error)},
                       {"damage", finite_or_null(damage)},
                       {"permanent_strain", finite_or_null(cycle.permanent_strain)},
                       {"loss", finite_or_null(cycle.loop * setup.section * setup.length)}});
    }
    w.put("cycles", all);
}

/// Where the platens' work has gone up to a row.
Json energy_of(const CurveRow& first, const CurveRow& row) {
    const double work = row.platen_work + row.confinement_work;
    const auto share = [&](double energy) { return finite_or_null(energy / work); };
    return {{"work", work},
            {"strain", share(row.strain_energy - first.strain_energy)},
            {"kinetic", share(row.kinetic_energy - first.kinetic_energy)},
            {"friction", share(row.friction_loss)},
            {"fracture", share(row.fracture_loss)},
            {"dashpot", share(row.dashpot_loss)}};
}

void energies(Writer& w, const TestState& state) {
    const std::vector<CurveRow>& rows = state.rows;
    const std::int64_t peak = state.failure.peak_row;
    w.put("energy_at_peak", peak < 0 ? Json(nullptr) : energy_of(rows.front(), rows[static_cast<std::size_t>(peak)]));
    w.put("energy_at_end", rows.empty() ? Json(nullptr) : energy_of(rows.front(), rows.back()));
}

Json rose_of(const Rose& rose) {
    return {{"cracks", rose.count},
            {"length", rose.weight},
            {"direction", finite_or_null(rose.mean_direction())},
            {"resultant", finite_or_null(rose.resultant())},
            {"rayleigh", finite_or_null(rose.rayleigh())},
            {"lengths", rose.weights}};
}

void directions(Writer& w, const TestSetup& setup, const TestState& state, const World& world) {
    const std::int64_t peak = state.failure.peak_row;
    const double time_of_peak = peak < 0 ? NAN : state.rows[static_cast<std::size_t>(peak)].time;
    const CrackRoses roses = find_crack_roses(world, setup, state.history, time_of_peak);
    w.put("crack_rose", {{"tension_to_peak", rose_of(roses.tension_to_peak)},
                         {"shear_to_peak", rose_of(roses.shear_to_peak)},
                         {"tension_after", rose_of(roses.tension_after)},
                         {"shear_after", rose_of(roses.shear_after)}});
}

/// What has become of the specimen up to the peak and to the end.
void damage(Writer& w, const TestSetup& setup, const TestState& state, const World& world) {
    w.put("bonds_broken", world.bonds.broken);
    w.put("bonds_broken_after_sliding", state.breaks_after_sliding);
    w.put("bonds_broken_in_shear", state.breaks_in_shear);
    w.put("bonds_broken_in_tension", state.breaks_in_tension);
    w.put("bonds_broken_in_shear_to_peak", state.breaks_in_shear_to_peak);
    w.put("bonds_broken_in_tension_to_peak", state.breaks_in_tension_to_peak);
    w.put("interfaces_lost", world.bonds.interfaces_lost);
    const std::vector<CurveRow>& rows = state.rows;
    const std::int64_t peak = state.failure.peak_row;
    const auto area_strain_of = [&](const CurveRow& row) {
        return setup.uniaxial ? area_strain(row, setup.compression) : NAN;
    };
    w.put("area_strain_peak", finite_or_null(peak < 0 ? NAN : area_strain_of(rows[static_cast<std::size_t>(peak)])));
    w.put("area_strain_end", finite_or_null(rows.empty() ? NAN : area_strain_of(rows.back())));
    Frame now;
    take_frame(world, setup, state.history, rows.empty() ? CurveRow{} : rows.back(), 0, now);
    const FragmentSizes fragments = measure_fragments(world, setup, now);
    w.put("fragments", fragments.count);
    w.put("largest_fragment_share", fragments.largest_share);
    w.put("fragment_size_median", finite_or_null(fragments.median_size));
    w.put("fragment_rosin_rammler", {{"size", finite_or_null(fragments.law.size)},
                                     {"exponent", finite_or_null(fragments.law.exponent)},
                                     {"fragments", fragments.law.pieces}});
    const std::optional<Parting> parting = setup.uniaxial ? find_parting(setup, state.history) : std::nullopt;
    w.put("failed_at", parting ? Json(parting->place) : Json(nullptr));
    w.put("largest_crack",
          parting ? Json{{"bonds", parting->bonds}, {"of_platen", parting->of_platen}, {"height", parting->height}}
                  : Json(nullptr));
}

void joints(Writer& w, const TestSetup& setup, const TestState& state, const World& world) {
    if (setup.traces.empty()) return;
    const Json figures = trace_figures(setup, state, world);
    for (const auto& [key, value] : figures.items()) w.put(key, value);
}

void acoustic_emission(Writer& w, const TestState& state) {
    const EmissionRule& rule = state.emission.rule;
    if (!rule.on()) {
        w.put("emission", nullptr);
        w.put("b_value", nullptr);
        return;
    }
    std::vector<double> magnitudes;
    std::array<std::int64_t, 3> types{};
    double largest = -std::numeric_limits<double>::infinity();
    for (const AcousticEvent& event : state.emission.events) {
        const double magnitude = moment_magnitude(event, rule.thickness);
        if (!std::isfinite(magnitude)) continue;
        magnitudes.push_back(magnitude);
        largest = std::max(largest, magnitude);
        ++types[static_cast<std::size_t>(source_type(isotropic_percent(event.moment)))];
    }
    const auto count = static_cast<double>(magnitudes.size());
    const auto share = [&](SourceType type) {
        return finite_or_null(static_cast<double>(types[static_cast<std::size_t>(type)]) / count);
    };
    w.put("emission", {{"events", state.emission.events.size()},
                       {"opening", share(SourceType::opening)},
                       {"shear", share(SourceType::shear)},
                       {"closing", share(SourceType::closing)},
                       {"without_moment", state.emission.events.size() - magnitudes.size()},
                       {"largest_magnitude", finite_or_null(largest)},
                       {"radius", rule.diameter},
                       {"window", rule.window(rule.diameter)},
                       {"shear_wave_speed", rule.shear_wave_speed},
                       {"speed_from", rule.mean_field ? "mean field" : "moduli"},
                       {"density", rule.density},
                       {"damping_ratio", finite_or_null(rule.damping_ratio)}});
    const BValue value = fit_b_value(magnitudes, Completeness::maximum_curvature),
                 other = fit_b_value(magnitudes, Completeness::least_distance);
    w.put("b_value", {{"b", finite_or_null(value.b)},
                      {"error", finite_or_null(value.standard_error)},
                      {"interval", {finite_or_null(value.low), finite_or_null(value.high)}},
                      {"events", value.events},
                      {"few", value.of_few()},
                      {"completeness", finite_or_null(value.completeness)},
                      {"straight", value.known() ? Json(value.straight) : Json(nullptr)},
                      {"least_distance",
                       {{"b", finite_or_null(other.b)},
                        {"events", other.events},
                        {"completeness", finite_or_null(other.completeness)}}}});
}

void counts(Writer& w, const TestSetup& setup, const World& world) {
    w.put("initial_width", setup.width);
    w.put("initial_height", setup.height);
    w.put("particles", setup.particles);
    if (setup.centres > 0) w.put("seeds", setup.centres);
    if (setup.polygons) w.put("segments", setup.segments);
    w.put("bond_thick", setup.bond_thick);
    w.put("contacts_initial", setup.contacts_initial);
    w.put("bonds_initial", world.bonds.initial);
    w.put("interfaces_initial", world.bonds.interfaces_initial);
    w.put("mean_back_tension", setup.mean_back_tension);
    w.put("mean_back_tension_interface", setup.mean_back_tension_interface);
    w.put("mean_bond_overlap", setup.mean_bond_overlap);
    if (setup.coulomb_bonds) {
        w.put("mean_tensile_strength", setup.mean_tensile_strength);
        w.put("mean_cohesion", setup.mean_cohesion);
    }
    w.put("bonds_unbreakable", world.bonds.held);
    w.put("grip", setup.grip);
    w.put("platen_bottom_id", setup.bottom_id);
    w.put("platen_top_id", setup.top_id);
}

/// Stress that the dashpots bear when loading by tolerance begins, over the largest one.
double viscous_share(const TestCase& test, const TestState& state) {
    if (!test.loading.rate_tolerance || state.rows.empty()) return NAN;
    const double confined = test.confinement.pressure.value_or(0.0);
    return (state.rows.front().axial_stress - confined) / (state.failure.largest_stress - confined);
}

void numerics(Writer& w, const TestCase& test, const TestSetup& setup, const TestState& state, const World& world) {
    const CurveRow last = state.rows.empty() ? CurveRow{} : state.rows.back();
    if (test.loading.rate_tolerance) {
        const RateState& rate = state.rate;
        w.put("rate_tolerance", *test.loading.rate_tolerance);
        w.put("axial_strain_rate", finite_or_null(state.mean_rate()));
        w.put("axial_strain_rate_range", {rate.slowest, rate.fastest});
        w.put("strain_share_above_tolerance", finite_or_null(state.share_above_tolerance()));
        w.put("wave_transit_time", setup.rate_rule.transit_time);
    } else {
        w.put("axial_strain_rate",
              finite_or_null(state.path.by_caller() ? state.mean_rate() : *test.loading.axial_strain_rate), 1);
    }
    w.put("viscous_stress_share", finite_or_null(viscous_share(test, state)));
    w.put("axial_strain_end", last.axial_strain);
    w.put("energy_closing_error", finite_or_null(last.energy_error / last.platen_work));
    if (world.settings.segment_law != SegmentLaw::rounded) {
        w.put("energy_lost_to_contact_law", finite_or_null(world.account.law_loss / last.platen_work));
    }
    w.put("platen_out_of_balance", finite_or_null(platen_out_of_balance(state.rows, state.failure.peak_row)));
    w.put("time_step", world.stepping.time_step);
    w.put("time_step_mean", finite_or_null(world.stepping.time / static_cast<double>(world.stepping.steps)));
    w.put("stable_time_step", finite_or_null(setup.stable_time_step),
          world.settings.segment_law != SegmentLaw::rounded ? 1
          : setup.stable_time_step_proved                   ? 0
                                                            : 2);
    w.put("time_step_over_stable", finite_or_null(world.stepping.time_step / setup.stable_time_step));
    w.put("time_step_bound", setup.time_step_bound);
    w.put("steps", world.stepping.steps);
    w.put("simulated_time", world.stepping.time);
    w.put("list_builds", world.list.builds);
    w.put("seed", test.has_table("packing") ? Json(test.packing.seed) : Json(nullptr));
}

void packing(Writer& w, const TestSetup& setup) {
    if (setup.packing.empty()) return;
    Json figures;
    for (const auto& [name, value] : setup.packing) figures[name] = finite_or_null(value);
    w.put("packing", figures);
}

void minerals(Writer& w, const TestSetup& setup) {
    if (setup.minerals.empty()) return;
    Json all = Json::array();
    for (const MineralShare& m : setup.minerals) {
        all.push_back({{"name", m.name},
                       {"area_share", m.asked ? finite_or_null(*m.asked) : Json(nullptr)},
                       {"area_share_reached", finite_or_null(m.reached)},
                       {"grains", m.grains}});
    }
    w.put("minerals", all);
}

Json error_of(const NumberError* measured, double closing) {
    const auto value = [&](double NumberError::*part) {
        return measured != nullptr ? finite_or_null(measured->*part) : Json(nullptr);
    };
    return {{"time_step", value(&NumberError::time_step)},   {"rate", value(&NumberError::rate)},
            {"energy_closing", finite_or_null(closing)},     {"damping", value(&NumberError::damping)},
            {"resolution", value(&NumberError::resolution)}, {"stated", value(&NumberError::stated)}};
}

void numerical_errors(Writer& w, const TestSetup& setup, const TestState& state, const NumericalErrors* errors) {
    const CurveRow last = state.rows.empty() ? CurveRow{} : state.rows.back();
    const double closing = std::abs(last.energy_error / last.platen_work);
    // A solve, not a run: neither step nor rate enters.
    const NumberError solved{};
    Json all{{"youngs_modulus", error_of(&solved, NAN)},
             {"peak_stress", error_of(errors != nullptr ? &errors->peak_stress : nullptr, closing)},
             {"peak_strain", error_of(errors != nullptr ? &errors->peak_strain : nullptr, closing)}};
    all["youngs_modulus"]["stated"] = finite_or_null(state.modulus_residual);
    const bool cracking = setup.compression && setup.uniaxial;
    const auto of = [&](const std::optional<NumberError> NumericalErrors::*which) {
        return error_of(errors != nullptr && errors->*which ? &*(errors->*which) : nullptr, closing);
    };
    if (cracking) {
        all["crack_initiation_stress"] = of(&NumericalErrors::crack_initiation_stress);
        all["crack_damage_stress"] = of(&NumericalErrors::crack_damage_stress);
    }
    if (errors != nullptr) {
        for (const Companion& c : errors->companions) {
            all["companions"][c.name] = {{"peak_stress", finite_or_null(c.peak_stress)},
                                         {"peak_strain", finite_or_null(c.peak_strain)},
                                         {"ended_by", c.ended_by},
                                         {"steps", c.steps},
                                         {"time_step", finite_or_null(c.time_step)},
                                         {"axial_strain_rate", finite_or_null(c.axial_strain_rate)},
                                         {"damping", finite_or_null(c.damping)},
                                         {"post_peak_difference", finite_or_null(c.post_peak_difference)}};
            if (!cracking) continue;
            all["companions"][c.name]["crack_initiation_stress"] = finite_or_null(c.crack_initiation_stress);
            all["companions"][c.name]["crack_damage_stress"] = finite_or_null(c.crack_damage_stress);
        }
    }
    w.put("numerical_errors", all);
    const bool judged = errors != nullptr && errors->peak_converged.has_value();
    w.put("peak_converged", judged ? Json(*errors->peak_converged) : Json(nullptr));
}

void frames(Writer& w, const TestState& state) {
    const auto name = [](std::int64_t row) { return "frames/" + particles_file(row); };
    const auto& list = state.frames;
    w.put("frame_start", list.empty() ? Json(nullptr) : Json(name(list.front().row)));
    w.put("frame_peak",
          list.empty() || state.failure.peak_row < 0 ? Json(nullptr) : Json(name(state.failure.peak_row)));
    w.put("frame_end", list.empty() ? Json(nullptr) : Json(name(list.back().row)));
}

}  // namespace

FirstLoading judged_rows(const TestCase& test, const TestState& state) {
    return test.loading.unloads() ? first_loading(state.rows, state.failure.peak_row)
                                  : FirstLoading{state.rows, state.failure.peak_row};
}

std::optional<CrackThresholds> crack_thresholds_of(const TestCase& test, const TestSetup& setup,
                                                   const TestState& state) {
    if (!setup.compression || !setup.uniaxial) return std::nullopt;
    const FirstLoading first = judged_rows(test, state);
    return find_crack_thresholds(first.rows, first.peak_row, state.youngs_modulus, state.poissons_ratio,
                                 setup.confining_pressure);
}

TestSummary make_summary(const TestCase& test, const TestSetup& setup, const TestState& state, const World& world,
                         const TestTiming& timing, const NumericalErrors* errors) {
    Json json, units;
    const std::optional<double>& thickness = test.output.out_of_plane_thickness;
    Writer w{json, units, thickness.value_or(1.0), test.area_units()};
    describe(w, test, setup, state);
    const FirstLoading first = judged_rows(test, state);
    strength(w, setup, state, first);
    apparatus(w, setup, state, first);
    validity(w, setup, state, first);
    confinement(w, setup, state, world);
    cracking(w, test, setup, state);
    cycles(w, test, setup, state);
    damage(w, setup, state, world);
    directions(w, setup, state, world);
    joints(w, setup, state, world);
    acoustic_emission(w, state);
    energies(w, state);
    counts(w, setup, world);
    numerics(w, test, setup, state, world);
    numerical_errors(w, setup, state, errors);
    packing(w, setup);
    minerals(w, setup);
    frames(w, state);
    w.put("out_of_plane_thickness", thickness ? Json(*thickness) : Json(nullptr));
    w.put("notices", notices_of(test, setup, state, world, viscous_share(test, state)));
    if (errors != nullptr) {
        const std::string notice = notice_of_companions(state.failure, *errors);
        if (!notice.empty()) json["notices"].push_back(notice);
    }
    w.put("version", project_version);
    w.put("compiler", __VERSION__);
    w.put("command", state.command);
    w.put("threads", timing.threads);
    w.put("wall_seconds", timing.wall_seconds);
    w.put("step_seconds", timing.step_seconds);
    w.put("particle_steps_per_second", finite_or_null(static_cast<double>(setup.particles) *
                                                      static_cast<double>(world.stepping.steps) / timing.step_seconds));
    if (world.workers.profile != nullptr)
        w.put("profile",
              profile_report(*world.workers.profile, setup.particles, world.stepping.steps, timing.step_seconds));
    Json columns;
    for (const CurveColumn& column : curve_columns())
        if (!column.pressed || setup.pressed()) columns[column.what.name] = w.unit_of(column.what);
    w.put("columns", columns);
    w.put("units", units);
    return TestSummary(std::move(json));
}

}  // namespace crackle
