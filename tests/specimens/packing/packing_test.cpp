// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that packings carry load at rest, meet their targets, are isotropic, have the requested sizes, and do not
// depend on threads. Values are computed from the scene by brute force, not from the packer's own sums.

#include "specimens/packing/packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/demseg/geometry.hpp"
#include "solver/linear/step_bound.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/packing/relaxation.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

Material rock() {
    Material material;
    material.density = 2500.0;
    material.normal_stiffness = 1.0e7;
    material.shear_stiffness = 2.5e6;
    material.friction_angle = 27.0;
    return material;
}

/// Request for the guide's rock, in SI units.
PackingRequest guide_rock(std::uint64_t seed) {
    PackingRequest request;
    request.count = 304;
    request.sizes = UniformRadii{1.333e-2, 2.667e-2};
    request.mean_overlap = 7.74e-5;
    request.seed = seed;
    request.material = rock();
    return request;
}

/// Values from all pairs of circles, with forces by k_n, in N.
struct PlainFigures {
    double largest_unbalanced = 0.0, mean_force = 0.0, mean_overlap = 0.0;
    std::array<double, 4> wall_force{};
    double circle_area = 0.0;
    std::int64_t circle_contacts = 0, floating = 0;
    double smallest_overlap = 1e300;  // m, smallest over all contacts

    double anisotropy(const Domain& d) const {
        const double x = 0.5 * (wall_force[0] + wall_force[1]) / (d.y2 - d.y1),
                     y = 0.5 * (wall_force[2] + wall_force[3]) / (d.x2 - d.x1);
        return std::abs(x - y) / (x + y);
    }
};

