// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/sample_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <random>

#include "solver/base/vec2.hpp"
#include "specimens/frames/frame_painter.hpp"
#include "tests/support/vtp_data.hpp"

namespace crackle::testing {
namespace {

constexpr double width = 0.55, height = 1.1;  // m
constexpr double wave_time = 0.01;            // 1/s, strain rate

struct Particle {
    std::vector<Vec2> outline;  // corners before the inset, shared by neighbours
    Vec2 centre;
    double radius = 0.0;
};

struct Break {
    double strain = 0.0;
    std::size_t i = 0, j = 0;
    Vec2 place;
    bool shear = false;
};

/// Uniformly distributed numbers in [0, 1), the same on every platform.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double next() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  private:
    std::mt19937_64 engine_;
};

class Lattice {
  public:
    explicit Lattice(const SampleTest& test)
        : columns_(test.columns), rows_(test.rows), dx_(width / (columns_ + 0.5)), dy_(height / rows_) {}

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    double spacing() const { return dx_; }

    Vec2 site(int i, int j) const {
        Dice dice(static_cast<std::uint64_t>(1000 * (j + 10) + i + 10));
        const double odd = j % 2 != 0 ? 0.5 : 0.0;
        return clamped(
            {(i + 0.5 + odd + 0.3 * (dice.next() - 0.5)) * dx_, (j + 0.5 + 0.3 * (dice.next() - 0.5)) * dy_});
    }

    /// The six sites around (i, j), counter-clockwise.
    std::vector<Vec2> around(int i, int j) const {
        const int o = j % 2 != 0 ? 1 : 0;
        return {site(i + 1, j), site(i + o, j + 1),     site(i - 1 + o, j + 1),
                site(i - 1, j), site(i - 1 + o, j - 1), site(i + o, j - 1)};
    }

  private:
    static Vec2 clamped(Vec2 p) { return {std::clamp(p.x, 0.0, width), std::clamp(p.y, 0.0, height)}; }

