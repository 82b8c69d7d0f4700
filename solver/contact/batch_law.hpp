// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of several contact points at once: of one law in all lanes, or each lane's own, looked up in a table of all
// laws. Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <vector>

#include "solver/base/lanes.hpp"
#include "solver/contact/features.hpp"
#include "solver/contact/law.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// The numbers of all laws, those of one kind side by side, where there are few.
struct LawTable {
    static constexpr std::size_t most_laws = 8;  // as many as the widest lanes look up at once
    bool filled = false;
    bool fits = false;  // no more than that, all with a shear spring or none
    alignas(64) double numbers[11][most_laws];
    bool differ[11];  // from law to law
    bool stiffness_or_friction_differ;

    void fill(const World& world) {
        const std::vector<ContactLaw>& laws = world.settings.laws;
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

/// Law of the points of a batch: kept from one batch to the next where they are all of one, else found for each.
struct BatchLaw {
    BatchLaw(const World& world, std::uint16_t number_of_law) { take(world, number_of_law); }

    void take(const World& world, std::uint16_t number_of_law) {
        law = Law<Lanes>(world.settings.laws[number_of_law]);
        number = number_of_law;
    }

    Law<Lanes> law;
    LaneBit number = several_laws;  // into Settings::laws
    LawTable table;

    static constexpr LaneBit several_laws = -1;
};

/// Each point's law. @param numbers of the laws @return whether lanes can have them: all with a shear spring, or none
template <class Features>
CRACKLE_INLINE bool load_laws(const Features& has, const World& world, const PointState* states,
                              const LaneBits& numbers, BatchLaw& batch) {
    Law<Lanes>& law = batch.law;
    batch.number = BatchLaw::several_laws;
    if (!batch.table.filled) batch.table.fill(world);
    if (batch.table.fits) {
        // What all laws have alike is there from the batch before: to write it again costs more than to ask.
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
        if (has.bonds && !has.coulomb) look_up(7, law.break_overlap);
        if (has.coulomb) {
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
        laws[l] = &world.settings.laws[states[l].law];
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
    if (has.coulomb) {
        Lanes unused;
        load(&ContactLaw::tensile_strength, law.tensile_strength, law.cohesion);
        load(&ContactLaw::bond_friction, law.bond_friction, unused);
    }
    law.follow_stiffness();
    return true;
}

}  // namespace crackle