PlainFigures measure_plainly(const Scene& scene) {
    const double k = scene.materials[0].normal_stiffness;
    PlainFigures f;
    std::vector<Vec2> force(scene.circles.size());
    std::vector<int> touching(scene.circles.size(), 0);
    double all_forces = 0.0, bond_overlaps = 0.0;
    int contacts = 0, bonds = 0;
    for (std::size_t i = 0; i < scene.circles.size(); ++i) {
        const CircleElement& a = scene.circles[i];
        f.circle_area += std::numbers::pi * a.radius * a.radius;
        for (std::size_t j = i + 1; j < scene.circles.size(); ++j) {
            const CircleElement& b = scene.circles[j];
            const double distance = norm(b.centre - a.centre), overlap = a.radius + b.radius - distance;
            if (overlap <= 0.0) continue;
            const Vec2 push = (k * overlap / distance) * (b.centre - a.centre);
            force[i] = force[i] - push;
            force[j] = force[j] + push;
            ++touching[i], ++touching[j], ++contacts, ++bonds, ++f.circle_contacts;
            all_forces += k * overlap;
            bond_overlaps += overlap;
            f.smallest_overlap = std::min(f.smallest_overlap, overlap);
        }
        const Domain& d = scene.domain;
        const std::array<double, 4> distance{a.centre.x - d.x1, d.x2 - a.centre.x, a.centre.y - d.y1,
                                             d.y2 - a.centre.y};
        const std::array<Vec2, 4> inward{Vec2{1, 0}, Vec2{-1, 0}, Vec2{0, 1}, Vec2{0, -1}};
        for (std::size_t wall = 0; wall < 4; ++wall) {
            const double overlap = a.radius - distance[wall];
            if (overlap <= 0.0) continue;
            force[i] = force[i] + k * overlap * inward[wall];
            f.wall_force[wall] += k * overlap;
            all_forces += k * overlap;
            f.smallest_overlap = std::min(f.smallest_overlap, overlap);
            ++touching[i], ++contacts;
            if (wall >= 2) bond_overlaps += overlap, ++bonds;
        }
    }
    for (std::size_t i = 0; i < force.size(); ++i) {
        f.largest_unbalanced = std::max(f.largest_unbalanced, norm(force[i]));
        f.floating += touching[i] == 0 ? 1 : 0;
    }
    f.mean_force = all_forces / contacts;
    f.mean_overlap = bond_overlaps / bonds;
    return f;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// Largest distance between the empirical and the given cumulative distribution.
template <typename Share>
double distance_from(std::vector<double> radii, const Share& share) {
    std::sort(radii.begin(), radii.end());
    const double n = static_cast<double>(radii.size());
    double distance = 0.0;
    for (std::size_t k = 0; k < radii.size(); ++k) {
        const double s = share(radii[k]), rank = static_cast<double>(k);
        distance = std::max({distance, std::abs(s - rank / n), std::abs(s - (rank + 1.0) / n)});
    }
    return distance;
}

/// Kolmogorov-Smirnov test at 5 %.
double critical_distance(std::size_t n) { return 1.358 / std::sqrt(static_cast<double>(n)); }

std::vector<double> radii_of(const Scene& scene) {
    std::vector<double> radii;
    for (const CircleElement& circle : scene.circles) radii.push_back(circle.radius);
    return radii;
}

std::string bytes_of(const Scene& scene) {
    std::ostringstream out;
    write_geometry(out, scene);
    return out.str();
}

TEST(Packing, GuideRockIsInEquilibriumOnTargetAndIsotropicOverTwentySeeds) {
    std::vector<double> anisotropies, coordinations, contacts, void_ratios;
    double worst_residual = 0.0, worst_target = 0.0, worst_aspect = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Packing packing = make_packing(guide_rock(seed));
        const PlainFigures f = measure_plainly(packing.scene);
        const Domain& d = packing.scene.domain;
        ASSERT_EQ(packing.scene.circles.size(), 304u);
        worst_residual = std::max(worst_residual, f.largest_unbalanced / f.mean_force);
        worst_target = std::max(worst_target, std::abs(f.mean_overlap / 7.74e-5 - 1.0));
        worst_aspect = std::max(worst_aspect, std::abs((d.y2 - d.y1) / (d.x2 - d.x1) / 2.0 - 1.0));
        anisotropies.push_back(f.anisotropy(d));
        coordinations.push_back(packing.report.coordination_of_carrying);
        contacts.push_back(static_cast<double>(f.circle_contacts));
        void_ratios.push_back((d.x2 - d.x1) * (d.y2 - d.y1) / f.circle_area - 1.0);
        // The report must agree with brute force.
        EXPECT_EQ(packing.report.circle_contacts, f.circle_contacts);
        EXPECT_EQ(packing.report.floating, f.floating);
        EXPECT_NEAR(packing.report.anisotropy, f.anisotropy(d), 1e-9);
        EXPECT_NEAR(packing.report.mean_overlap / f.mean_overlap, 1.0, 1e-12);
        EXPECT_NEAR(packing.report.void_ratio, void_ratios.back(), 1e-12);
        EXPECT_NEAR(packing.report.mean_contact_force / f.mean_force, 1.0, 1e-12);
        EXPECT_TRUE(packing.report.isotropic && packing.report.box_met);
    }
    fmt::print("  medians: contacts between circles {}, coordination of carrying circles {:.3f}, void ratio {:.4f}\n",
               median(contacts), median(coordinations), median(void_ratios));
    EXPECT_TRUE(within("largest unbalanced / mean contact force, worst of 20", worst_residual, 0.0, 1e-5));
    EXPECT_TRUE(within("mean overlap / target - 1, worst of 20", worst_target, 0.0, 1e-3));
    EXPECT_TRUE(within("|σx-σy|/(σx+σy), median of 20", median(anisotropies), 0.0, 0.02));
    EXPECT_TRUE(
        within("|σx-σy|/(σx+σy), worst of 20", *std::max_element(anisotropies.begin(), anisotropies.end()), 0.0, 0.01));
    EXPECT_TRUE(within("height / width / 2 - 1, worst of 20", worst_aspect, 0.0, 1e-3));
}

TEST(Packing, StaysAtRestInTheSolver) {
    Packing packing = make_packing(guide_rock(3));
    World world = build_world(packing.scene);
    compute_forces(world);
    double largest = 0.0;
    for (const BodyForce& force : world.bodies.force) largest = std::max(largest, std::hypot(force.fx, force.fy));
    EXPECT_TRUE(within("unbalanced / mean contact force in the solver", largest / packing.report.mean_contact_force,
                       0.0, 1e-5));
    const std::array<Vec2, 4> walls = measure_wall_forces(world);
    EXPECT_TRUE(agrees("force on the top wall over the width", std::abs(walls[3].y) / packing.report.width,
                       packing.report.stress_y, 1e-4));
}