    int columns_, rows_;
    double dx_, dy_;
};

Vec2 mean(const std::vector<Vec2>& points) {
    Vec2 sum;
    for (const Vec2 p : points) sum = sum + p;
    return (1.0 / static_cast<double>(points.size())) * sum;
}

std::vector<Particle> make_particles(const SampleTest& test) {
    const Lattice lattice(test);
    std::vector<Particle> particles;
    for (int j = 0; j < lattice.rows(); ++j) {
        for (int i = 0; i < lattice.columns(); ++i) {
            const Vec2 here = lattice.site(i, j);
            const std::vector<Vec2> ring = lattice.around(i, j);
            if (test.specimen == "circles") {
                particles.push_back({{here}, here, 0.46 * lattice.spacing()});
            } else if (test.specimen == "voronoi") {
                Particle cell;
                for (std::size_t k = 0; k < 6; ++k)
                    cell.outline.push_back((1.0 / 3.0) * (here + ring[k] + ring[(k + 1) % 6]));
                cell.centre = mean(cell.outline);
                particles.push_back(cell);
            } else {
                for (std::size_t k : {0U, 1U}) {  // the triangles above to the right, and directly above
                    Particle triangle{{here, ring[k], ring[k + 1]}, {}, 0.0};
                    if (cross(ring[k] - here, ring[k + 1] - here) < 1e-7) continue;
                    triangle.centre = mean(triangle.outline);
                    particles.push_back(triangle);
                }
            }
        }
    }
    return particles;
}

bool touch(const Particle& a, const Particle& b, double spacing) {
    if (a.radius > 0.0) return norm(a.centre - b.centre) < 1.25 * spacing;
    int shared = 0;
    for (const Vec2 p : a.outline) {
        for (const Vec2 q : b.outline) shared += norm(p - q) < 1e-9 ? 1 : 0;
    }
    return shared >= 2;
}

/// Height of the band in which the specimen breaks.
double band(const SampleTest& test, double x) {
    return test.kind == "tension" ? 0.62 * height + 0.02 * std::sin(25.0 * x) : 0.5 * height + 1.3 * (x - 0.5 * width);
}

double last_strain(const SampleTest& test) { return (test.failed ? 1.5 : 0.8) * test.peak_strain; }

struct Slip {
    double strain = 0.0;
    std::size_t i = 0, j = 0;
    Vec2 place;
    double orientation = 0.0;
};

struct Bonds {
    int count = 0;
    std::vector<Break> breaks;
    std::vector<Slip> slips;
};

/// Strain at which a bond slips, which depends on the angle of its normal; only every third bond slips, and none after
/// the end.
std::optional<double> slip_strain(const SampleTest& test, double orientation, Dice& dice) {
    if (dice.next() > 0.33) return std::nullopt;
    const double off_diagonal = std::abs(std::abs(orientation) - 0.25 * std::numbers::pi);
    const double strain = test.peak_strain * (0.35 + 0.3 * off_diagonal + 0.4 * dice.next());
    return strain < last_strain(test) ? std::optional(strain) : std::nullopt;
}

Bonds break_bonds(const SampleTest& test, const std::vector<Particle>& particles) {
    Bonds bonds;
    Dice dice(7), dice_of_slips(8);
    const double spacing = Lattice(test).spacing();
    for (std::size_t i = 0; i < particles.size(); ++i) {
        for (std::size_t j = i + 1; j < particles.size(); ++j) {
            if (!touch(particles[i], particles[j], spacing)) continue;
            ++bonds.count;
            const Vec2 place = 0.5 * (particles[i].centre + particles[j].centre);
            const Vec2 normal = particles[j].centre - particles[i].centre;
            const double orientation = std::atan(normal.y / normal.x);
            if (const auto slips_at = slip_strain(test, orientation, dice_of_slips))
                bonds.slips.push_back({*slips_at, i, j, place, orientation});
            const bool in_band = std::abs(place.y - band(test, place.x)) < 0.035;
            if (!in_band && dice.next() > 0.06) continue;
            const double strain =
                test.peak_strain * (in_band ? 0.92 + 0.3 * dice.next() * dice.next() : 0.3 + 0.9 * dice.next());
            const bool shear = dice.next() < (test.kind == "tension" ? 0.1 : 0.55);
            if (strain < last_strain(test)) bonds.breaks.push_back({strain, i, j, place, shear});
        }
    }
    const auto earlier = [](const auto& a, const auto& b) { return a.strain < b.strain; };
    std::sort(bonds.breaks.begin(), bonds.breaks.end(), earlier);
    std::sort(bonds.slips.begin(), bonds.slips.end(), earlier);
    return bonds;
}

/// Stress in N/m: curved up to the peak, then falling in steps.
double stress_at(const SampleTest& test, double strain) {
    const double share = strain / test.peak_strain;
    const double peak = 0.75 * test.modulus * test.peak_strain;
    if (share <= 1.0)
        return test.modulus * strain * (1.0 - 0.25 * share) -
               (share > 0.6 ? 0.004 * peak * std::abs(std::sin(90.0 * share)) : 0.0);
    return peak * std::exp(-9.0 * (share - 1.0)) * (1.0 - 0.08 * std::abs(std::sin(45.0 * share)));
}

struct Motion {
    Vec2 displacement;
    double turn = 0.0;
};

Motion motion_at(const SampleTest& test, Vec2 place, double strain) {
    const double sense = test.kind == "tension" ? 1.0 : -1.0;
    const double after = std::max(0.0, strain / test.peak_strain - 0.95);
    const bool upper = place.y > band(test, place.x);
    const Vec2 slide = test.kind == "tension" ? Vec2{0.0, 0.004 * after} : Vec2{-0.006 * after, -0.0078 * after};
    Motion motion{{-0.2 * sense * strain * (place.x - 0.5 * width), sense * strain * place.y}, 0.0};
    if (upper) motion.displacement = motion.displacement + slide;
    if (std::abs(place.y - band(test, place.x)) < 0.04) motion.turn = 0.2 * after * std::sin(400.0 * place.x);
    return motion;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

std::vector<Vec2> moved(const std::vector<Vec2>& outline, Vec2 centre, const Motion& motion, double inset) {
    std::vector<Vec2> corners;
    for (const Vec2 p : outline) {
        const Vec2 arm = (1.0 - inset) * (p - centre);
        corners.push_back(centre + motion.displacement +
                          Vec2{std::cos(motion.turn) * arm.x - std::sin(motion.turn) * arm.y,
                               std::sin(motion.turn) * arm.x + std::cos(motion.turn) * arm.y});
    }
    return corners;
}

std::string particles_text(const SampleTest& test, const std::vector<Particle>& particles, double strain) {
    VtpData data;
    CellArray id{"id", 1, {}, {}}, radius{"radius", 1, {}, {}}, angle{"angle", 1, {}, {}};
    const auto describe = [&](std::size_t number, double r, double turn) {
        id.integer.push_back(static_cast<std::int32_t>(number));
        radius.real.push_back(r);
        angle.real.push_back(turn);
    };
    const double sense = test.kind == "tension" ? 1.0 : -1.0;
    for (const bool top : {false, true}) {
        const double y = top ? height * (1.0 + sense * strain) : 0.0;
        data.lines.push_back({{-0.1 * width, y}, {1.1 * width, y}});
        describe(particles.size() + (top ? 2 : 1), 0.0, 0.0);
    }
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const Particle& particle = particles[k];
        const Motion motion = motion_at(test, particle.centre, strain);
        std::vector<Vec2> outline = particle.outline;
        if (particle.radius > 0.0) {
            outline.clear();
            for (const Vec2 corner : unit_circle_outline(24))
                outline.push_back(particle.centre + particle.radius * corner);
        }
        data.polygons.push_back(moved(outline, particle.centre, motion, particle.radius > 0.0 ? 0.0 : 0.03));
        describe(k + 1, particle.radius, motion.turn);
    }
    data.cell_arrays = {id, radius, angle};
    data.field_values = {
        {"axial_strain", strain}, {"axial_stress", stress_at(test, strain)}, {"time", strain / wave_time}};
    return vtp_text(data);
}

std::string curve_text(const SampleTest& test, const std::vector<Break>& breaks) {
    std::string text =
        "axial_strain,axial_stress,stress_top,stress_bottom,lateral_strain,bonds_broken,kinetic_energy,strain_energy,"
        "time,step,"
        "interfaces_lost,points_sliding,dashpot_loss,friction_loss,fracture_loss,platen_work,energy_error\n";
    constexpr int rows = 600;
    std::size_t broken = 0;
    for (int row = 0; row <= rows; ++row) {
        const double strain = last_strain(test) * row / rows;
        while (broken < breaks.size() && breaks[broken].strain <= strain) ++broken;
        const double stress = stress_at(test, strain), time = strain / wave_time;
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", strain, stress, 1.001 * stress,
                            0.999 * stress, -0.2 * strain, broken, 1e-6 * stress, 0.5 * stress * strain, time,
                            static_cast<long long>(time * 2e5), broken, broken / 3, 0.0, 0.0, 0.0,
                            0.5 * stress * strain, 1e-7);
    }
    return text;
}

