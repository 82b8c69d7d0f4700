// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/make_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "solver/base/version.hpp"
#include "specimens/emission/b_value.hpp"
#include "specimens/measures/crack_rose.hpp"
#include "specimens/measures/curve_analysis.hpp"
#include "specimens/measures/fragment_sizes.hpp"
#include "specimens/measures/parting.hpp"
#include "specimens/measures/shear_box.hpp"
#include "specimens/measures/verdicts.hpp"
#include "specimens/observers/profile_report.hpp"
#include "specimens/results/notices.hpp"
#include "specimens/results/numerical_errors.hpp"
#include "specimens/results/trace_figures.hpp"
#include "specimens/summary/summary_keys.hpp"

namespace crackle {
namespace {

Description describe(const ResolvedCase& test, const TestedSpecimen& specimen, const TestState& state) {
    const bool failed = state.failure.failed, running = state.ended_by.empty();
    Description d{test.title,
                  test.loading.kind,
                  specimen.kind,
                  test.loading.platens,
                  test.bond.law,
                  test.material.units,
                  failed,
                  state.ended_by == ended_by_interrupt,
                  running ? std::nullopt : std::optional(state.ended_by)};
    if (!failed)
        d.note = fmt::format(
            "the specimen has not failed (reason for the end of the test: {}); the peak and the moduli refer to the "
            "largest stress reached",
            running ? "not ended yet" : state.ended_by);
    return d;
}

void strength(Strength& s, const PlacedApparatus& apparatus, const TestState& state, const FirstLoading& first) {
    const FailureTracker& f = state.failure;
    (f.failed ? s.peak_stress : s.peak_stress_so_far) = f.peak_row < 0 ? NAN : f.peak_stress;
    (f.failed ? s.peak_strain : s.peak_strain_so_far) = f.peak_row < 0 ? NAN : f.peak_strain;
    s.largest_stress = f.largest_row < 0 ? NAN : f.largest_stress;
    s.strain_at_largest_stress = f.largest_row < 0 ? NAN : f.strain_at_largest;
    // If the test is not uniaxial, stress divided by strain is not a modulus of the rock.
    s.youngs_modulus = apparatus.uniaxial ? state.youngs_modulus : NAN;
    s.poissons_ratio = state.poissons_ratio;
    s.gauge_modulus = state.gauge_modulus;
    if (!apparatus.uniaxial) return;

    const auto measure = [&](const auto& tangent, Stress& modulus, Number& poissons_ratio) {
        const Tangent found = tangent(first.rows, first.peak_row, apparatus.compression);
        modulus = found.modulus;
        poissons_ratio = found.poissons_ratio;
        return found;
    };
    const Tangent initial = measure(initial_tangent, s.initial_tangent_modulus, s.initial_poissons_ratio);
    s.initial_tangent_window = TangentWindow{initial.rows, initial.strain_to, initial.bonds_broken,
                                             initial.points_sliding, initial.contacts_gained};
    measure(tangent_at_half_peak, s.tangent_modulus_50, s.tangent_50_poissons_ratio);
    measure(tangent_of_straightest, s.average_modulus, s.average_poissons_ratio);
    measure(secant_to_half_peak, s.secant_modulus_50, s.secant_50_poissons_ratio);
    const double falling =
        f.failed ? tangent_beyond_peak(first.rows, first.peak_row, apparatus.compression).modulus : NAN;
    s.post_peak_modulus = falling;
    s.brittleness_index = brittleness_index(state.youngs_modulus, falling);
}

/// Adds the definitions of stress and strain for a test without platens, and results derived from the peak.
void nominal(NominalFigures& n, const TestSetup& setup, const TestState& state, const FirstLoading& first) {
    if (setup.apparatus.uniaxial) return;
    const FailureTracker& f = state.failure;
    const double peak = f.peak_row < 0 ? NAN : f.peak_stress;
    n.stress_section = setup.apparatus.section;
    n.strain_length = setup.apparatus.length;
    (f.failed ? n.peak_force : n.peak_force_so_far) = peak * setup.apparatus.section;
    n.nominal_modulus = state.youngs_modulus;
    if (setup.apparatus.span > 0.0) n.span = setup.apparatus.span;
    if (setup.specimen.notch > 0.0) {
        const double particle = std::sqrt(setup.specimen.area / static_cast<double>(setup.specimen.particles));
        n.notch = setup.specimen.notch;
        n.notch_over_particle = setup.specimen.notch / particle;
        // A weak face at the notch may break before the largest load, which is a peak but not the end of the specimen.
        const double largest = f.largest_row < 0 ? NAN : f.largest_stress;
        (f.failed ? n.fracture_toughness : n.fracture_toughness_so_far) = setup.apparatus.stress_intensity * largest;
    }
    if (!test_kind(setup.apparatus.kind).shear_box) return;
    n.normal_stress = setup.apparatus.normal_force / setup.specimen.width;
    if (setup.apparatus.normal_spring > 0.0) {
        // Normal stress when the upper half box has risen by `rise` times the height of the specimen.
        const auto grown = [&](double rise) {
            return (setup.apparatus.normal_force + setup.apparatus.normal_spring * rise * setup.specimen.height) /
                   setup.specimen.width;
        };
        const bool known = first.peak_row >= 0;
        (f.failed ? n.normal_stress_at_peak : n.normal_stress_at_peak_so_far) =
            known ? grown(first.rows[static_cast<std::size_t>(first.peak_row)].lateral_strain) : NAN;
        n.normal_stress_end = state.rows.empty() ? NAN : grown(state.rows.back().lateral_strain);
    }
    const ShearBoxFigures shear = measure_shear_box(first.rows, first.peak_row, state.ended_by == ended_by_strain,
                                                    setup.specimen.height, setup.apparatus.length);
    n.residual_stress = shear.residual;
    n.dilation_angle_at_peak = shear.dilation_at_peak;
    n.dilation_end = state.rows.empty() ? NAN : state.rows.back().lateral_strain * setup.specimen.height;
}

/// Adds whether the test is valid for its purpose.
void validity(Validity& v, const TestSetup& setup, const TestState& state, const FirstLoading& first) {
    std::vector<JudgedClaim>& all = v.validity.begin_table();
    bool every = true, known = true;
    for (const Verdict& verdict : verdicts_on(setup, first.rows, state.history, state.failure.failed)) {
        all.push_back({verdict.claim, verdict.holds, verdict.found});
        every = every && verdict.holds.value_or(true);
        known = known && verdict.holds.has_value();
    }
    v.valid = known || !every ? std::optional(every) : std::nullopt;
}

/// Adds the pressure of a confined test, and the work of its membrane or walls.
void confinement(ConfinementFigures& c, const PlacedApparatus& apparatus, const TestState& state, const World& world) {
    if (!apparatus.confined()) return;
    const FailureTracker& f = state.failure;
    c.confining_pressure = apparatus.confining_pressure;
    (f.failed ? c.deviator_stress : c.deviator_stress_so_far) =
        f.peak_row < 0 ? NAN : f.peak_stress - apparatus.confining_pressure;
    c.confining_side = apparatus.has_walls() ? ConfiningSide::walls : ConfiningSide::membrane;
    if (apparatus.has_walls()) return;
    const Membrane& m = world.membrane;
    c.membrane = MembraneFigures{m.points.size(), m.wrapped, m.jumped, m.open, m.work};
}

/// Adds the stresses at which cracks start to form and to coalesce, if this is a compression test.
void cracking(CrackingFigures& c, const parts::Loading& loading, const TestSetup& setup, const TestState& state) {
    const std::optional<CrackThresholds> t = crack_thresholds_of(loading, setup.apparatus, state);
    if (!t) return;
    const double peak = state.failure.peak_stress;
    c.crack_initiation_stress = t->initiation();
    c.crack_initiation_error = t->initiation_error();
    c.crack_initiation_over_peak = t->initiation() / peak;
    c.crack_initiation =
        OtherInitiation{t->lateral_compliance, t->first_percent,  t->count_break, std::vector<double>{t->low, t->high},
                        t->crack_strain,       t->lateral_strain, t->spread()};
    c.crack_damage_stress = t->damage;
    c.crack_damage_error = t->damage_error;
    c.crack_damage_reversal = t->reversal;
    c.crack_damage_strain = t->damage_strain;
    c.crack_damage_over_peak = t->damage / peak;
}

/// @param bonds  number of bonds when loading began
std::vector<CycleFigures> cycles(const PlacedApparatus& apparatus, const TestState& state, std::int64_t bonds) {
    std::vector<CycleFigures> all;
    for (LoadingCycle cycle : find_cycles(state.rows, apparatus.compression)) {
        if (cycle.collapsed(bonds))
            cycle.modulus = cycle.poissons_ratio = cycle.modulus_error = cycle.permanent_strain = NAN;
        if (cycle.linear && std::isfinite(state.youngs_modulus)) {
            cycle.modulus = state.youngs_modulus;
            cycle.permanent_strain = cycle.modulus_error = 0.0;
        }
        all.push_back({cycle.strain, cycle.stress, cycle.low_strain, cycle.low_stress, cycle.modulus,
                       apparatus.uniaxial ? cycle.poissons_ratio : NAN, cycle.modulus_error,
                       cycle.unbroken ? 0.0 : 1.0 - cycle.modulus / state.youngs_modulus, cycle.permanent_strain,
                       cycle.loop * apparatus.section * apparatus.length});
    }
    return all;
}

/// Adds the damage of the specimen up to the peak and to the end.
void damage(DamageFigures& d, const TestSetup& setup, const TestState& state, const World& world) {
    d.bonds_broken = world.bonds.broken;
    d.bonds_broken_after_sliding = state.breaks_after_sliding;
    d.bonds_broken_in_shear = state.breaks_in_shear;
    d.bonds_broken_in_tension = state.breaks_in_tension;
    d.bonds_broken_in_shear_to_peak = state.breaks_in_shear_to_peak;
    d.bonds_broken_in_tension_to_peak = state.breaks_in_tension_to_peak;
    d.interfaces_lost = world.bonds.interfaces_lost;
    const std::vector<CurveRow>& rows = state.rows;
    const std::int64_t peak = state.failure.peak_row;
    const auto area_strain_of = [&](const CurveRow& row) {
        return setup.apparatus.uniaxial ? area_strain(row, setup.apparatus.compression) : NAN;
    };
    d.area_strain_peak = peak < 0 ? NAN : area_strain_of(rows[static_cast<std::size_t>(peak)]);
    d.area_strain_end = rows.empty() ? NAN : area_strain_of(rows.back());
    Frame now;
    take_frame(world, setup.bonds, state.history, rows.empty() ? CurveRow{} : rows.back(), 0, now);
    const FragmentSizes fragments = measure_fragments(world, setup, now);
    d.fragments = fragments.count;
    d.largest_fragment_share = fragments.largest_share;
    d.fragment_size_median = fragments.median_size;
    d.fragment_rosin_rammler = FragmentLaw{fragments.law.size, fragments.law.exponent, fragments.law.pieces};
    const std::optional<Parting> p = setup.apparatus.uniaxial ? find_parting(setup, state.history) : std::nullopt;
    d.failed_at = p ? std::optional(name_of(p->place)) : std::nullopt;
    d.largest_crack = p ? std::optional(LargestCrack{p->bonds, p->of_platen, p->height}) : std::nullopt;
}

RoseFigures rose_of(const Rose& rose) {
    return {rose.count,       rose.weight,     rose.mean_direction(),
            rose.resultant(), rose.rayleigh(), std::vector<double>(rose.weights.begin(), rose.weights.end())};
}

RosesByKind directions(const TestSetup& setup, const TestState& state, const World& world) {
    const std::int64_t peak = state.failure.peak_row;
    const double time_of_peak = peak < 0 ? NAN : state.rows[static_cast<std::size_t>(peak)].time;
    const CrackRoses roses = find_crack_roses(world, setup, state.history, time_of_peak);
    return {rose_of(roses.tension_to_peak), rose_of(roses.shear_to_peak), rose_of(roses.tension_after),
            rose_of(roses.shear_after)};
}

void acoustic_emission(Summary& s, const TestState& state) {
    s.emission = std::nullopt;
    s.b_value = std::nullopt;
    const EmissionRule& rule = state.emission.rule;
    if (!rule.on()) return;
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
        return static_cast<double>(types[static_cast<std::size_t>(type)]) / count;
    };
    s.emission = EmissionFigures{state.emission.events.size(),
                                 share(SourceType::opening),
                                 share(SourceType::shear),
                                 share(SourceType::closing),
                                 state.emission.events.size() - magnitudes.size(),
                                 largest,
                                 rule.diameter,
                                 rule.window(rule.diameter),
                                 rule.shear_wave_speed,
                                 rule.mean_field ? "mean field" : "moduli",
                                 rule.density,
                                 rule.damping_ratio};
    const BValue value = fit_b_value(magnitudes, Completeness::maximum_curvature),
                 other = fit_b_value(magnitudes, Completeness::least_distance);
    s.b_value = BValueFigures{value.b,
                              value.standard_error,
                              std::vector<double>{value.low, value.high},
                              value.events,
                              value.of_few(),
                              value.completeness,
                              value.known() ? std::optional(value.straight) : std::nullopt,
                              OtherBValue{other.b, other.events, other.completeness}};
}

/// Energies up to a row as fractions of the work done on the specimen.
EnergyShares energy_of(const CurveRow& first, const CurveRow& row) {
    const double work = row.platen_work + row.confinement_work;
    return {work,
            (row.strain_energy - first.strain_energy) / work,
            (row.kinetic_energy - first.kinetic_energy) / work,
            row.friction_loss / work,
            row.fracture_loss / work,
            row.dashpot_loss / work};
}

void energies(Summary& s, const TestState& state) {
    const std::vector<CurveRow>& rows = state.rows;
    s.energy_at_peak = s.energy_at_end = std::nullopt;
    if (const std::int64_t peak = state.failure.peak_row; peak >= 0)
        s.energy_at_peak = energy_of(rows.front(), rows[static_cast<std::size_t>(peak)]);
    if (!rows.empty()) s.energy_at_end = energy_of(rows.front(), rows.back());
}

void counts(SpecimenFigures& s, const TestSetup& setup, const World& world) {
    s.initial_width = setup.specimen.width;
    s.initial_height = setup.specimen.height;
    s.particles = setup.specimen.particles;
    if (setup.origin.centres > 0) s.seeds = setup.origin.centres;
    if (setup.specimen.polygons) s.segments = setup.origin.segments;
    s.bond_thick = setup.bonds.thick;
    s.contacts_initial = setup.bonds.contacts_initial;
    s.bonds_initial = world.bonds.initial;
    s.interfaces_initial = world.bonds.interfaces_initial;
    s.mean_back_tension = setup.bonds.mean_back_tension;
    s.mean_back_tension_interface = setup.bonds.mean_back_tension_interface;
    s.mean_bond_overlap = setup.bonds.mean_overlap;
    if (setup.bonds.facts().strengths_are_given) {
        s.mean_tensile_strength = setup.bonds.mean_tensile_strength;
        s.mean_cohesion = setup.bonds.mean_cohesion;
    }
    s.bonds_unbreakable = world.bonds.held;
    s.grip = setup.bonds.grip;
    s.platen_bottom_id = setup.apparatus.bottom_id;
    s.platen_top_id = setup.apparatus.top_id;
}

/// Stress carried by the dashpots at the start of loading, divided by the largest stress; NaN unless the case gives
/// rate_tolerance.
double viscous_share(const parts::Procedure& test, const TestState& state) {
    if (test.loading.rate_tolerance() == nullptr || state.rows.empty()) return NAN;
    const double confined = test.pressure();
    return (state.rows.front().axial_stress - confined) / (state.failure.largest_stress - confined);
}

void numerics(NumericsFigures& n, const parts::Procedure& test, const TestSetup& setup, const TestState& state,
              const World& world) {
    const CurveRow last = state.rows.empty() ? CurveRow{} : state.rows.back();
    const bool rounded = world.settings.segment_law == SegmentLaw::rounded;
    if (const double* tolerance = test.loading.rate_tolerance()) {
        n.rate_tolerance = *tolerance;
        n.axial_strain_rate = state.mean_rate();
        n.axial_strain_rate_range = std::vector<double>{state.rate.slowest, state.rate.fastest};
        n.strain_share_above_tolerance = state.share_above_tolerance();
        n.wave_transit_time = setup.rate_rule.transit_time;
    } else {
        n.axial_strain_rate = state.path.by_caller() ? state.mean_rate() : *test.loading.axial_strain_rate();
        n.axial_strain_rate.sense = 1;
    }
    n.viscous_stress_share = viscous_share(test, state);
    n.axial_strain_end = last.axial_strain;
    n.energy_closing_error = last.energy_error / last.platen_work;
    if (!rounded) n.energy_lost_to_contact_law = world.account.law_loss / last.platen_work;
    n.platen_out_of_balance = platen_out_of_balance(state.rows, state.failure.peak_row);
    n.time_step = world.stepping.time_step;
    n.time_step_mean = world.stepping.time / static_cast<double>(world.stepping.steps);
    n.stable_time_step = setup.stable_time_step;
    n.stable_time_step.sense = !rounded ? 1 : setup.stable_time_step_proved ? 0 : 2;
    n.time_step_over_stable = world.stepping.time_step / setup.stable_time_step;
    n.time_step_bound = setup.time_step_bound;
    n.steps = world.stepping.steps;
    n.simulated_time = world.stepping.time;
    n.list_builds = world.list.builds;
}

PackingFigures packing(const Provenance& origin) {
    PackingFigures figures;
    for (const auto& quantity : origin.packing) {
        PackingFigures::fields(figures, [&](std::string_view member, Number& figure, const FigureRow& /*row*/) {
            if (member == quantity.first) figure = quantity.second;
        });
    }
    return figures;
}

std::vector<MineralFigures> minerals(const Provenance& origin) {
    std::vector<MineralFigures> all;
    all.reserve(origin.minerals.size());
    for (const MineralShare& m : origin.minerals) all.push_back({m.name, m.asked, m.reached, m.grains});
    return all;
}

void numerical_errors(Summary& s, const PlacedApparatus& apparatus, const TestState& state,
                      const NumericalErrors* errors) {
    const CurveRow last = state.rows.empty() ? CurveRow{} : state.rows.back();
    const auto none = std::nullopt;
    const ErrorFigures unknown{none, none, none, none, none, none};
    ErrorsByFigure& all = s.numerical_errors.begin_table();
    all.peak_stress = all.peak_strain = unknown;
    if (apparatus.compression && apparatus.uniaxial) all.crack_initiation_stress = all.crack_damage_stress = unknown;
    if (errors != nullptr) all = errors->figures;
    for (auto* of : {&all.peak_stress, &all.peak_strain, &all.crack_initiation_stress, &all.crack_damage_stress})
        if (*of) (*of)->energy_closing = std::abs(last.energy_error / last.platen_work);
    // A linear solution has no error from time step or rate.
    all.youngs_modulus = ErrorFigures{0.0, 0.0, none, 0.0, 0.0, state.modulus_residual};
    s.peak_converged = errors != nullptr ? errors->peak_converged : std::nullopt;
}

void frames(FrameFiles& f, const TestState& state) {
    f.frame_start = f.frame_peak = f.frame_end = std::nullopt;
    if (state.frames.empty()) return;
    const auto name = [](std::int64_t row) { return "frames/" + particles_file(row); };
    f.frame_start = name(state.frames.front().row);
    if (state.failure.peak_row >= 0) f.frame_peak = name(state.failure.peak_row);
    f.frame_end = name(state.frames.back().row);
}

void run(RunFigures& r, const TestSetup& setup, const TestState& state, const World& world, const TestTiming& timing) {
    const std::int64_t steps = world.stepping.steps;
    r.version = project_version;
    r.compiler = __VERSION__;
    r.command = state.command;
    r.threads = timing.threads;
    r.wall_seconds = timing.wall_seconds;
    r.step_seconds = timing.step_seconds;
    r.particle_steps_per_second =
        static_cast<double>(setup.specimen.particles) * static_cast<double>(steps) / timing.step_seconds;
    if (world.workers.profile != nullptr)
        r.profile = profile_report(*world.workers.profile, setup.specimen.particles, steps, timing.step_seconds);
}

}  // namespace