TEST(Packing, FloatingCirclesKeepOffTheOthers) {
    // A contact with an overlap as small as the tolerance of the equilibrium would be bonded without any strength.
    const Packing packing = make_packing(guide_rock(1));
    const PlainFigures f = measure_plainly(packing.scene);
    fmt::print("  {} floating; smallest overlap {:.3g} of the mean\n", f.floating, f.smallest_overlap / f.mean_overlap);
    EXPECT_GT(f.floating, 0);
    EXPECT_GT(f.smallest_overlap, 1e-6 * f.mean_overlap);
}

TEST(Packing, MeetsTheBoxExactlyWithRadiiScaledByLessThanHalfAPercent) {
    PackingRequest request = guide_rock(5);
    request.count.reset();
    request.width = 0.6;
    request.height = 1.1;
    const Packing packing = make_packing(request);
    const PlainFigures f = measure_plainly(packing.scene);
    EXPECT_EQ(packing.scene.domain.x2 - packing.scene.domain.x1, 0.6);
    EXPECT_EQ(packing.scene.domain.y2 - packing.scene.domain.y1, 1.1);
    fmt::print("  {} circles, radii scaled by {:.5f}, {} draws\n", packing.report.circles, packing.report.radius_scale,
               packing.report.attempts);
    EXPECT_TRUE(packing.report.box_met);
    EXPECT_GE(packing.report.radius_min, 0.995 * 1.333e-2);
    EXPECT_LE(packing.report.radius_max, 1.005 * 2.667e-2);
    EXPECT_TRUE(within("mean overlap / target - 1", f.mean_overlap / 7.74e-5 - 1.0, 0.0, 1e-3));
    EXPECT_TRUE(within("unbalanced / mean contact force", f.largest_unbalanced / f.mean_force, 0.0, 1e-5));
    EXPECT_TRUE(within("anisotropy", f.anisotropy(packing.scene.domain), 0.0, 0.01));
    const double distance = distance_from(radii_of(packing.scene),
                                          [](double r) { return std::clamp((r - 1.333e-2) / 1.334e-2, 0.0, 1.0); });
    EXPECT_LT(distance, critical_distance(packing.scene.circles.size()));
}

TEST(Packing, MeetsAVoidRatio) {
    PackingRequest request = guide_rock(2);
    request.mean_overlap.reset();
    for (const double asked : {0.19, 0.15}) {
        request.void_ratio = asked;
        const Packing packing = make_packing(request);
        const PlainFigures f = measure_plainly(packing.scene);
        const double area =
            (packing.scene.domain.x2 - packing.scene.domain.x1) * (packing.scene.domain.y2 - packing.scene.domain.y1);
        EXPECT_TRUE(agrees("void ratio", area / f.circle_area - 1.0, asked, 1e-3));
        EXPECT_TRUE(within("unbalanced / mean contact force", f.largest_unbalanced / f.mean_force, 0.0, 1e-5));
    }
}

TEST(Packing, NamesTheReachableRangeOfAnUnreachableVoidRatio) {
    PackingRequest request = guide_rock(2);
    request.mean_overlap.reset();
    for (const double asked : {0.5, 0.01}) {
        request.void_ratio = asked;
        try {
            make_packing(request);
            ADD_FAILURE() << "void ratio " << asked << " was accepted";
        } catch (const InputError& error) {
            fmt::print("  {}\n", error.what());
            const std::string text = error.what();
            double low = 0.0, high = 0.0;
            ASSERT_EQ(std::sscanf(text.substr(text.find("expected")).c_str(), "expected %lf to %lf", &low, &high), 2)
                << text;
            EXPECT_LT(low, high);
            EXPECT_TRUE(asked < low || asked > high);
            // A value in the range given by the message must be accepted.
            request.void_ratio = 0.5 * (low + high);
            EXPECT_NEAR(make_packing(request).report.void_ratio / *request.void_ratio, 1.0, 1e-3);
        }
    }
}