std::string events_text(const std::vector<Break>& breaks) {
    std::string text =
        "time,step,axial_strain,x,y,body_i,body_j,orientation,energy,strength,normal_force,shear_force,slid,mode,last_"
        "of_interface\n";
    for (const Break& one : breaks) {
        const double time = one.strain / wave_time;
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", time, static_cast<long long>(time * 2e5),
                            one.strain, one.place.x, one.place.y, one.i + 1, one.j + 1, 0.3, 2e-5, 770.0, -400.0, 200.0,
                            one.shear ? 1 : 0, one.shear ? "shear" : "tension", 1);
    }
    return text;
}

std::string slips_text(const std::vector<Slip>& slips) {
    std::string text = "time,step,axial_strain,x,y,body_i,body_j,orientation,normal_force,shear_force\n";
    for (const Slip& one : slips) {
        const double time = one.strain / wave_time;
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", time, static_cast<long long>(time * 2e5), one.strain,
                            one.place.x, one.place.y, one.i + 1, one.j + 1, one.orientation, 300.0, -150.0);
    }
    return text;
}

/// Events whose positions move along the specimen's height with time.
std::string emission_text(const SampleTest& test) {
    std::string text =
        "time,axial_strain,duration,x,y,radius,breaks,breaks_in_shear,energy,moment_xx,moment_xy,moment_yy,"
        "scalar_moment,rise_time,moment_magnitude,energy_magnitude,isotropic,type\n";
    for (int k = 0; k < test.emission; ++k) {
        const double share = (k + 0.5) / test.emission, strain = share * last_strain(test);
        // Quantiles in an irregular order, so that large and small magnitudes alternate.
        const double magnitude = -6.0 - std::log10((((37 * k) % test.emission) + 0.5) / test.emission);
        const double moment = std::pow(10.0, 1.5 * (magnitude + 6.0));
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", strain / wave_time, strain, 1e-5,
                            0.5 * width, share * height, 0.01, 1, 0, 1e-3, moment, 0.0, moment, moment, 5e-6, magnitude,
                            -5.2, 100.0, "opening");
    }
    return text;
}

