// SPDX-License-Identifier: GPL-3.0-or-later
// Contact laws for a batch of points: one law in all lanes, or a separate law per lane, looked up in a table of all
// laws. Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <span>

#include "solver/base/lanes.hpp"
#include "solver/contact/pass_view.hpp"
#include "solver/laws/law.hpp"

namespace crackle {

/// Constants of all contact laws, with the values of each constant stored contiguously. The table is used only in
/// scenes with few laws.
struct LawTable {
    static constexpr std::size_t most_laws = 8;  // number of entries that the widest vector lanes can look up at once
    bool filled = false;
    bool fits = false;  // whether there are at most most_laws laws, and either all or none of them have a shear spring
    alignas(64) double numbers[11][most_laws];
    bool differ[11];  // for each constant: whether its value differs between laws
    bool stiffness_or_friction_differ;

    void fill(const PassView& view) {
        const std::span laws(view.laws, view.law_count);
        const auto has_spring = [](const ContactLaw& law) { return law.shear_stiffness > 0.0; };
        const auto springs = std::count_if(laws.begin(), laws.end(), has_spring);
        filled = true;
        fits = laws.size() <= most_laws && (springs == 0 || springs == static_cast<std::ptrdiff_t>(laws.size()));
        if (!fits) return;
        for (std::size_t k = 0; k < most_laws; ++k) {
            const ContactLaw& law = laws[std::min(k, laws.size() - 1)];
            const double all[] = {law.normal_stiffness,
                                  law.shear_stiffness,
                                  law.normal_damping,
                                  law.shear_damping,
                                  law.normal_damping_ratio_term,
                                  law.shear_damping_ratio_term,
                                  law.friction,
                                  law.break_overlap,
                                  law.tensile_strength,
                                  law.cohesion,
                                  law.bond_friction};
            for (std::size_t n = 0; n < std::size(all); ++n) numbers[n][k] = all[n];
        }
        for (std::size_t n = 0; n < std::size(numbers); ++n)
            differ[n] = std::ranges::adjacent_find(numbers[n], std::not_equal_to{}) != std::end(numbers[n]);
        stiffness_or_friction_differ = differ[0] || differ[6];
    }
};

/// Laws of the points in a batch. If all points have the same law, it is reused for the next batch; otherwise laws are
/// loaded for each batch.
struct BatchLaw {
    BatchLaw(const PassView& view, std::uint16_t number_of_law) { take(view, number_of_law); }

    void take(const PassView& view, std::uint16_t number_of_law) {
        law = Law<Lanes>(view.laws[number_of_law]);
        number = number_of_law;
    }

    Law<Lanes> law;
    LaneBit number = several_laws;  // index into Settings::laws, or several_laws
    LawTable table;

    static constexpr LaneBit several_laws = -1;
};

/// Loads each point's law. @param numbers the indices of the laws @return false if the batch mixes laws with and
/// without a shear spring
template <class Features>
CRACKLE_INLINE bool load_laws(const Features& has, const PassView& view, const PointState* states,
                              const LaneBits& numbers, BatchLaw& batch) {
    constexpr bool given = Features::Bond::facts.strengths_are_given;
    Law<Lanes>& law = batch.law;
    batch.number = BatchLaw::several_laws;
    if (!batch.table.filled) batch.table.fill(view);
    if (batch.table.fits) {
        // Constants that have the same value in all laws are still set from the previous batch. Checking this takes
        // less time than writing them again.
        const auto look_up = [&](std::size_t n, Lanes& number) {
            if (batch.table.differ[n]) number = looked_up(batch.table.numbers[n], numbers);
        };
        look_up(0, law.normal_stiffness);
        look_up(1, law.shear_stiffness);
        if (has.damping) {
            look_up(2, law.normal_damping);
            look_up(3, law.shear_damping);
            look_up(4, law.normal_damping_ratio_term);
            look_up(5, law.shear_damping_ratio_term);
        }
        if (has.friction) look_up(6, law.friction);
        if (has.bonds && !given) look_up(7, law.break_overlap);
        if (has.bonds && given) {
            look_up(8, law.tensile_strength);
            look_up(9, law.cohesion);
            look_up(10, law.bond_friction);
        }
        if (batch.table.stiffness_or_friction_differ) law.follow_stiffness();
        return true;
    }
    const ContactLaw* laws[lane_count];
    int springs = 0;
    for (int l = 0; l < lane_count; ++l) {
        laws[l] = &view.laws[states[l].law];
        springs += laws[l]->shear_stiffness > 0.0 ? 1 : 0;
    }
    if (springs != 0 && springs != lane_count) return false;
    law.has_shear_spring = springs != 0;
    const auto load = [&](double ContactLaw::*first, Lanes& a, Lanes& b) {
        const double* at[lane_count];
        for (int l = 0; l < lane_count; ++l) at[l] = &(laws[l]->*first);
        gather_pairs(at, a, b);
    };
    load(&ContactLaw::normal_stiffness, law.normal_stiffness, law.shear_stiffness);
    load(&ContactLaw::friction, law.friction, law.break_overlap);
    if (has.damping) {
        load(&ContactLaw::normal_damping, law.normal_damping, law.shear_damping);
        load(&ContactLaw::normal_damping_ratio_term, law.normal_damping_ratio_term, law.shear_damping_ratio_term);
    }
    if (has.bonds && given) {
        Lanes unused;
        load(&ContactLaw::tensile_strength, law.tensile_strength, law.cohesion);
        load(&ContactLaw::bond_friction, law.bond_friction, unused);
    }
    law.follow_stiffness();
    return true;
}

}  // namespace crackle