TEST(Packing, SameSeedGivesTheSameBytesForAnyNumberOfThreads) {
    PackingRequest request = guide_rock(11);
    request.count = 4500;  // enough to run the parallel loops
    request.mean_overlap = 6e-4;
    const std::string one = bytes_of(make_packing(request).scene);
    for (const int threads : {2, 3}) {
        request.threads = threads;
        EXPECT_EQ(bytes_of(make_packing(request).scene), one) << threads << " threads";
    }
    PackingRequest small = guide_rock(11);
    const std::string first = bytes_of(make_packing(small).scene);
    EXPECT_EQ(bytes_of(make_packing(small).scene), first);
    small.seed = 12;
    EXPECT_NE(bytes_of(make_packing(small).scene), first);
}

TEST(Packing, LargeOnesMoveAgainstADragToTheSameEquilibriumAndBytesForAnyNumberOfThreads) {
    PackingRequest request = guide_rock(1);
    request.count = static_cast<std::int64_t>(drag_from);
    request.mean_overlap = 2e-4;
    const Packing packing = make_packing(request);
    const PlainFigures f = measure_plainly(packing.scene);
    EXPECT_TRUE(within("largest unbalanced / mean contact force", f.largest_unbalanced / f.mean_force, 0.0, 2e-6));
    EXPECT_TRUE(within("mean overlap / target - 1", f.mean_overlap / 2e-4 - 1.0, 0.0, 5e-4));
    EXPECT_TRUE(within("anisotropy", f.anisotropy(packing.scene.domain), 0.0, 0.01));
    EXPECT_TRUE(packing.report.box_met);
    EXPECT_EQ(packing.report.attempts, 1);  // although one floating circle of this seed cannot be moved away
    request.threads = 3;
    EXPECT_TRUE(bytes_of(make_packing(request).scene) == bytes_of(packing.scene));
}