std::string summary_text(const SampleTest& test, std::size_t particles, const Bonds& bonds) {
    const double peak_at = std::min(test.peak_strain, last_strain(test));
    nlohmann::ordered_json summary{
        {"title", test.title},
        {"kind", test.kind},
        {"specimen", test.specimen},
        {"failed", test.failed},
        {"ended_by", test.failed ? "failure" : "max_axial_strain"},
        {test.failed ? "peak_stress" : "peak_stress_so_far", stress_at(test, peak_at)},
        {test.failed ? "peak_strain" : "peak_strain_so_far", peak_at},
        {"largest_stress", std::max(stress_at(test, peak_at), test.larger_after_peak)},
        {"strain_at_largest_stress", test.larger_after_peak > 0.0 ? last_strain(test) : peak_at},
        {"bonds_broken_in_shear_to_peak", 1},
        {"bonds_broken_in_tension_to_peak", 2},
        {"area_strain_peak", 0.4 * peak_at},
        {"area_strain_end", -2.0 * peak_at},
        {"fragments", 3},
        {"largest_fragment_share", 0.87},
        {"initial_width", width},
        {"initial_height", height},
        {"particles", particles},
        {"contacts_initial", bonds.count},
        {"bonds_initial", bonds.count},
        {"bonds_broken", bonds.breaks.size()},
        {"interfaces_initial", bonds.count},
        {"interfaces_lost", bonds.breaks.size()},
        {"mean_back_tension", 774.0},
        {"youngs_modulus", test.modulus},
        {"initial_tangent_modulus", 0.97 * test.modulus},
        {"tangent_modulus_50", 0.85 * test.modulus},
        {"poissons_ratio", 0.21},
        {"energy_closing_error", 2.1e-5},
        {"platen_out_of_balance", 1.3e-3},
        {"time_step", 1.9e-5},
        {"time_step_over_stable", 0.8},
        {"numerical_errors", {{"peak_stress", {{"stated", 0.0123}, {"time_step", 0.004}, {"rate", nullptr}}}}},
        {"peak_converged", test.failed},
        {"steps", 41234},
        {"seed", 1},
        {"version", "0.2.0"},
        {"wall_seconds", 3.21},
        {"particle_steps_per_second", 1.13e7},
        {"frame_start", "frames/particles_00000.vtp"},
        {"frame_peak", "frames/particles_00400.vtp"},
        {"frame_end", "frames/particles_00600.vtp"}};
    if (test.kind == "compression") {
        summary["crack_initiation_stress"] = 0.45 * stress_at(test, peak_at);
        summary["crack_damage_stress"] = 0.8 * stress_at(test, peak_at);
        summary["crack_damage_strain"] = 0.78 * peak_at;
    }
    if (test.emission > 0) summary["emission"] = {{"damping_ratio", 0.05}, {"density", 2600.0}};
    if (test.thickness > 0.0) {
        summary["out_of_plane_thickness"] = test.thickness;
        for (const char* key : {"peak_stress", "largest_stress", "youngs_modulus"})
            summary[std::string(key) + "_pa"] = summary[key].get<double>() / test.thickness;
    }
    return summary.dump(2) + "\n";
}

}  // namespace

SampleCounts write_sample_results(const std::filesystem::path& folder, const SampleTest& test) {
    std::filesystem::create_directories(folder / "frames");
    const std::vector<Particle> particles = make_particles(test);
    const Bonds bonds = break_bonds(test, particles);
    write_text(folder / "curve.csv", curve_text(test, bonds.breaks));
    write_text(folder / "events.csv", events_text(bonds.breaks));
    if (test.slips) write_text(folder / "slips.csv", slips_text(bonds.slips));
    if (test.emission > 0) write_text(folder / "ae.csv", emission_text(test));
    write_text(folder / "summary.json", summary_text(test, particles.size(), bonds));
    const double peak_at = std::min(test.peak_strain, last_strain(test));
    write_text(folder / "frames" / "particles_00000.vtp", particles_text(test, particles, 0.0));
    write_text(folder / "frames" / "particles_00400.vtp", particles_text(test, particles, peak_at));
    write_text(folder / "frames" / "particles_00600.vtp", particles_text(test, particles, last_strain(test)));

    SampleCounts counts;
    counts.particles = static_cast<int>(particles.size());
    counts.slips = test.slips ? static_cast<int>(bonds.slips.size()) : 0;
    for (const Break& one : bonds.breaks) ++(one.shear ? counts.shear_breaks : counts.tension_breaks);
    return counts;
}

std::vector<std::filesystem::path> write_six_sample_results(const std::filesystem::path& root) {
    struct Line {
        const char* specimen;
        const char* kind;
        double modulus, peak_strain;
    };
    constexpr Line lines[] = {{"circles", "tension", 5.1e6, 0.9e-3},  {"circles", "compression", 5.1e6, 2.1e-3},
                              {"delaunay", "tension", 1.6e7, 1.9e-3}, {"delaunay", "compression", 1.6e7, 11.0e-3},
                              {"voronoi", "tension", 1.7e7, 1.7e-3},  {"voronoi", "compression", 1.7e7, 14.0e-3}};
    std::vector<std::filesystem::path> folders;
    for (const Line& line : lines) {
        SampleTest test;
        test.specimen = line.specimen;
        test.kind = line.kind;
        test.modulus = line.modulus;
        test.peak_strain = line.peak_strain;
        test.title = fmt::format("Sample {} in {}", line.specimen, line.kind);
        folders.push_back(root / fmt::format("{}-{}", line.specimen, line.kind));
        write_sample_results(folders.back(), test);
    }
    return folders;
}

}  // namespace crackle::testing
