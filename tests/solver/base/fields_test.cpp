// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a field added to a struct and its list is included in the checkpoint, the hash, and the values that points
// carry to the next neighbour list. A list that lacks a field does not compile.

#include <gtest/gtest.h>

#include <array>
#include <cereal/archives/binary.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "solver/base/field_hash.hpp"
#include "solver/base/fields.hpp"
#include "solver/world/points.hpp"

namespace crackle {

// Archives find the function that saves a struct in the struct's own namespace.
struct FewPoints {
    std::vector<double> root_mass;
    std::vector<double> shear_force;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("root_mass", s.root_mass);
        visit("shear_force", s.shear_force, Remembered::always);
    }
};

/// The points with one more field.
struct WearingPoints {
    std::vector<double> root_mass;
    std::vector<double> shear_force;
    std::vector<float> wear;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("root_mass", s.root_mass);
        visit("shear_force", s.shear_force, Remembered::always);
        visit("wear", s.wear, Remembered::by_half_strength);
    }
};

namespace {

template <class T>
std::string saved(const T& value) {
    std::ostringstream out;
    cereal::BinaryOutputArchive{out}(value);
    return out.str();
}

TEST(Fields, OneMoreIsSavedAndLoaded) {
    const WearingPoints points{{1.0, 2.0}, {3.0, 4.0}, {5.0f, 6.0f}};
    EXPECT_GT(saved(points).size(), saved(FewPoints{points.root_mass, points.shear_force}).size());
    std::istringstream in(saved(points));
    WearingPoints loaded;
    cereal::BinaryInputArchive{in}(loaded);
    EXPECT_EQ(loaded.root_mass, points.root_mass);
    EXPECT_EQ(loaded.shear_force, points.shear_force);
    EXPECT_EQ(loaded.wear, points.wear);
}

TEST(Fields, OneMoreIsHashed) {
    const WearingPoints points{{1.0}, {2.0}, {3.0f}};
    WearingPoints worn = points;
    EXPECT_EQ(hash_of_field(worn), hash_of_field(points));
    worn.wear[0] = 4.0f;
    EXPECT_NE(hash_of_field(worn), hash_of_field(points));
}

TEST(Fields, OneMoreIsCarriedToTheNextList) {
    const auto carried = [](auto points) {
        std::vector<Remembered> all;
        visit_remembered(points, [&](auto& values, Remembered remembered) {
            EXPECT_NE(static_cast<const void*>(&values), &points.root_mass) << "is recomputed, not carried over";
            all.push_back(remembered);
        });
        return all;
    };
    EXPECT_EQ(carried(FewPoints{}), (std::vector{Remembered::always}));
    EXPECT_EQ(carried(WearingPoints{}), (std::vector{Remembered::always, Remembered::by_half_strength}));
}

struct Complete {
    double x = 0.0, y = 0.0;
    double shape[2] = {0.0, 0.0};
    std::array<int, 3> count{};
    std::vector<double> many;
    FewPoints points;

    CRACKLE_FIELDS(x, y, shape, count, many, points);
};
static_assert(lists_all_fields<Complete>());
static_assert(lists_all_fields<FewPoints>() && lists_all_fields<WearingPoints>());

/// Lists `Visited` of its members. The static_assert of archives and hashes must reject an incomplete list.
template <int Visited>
struct Lacking {
    double x;
    double shape[2];
    std::vector<double> many;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        if constexpr (Visited != 0) visit("x", s.x);
        if constexpr (Visited != 1) visit("shape", s.shape);
        if constexpr (Visited != 2) visit("many", s.many);
    }
};
static_assert(!lists_all_fields<Lacking<0>>(), "a number is missing");
static_assert(!lists_all_fields<Lacking<1>>(), "an array is missing");
static_assert(!lists_all_fields<Lacking<2>>(), "a vector is missing");
static_assert(lists_all_fields<Lacking<3>>());

/// A field listed twice, as after copying a line.
struct Twice {
    double vx, vy;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("vx", s.vx);
        visit("vy", s.vx);
    }
};
static_assert(!lists_all_fields<Twice>(), "one member is listed twice, another not at all");

}  // namespace
}  // namespace crackle