// A progress hook may stop the packing; a pass over twenty million circles takes seconds.
TEST(Packing, LargeOnesReportAfterEachFewPasses) {
    std::mt19937_64 generator(1);
    std::vector<Disc> discs(300'000);
    for (Disc& disc : discs) disc = {uniform_number(generator), uniform_number(generator), 1e-3};
    DiscAssembly assembly(1.0, 1.0, std::move(discs), 1);
    int reports = 0;
    relax(assembly, {}, 0.0, 10, [&](double) { ++reports; });
    EXPECT_EQ(reports, 4);
}

TEST(Packing, DeckHoldsTheCirclesNumberedFromOneAtRest) {
    const Packing packing = make_packing(guide_rock(4));
    const testing::ScratchFolder folder;
    const auto path = folder / "in_gm.dat";
    std::ofstream(path) << bytes_of(packing.scene);
    const Scene read = read_geometry(path);
    ASSERT_EQ(read.bodies.size(), 304u);
    EXPECT_EQ(read.domain.wall_present, (std::array<bool, 4>{true, true, true, true}));
    for (std::size_t i = 0; i < read.bodies.size(); ++i) {
        EXPECT_EQ(read.bodies[i].id, static_cast<int>(i) + 1);
        EXPECT_EQ(read.bodies[i].velocity, Vec2{});
        EXPECT_EQ(read.circles[i].radius, packing.scene.circles[i].radius);
        EXPECT_EQ(read.circles[i].centre, packing.scene.circles[i].centre);
    }
    EXPECT_GT(read.time_step, 0.0);
    EXPECT_LT(read.time_step, stable_step_bound(build_world(packing.scene)));
}

TEST(SizeDistribution, SamplesPassTheKolmogorovTestAgainstTheirOwnFormulas) {
    std::mt19937_64 generator(7);
    const auto uniform = sample_radii(UniformRadii{0.01, 0.03}, 300, generator);
    EXPECT_LT(distance_from(uniform, [](double r) { return (r - 0.01) / 0.02; }), critical_distance(300));

    const auto lognormal = sample_radii(LognormalRadii{0.02, 0.4, 0.0, 0.0}, 300, generator);
    EXPECT_LT(distance_from(lognormal,
                            [](double r) { return 0.5 * std::erfc(-std::log(r / 0.02) / 0.4 / std::numbers::sqrt2); }),
              critical_distance(300));

    const auto cut = sample_radii(LognormalRadii{0.02, 0.4, 0.015, 0.03}, 300, generator);
    const auto raw = [](double r) { return 0.5 * std::erfc(-std::log(r / 0.02) / 0.4 / std::numbers::sqrt2); };
    EXPECT_LT(distance_from(cut, [&](double r) { return (raw(r) - raw(0.015)) / (raw(0.03) - raw(0.015)); }),
              critical_distance(300));
    EXPECT_GE(*std::min_element(cut.begin(), cut.end()), 0.015);
    EXPECT_LE(*std::max_element(cut.begin(), cut.end()), 0.03);

    // Half of the mass has diameters between 1 and 2, half between 2 and 4: number densities are slope·d⁻³.
    const SieveCurve curve{{{1e-3, 0.0}, {2e-3, 0.5}, {4e-3, 1.0}}};
    const auto sieved = sample_radii(curve, 3000, generator);
    const double lower = 1.0 - 1.0 / 4.0, upper = 1.0 / 4.0 - 1.0 / 16.0;
    EXPECT_LT(distance_from(sieved,
                            [&](double r) {
                                const double d = 2.0 * r / 1e-3;
                                const double below = d < 2.0 ? 1.0 - 1.0 / (d * d) : lower + 0.25 - 1.0 / (d * d);
                                return below / (lower + upper);
                            }),
              critical_distance(3000));
    // The mass that passes must also follow the curve.
    double mass = 0.0, passing = 0.0;
    for (const double r : sieved) {
        mass += r * r;
        passing += 2.0 * r < 2e-3 ? r * r : 0.0;
    }
    EXPECT_TRUE(agrees("share of the mass passing the middle sieve", passing / mass, 0.5, 5e-3));

    // A different distribution must fail the test.
    EXPECT_GT(distance_from(uniform, [](double r) { return (r - 0.01) / 0.024; }), critical_distance(300));
}

TEST(SizeDistribution, PackedSizesAreThoseAskedFor) {
    PackingRequest request = guide_rock(6);
    request.sizes = LognormalRadii{0.02, 0.3, 0.01, 0.04};
    const Packing lognormal = make_packing(request);
    fmt::print("  lognormal: distance {:.4f}, critical {:.4f}\n", lognormal.report.size_distance,
               critical_distance(304));
    EXPECT_LT(lognormal.report.size_distance, critical_distance(304));
    EXPECT_LE(lognormal.report.residual, 1e-5);
    request.sizes = SieveCurve{{{0.02, 0.0}, {0.03, 0.3}, {0.05, 1.0}}};
    const Packing sieved = make_packing(request);
    fmt::print("  sieve curve: distance {:.4f}\n", sieved.report.size_distance);
    EXPECT_LT(sieved.report.size_distance, critical_distance(304));
    EXPECT_LE(sieved.report.residual, 1e-5);
}

TEST(SizeDistribution, ReadsASieveCurveAndNamesTheLineOfABadOne) {
    const testing::ScratchFolder folder;
    const auto read = [&](const std::string& text) {
        std::ofstream(folder / "curve.csv") << text;
        return read_sieve_curve(folder / "curve.csv");
    };
    const SieveCurve curve = read("# sand\nsize,passing_by_mass\n0.001,0\n0.002, 40\n0.004,100\n");
    ASSERT_EQ(curve.points.size(), 3u);
    EXPECT_DOUBLE_EQ(curve.points[1].passing_by_mass, 0.4);
    const auto complaint = [&](const std::string& text) -> std::string {
        try {
            read(text);
        } catch (const InputError& error) {
            fmt::print("  {}\n", error.what());
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(read("\xef\xbb\xbf\nsize,passing_by_mass\n1,0\n2,1\n").points.size(), 2u) << "a byte order mark";
    for (const char* text : {"passing_by_mass; size\r\n0; +0.001\r\n0.4; 0.002\r\n1; 0.004\r\n;\r\n",
                             "\"sieve\"\t\"size\"\t\"passing_by_mass\"\na\t0.001\t0\nb\t0.002\t0.4\n\t0.004\t1\n"}) {
        const SieveCurve other = read(text);
        ASSERT_EQ(other.points.size(), 3u) << text;
        EXPECT_DOUBLE_EQ(other.points[1].size, 0.002);
        EXPECT_DOUBLE_EQ(other.points[1].passing_by_mass, 0.4);
    }
    EXPECT_NE(complaint("size;passing_by_mass\n0,001;0\n0,002;1\n").find("curve.csv:2: found '0,001', a number with a"),
              std::string::npos);
    EXPECT_NE(complaint("<html>").find("curve.csv: found a web page, expected a table with the column names"),
              std::string::npos);
    EXPECT_NE(complaint("size,passing_by_mass\n1e-200,0\n2,1\n").find("point 1: size: found 1e-200"),
              std::string::npos);
    EXPECT_NE(complaint("size,passing_by_mass\n1,0\n1.0000000000000002,1\n").find("sizes that increase"),
              std::string::npos);
    EXPECT_LT(complaint(std::string(100'000, 'x')).size(), 300u);
    std::filesystem::remove(folder / "curve.csv");
    std::filesystem::create_directory(folder / "curve.csv");
    EXPECT_NE(complaint("").find("curve.csv: found a folder, expected a file"), std::string::npos);
    std::filesystem::remove(folder / "curve.csv");
    EXPECT_NE(complaint("diameter,passing\n1,0\n2,1\n").find("curve.csv:1"), std::string::npos);
    EXPECT_NE(complaint("size,passing_by_mass\n0.001,0\n0.002,much\n").find("curve.csv:3"), std::string::npos);
    EXPECT_NE(complaint("size,passing_by_mass\n0.002,0\n0.001,1\n").find("increase"), std::string::npos);
    EXPECT_NE(complaint("size,passing_by_mass\n0.001,0.2\n0.002,1\n").find("first"), std::string::npos);
    EXPECT_NE(complaint("size,passing_by_mass\n0.001,0\n0.002,0.8\n").find("last"), std::string::npos);
}

TEST(RandomNumbers, AreThoseOfTheStandardsGenerator) {
    // The standard prescribes the 10000th number of the default-seeded generator; the function uses its upper 53 bits.
    std::mt19937_64 generator;
    generator.discard(9999);
    EXPECT_EQ(uniform_number(generator), static_cast<double>(9981545732273789042ULL >> 11) / 9007199254740992.0);
}

TEST(RandomNumbers, ShuffleLeavesEachItemInPlaceAsOftenAsAnywhere) {
    constexpr int draws = 20000;
    std::mt19937_64 generator(7);
    std::array<int, 3> stayed{};
    for (int n = 0; n < draws; ++n) {
        std::vector<std::size_t> items{0, 1, 2};
        shuffle(items, generator);
        for (std::size_t k = 0; k < items.size(); ++k) stayed[k] += items[k] == k ? 1 : 0;
    }
    for (const int count : stayed) EXPECT_NEAR(count, draws / 3.0, 4.0 * std::sqrt(draws * 2.0 / 9.0));
}

TEST(Packing, SeedsBeyondFourThousandMillionAreSeedsOfTheirOwn) {
    PackingRequest request = guide_rock(1);
    request.count = 50;
    const double low = make_packing(request).scene.circles[0].radius;
    request.seed += std::uint64_t{1} << 32;
    EXPECT_NE(make_packing(request).scene.circles[0].radius, low);
}

TEST(Packing, RefusesRequestsThatContradictThemselves) {
    const auto complaint = [](auto&& change) -> std::string {
        PackingRequest request = guide_rock(1);
        change(request);
        try {
            make_packing(request);
        } catch (const InputError& error) {
            fmt::print("  {}\n", error.what());
            return error.what();
        }
        return "accepted";
    };
    EXPECT_NE(complaint([](auto& r) { r.width = 1.0; }).find("either"), std::string::npos);
    EXPECT_NE(complaint([](auto& r) { r.count.reset(); }).find("either"), std::string::npos);
    EXPECT_NE(complaint([](auto& r) { r.count = 0; }).find("count"), std::string::npos);
    EXPECT_NE(complaint([](auto& r) { r.mean_overlap = -1e-5; }).find("mean_overlap"), std::string::npos);
    EXPECT_NE(complaint([](auto& r) { r.mean_overlap = 0.01; }).find("mean_overlap"), std::string::npos);
    EXPECT_NE(complaint([](auto& r) { r.mean_overlap = std::nan(""); }).find("mean_overlap"), std::string::npos);
    EXPECT_NE(complaint([](auto& r) { r.void_ratio = 0.2; }).find("both"), std::string::npos);
    EXPECT_NE(complaint([](auto& r) { r.sizes = UniformRadii{0.02, 0.01}; }).find("radius_max"), std::string::npos);
    EXPECT_NE(complaint([](auto& r) { r.sizes = UniformRadii{-0.02, 0.01}; }).find("radius_min"), std::string::npos);
    EXPECT_NE(complaint([](auto& r) { r.material.density = -1.0; }).find("density"), std::string::npos);
}

/// Two circles that overlap each other by 2 mm and a side wall by 1 mm each; one overlaps the floor by 4 mm.
TEST(PackingReport, OfThreeCirclesIsThatByHand) {
    Scene scene;
    scene.materials = {rock()};
    scene.domain = {0.0, 0.116, 0.0, 0.3, {true, true, true, true}};
    const Vec2 centres[] = {{0.029, 0.2}, {0.087, 0.2}, {0.058, 0.026}};
    int id = 0;
    for (const Vec2 centre : centres) scene.add_circle_body(++id, 0, {centre, 0.03, 0.0});
    const PackingReport report = measure_packing(scene, UniformRadii{0.03, 0.03});
    const double stiffness = scene.materials[0].normal_stiffness;
    EXPECT_EQ(report.circle_contacts, 1);
    EXPECT_NEAR(report.coordination, 2.0 / 3.0, 1e-15);
    EXPECT_NEAR(report.coordination_of_carrying, (2.0 + 3.0) / 3.0, 1e-15);
    // The mean over four contacts; without the side walls it would be 3 mm.
    EXPECT_NEAR(report.mean_contact_force / stiffness, 0.25 * (2e-3 + 2 * 1e-3 + 4e-3), 1e-12);
    EXPECT_NEAR(report.mean_overlap, 3e-3, 1e-12);
    EXPECT_NEAR(report.stress_x / stiffness, 1e-3 / 0.3, 1e-12);
    EXPECT_NEAR(report.stress_y / stiffness, 0.5 * 4e-3 / 0.116, 1e-12);
}

TEST(PackingReport, TellsOfABoxThatIsWiderOrNarrowerThanAsked) {
    for (const double error : {-0.002, 0.002}) {
        PackingReport report;
        report.aspect_error = error;
        report.radius_scale = 1.0;
        const auto notices = packing_notices(report);
        ASSERT_EQ(notices.size(), 1U) << error;
        const char* const expected =
            error < 0.0 ? "differs from the requested one by -0.2 %" : "differs from the requested one by 0.2 %";
        EXPECT_NE(notices[0].find(expected), std::string::npos) << notices[0];
    }
}

TEST(SizeDistribution, DistanceOfAFewSizesIsThatByHand) {
    // For radii uniform in [1, 2], both values are at most 1.5, where the expected fraction is one half.
    EXPECT_NEAR(kolmogorov_distance(UniformRadii{1.0, 2.0}, {1.25, 1.5}), 0.5, 1e-12);
    EXPECT_NEAR(kolmogorov_distance(UniformRadii{1.0, 2.0}, {1.5, 1.75}), 0.5, 1e-12);
    EXPECT_NEAR(kolmogorov_distance(UniformRadii{1.0, 2.0}, {1.25, 1.75}), 0.25, 1e-12);
}

TEST(PackingReport, ACircleThatTouchesAWallAloneDoesNotFloat) {
    Scene scene;
    scene.materials = {rock()};
    scene.domain = {0.0, 1.0, 0.0, 2.0, {true, true, true, true}};
    const Vec2 centres[] = {{0.019, 0.5}, {0.981, 0.6}, {0.5, 0.019}, {0.6, 1.981}, {0.5, 0.5}};
    int id = 0;
    for (const Vec2 centre : centres) scene.add_circle_body(++id, 0, {centre, 0.02, 0.0});
    const PackingReport report = measure_packing(scene, UniformRadii{0.02, 0.02});
    EXPECT_EQ(report.floating, 1) << "the last";
    EXPECT_EQ(report.circle_contacts, 0);
}

}  // namespace
}  // namespace crackle