FirstLoading rows_without_cycles(const parts::Loading& loading, const TestState& state) {
    return loading.unloads() ? first_loading(state.rows, state.failure.peak_row)
                             : FirstLoading{state.rows, state.failure.peak_row};
}

std::optional<CrackThresholds> crack_thresholds_of(const parts::Loading& loading, const PlacedApparatus& apparatus,
                                                   const TestState& state) {
    if (!apparatus.compression || !apparatus.uniaxial) return std::nullopt;
    const FirstLoading first = rows_without_cycles(loading, state);
    return find_crack_thresholds(first.rows, first.peak_row, state.youngs_modulus, state.poissons_ratio,
                                 apparatus.confining_pressure);
}

Summary make_summary(const ResolvedCase& test, const TestSetup& setup, const TestState& state, const World& world,
                     const TestTiming& timing, const NumericalErrors* errors) {
    Summary s;
    const FirstLoading first = rows_without_cycles(test.loading, state);
    s.about = describe(test, setup.specimen, state);
    strength(s.strength, setup.apparatus, state, first);
    nominal(s.nominal, setup, state, first);
    validity(s.validity, setup, state, first);
    confinement(s.confinement, setup.apparatus, state, world);
    cracking(s.cracking, test.loading, setup, state);
    if (test.loading.unloads()) s.cycles = cycles(setup.apparatus, state, world.bonds.initial);
    damage(s.damage, setup, state, world);
    s.crack_rose = directions(setup, state, world);
    if (!setup.bonds.traces.empty()) s.jointed = trace_figures(setup.bonds, state, world);
    acoustic_emission(s, state);
    energies(s, state);
    counts(s.specimen, setup, world);
    numerics(s.numerics, test, setup, state, world);
    s.numerics.seed = test.packing() != nullptr ? std::optional(test.packing()->seed) : std::nullopt;
    numerical_errors(s, setup.apparatus, state, errors);
    if (!setup.origin.packing.empty()) s.packing = packing(setup.origin);
    if (!setup.origin.minerals.empty()) s.minerals = minerals(setup.origin);
    frames(s.frames, state);
    s.out_of_plane_thickness = test.output.out_of_plane_thickness;
    s.notices = notices_of(test.loading, test.stress_unit(), setup, state, world, viscous_share(test, state));
    if (errors != nullptr) {
        const std::string notice = notice_of_companions(state.failure, *errors);
        if (!notice.empty()) s.notices->push_back(notice);
    }
    run(s.run, setup, state, world, timing);
    Table<std::string>& columns = s.columns.begin_table();
    for (const CurveColumn& column : curve_columns())
        if (!column.pressed || setup.apparatus.pressed())
            columns.emplace_back(column.what.name, stated_in(column.what, test.area_units()));
    state_units(s);
    return s;
}

}  // namespace crackle
