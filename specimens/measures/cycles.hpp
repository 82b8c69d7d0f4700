// SPDX-License-Identifier: GPL-3.0-or-later
// Unloading and loading again, in the rows of a curve.
//
// A cycle begins at a row from which the strain falls and ends at the first row that lies beyond that one's strain, or
// where the strain falls again: cycles of equal amplitude turn at the same strain or a little before. Of each, from its
// beginning to its lowest strain (Martin & Chandler, Int. J. Rock Mech. Min. Sci. 31, 1994):
//     modulus            (stress - stress at the lowest strain)/(strain - lowest strain)
//     Poisson's ratio    the same difference of lateral strain over that of axial strain, widening positive
//     permanent strain   lowest strain - stress there/modulus: what would be left without stress
//     loss               work put in and not given back: the loop's area times what the specimen's section and length
//                        make of it
// Damage is 1 - modulus/E, E that of the linear solution of the unbroken specimen. Where no bond has broken by the end
// of the cycle it is 0: the platens' stresses hold the dashpots and the inertia of turning round, which are no damage.
// Where nothing has slid or come to touch either, the specimen still is that of the linear solution: its modulus is E
// and no strain is permanent. What turning round makes of the others is stated: half of what the two platens' stresses
// differ by where the cycle begins, and where it is lowest, over the difference of stress. Tested by
// tests/specimens/measures/cycles_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "specimens/observers/curve.hpp"

namespace crackle {

struct LoadingCycle {
    double strain = 0.0, stress = 0.0;          ///< where unloading begins; N/m
    double low_strain = 0.0, low_stress = 0.0;  ///< where it ends
    double modulus = 0.0;                       // N/m
    double poissons_ratio = 0.0;
    double permanent_strain = 0.0;
    double loop = 0.0;           ///< N/m; not a number of a cycle that the curve does not end
    double modulus_error = 0.0;  ///< relative, by what the platens differ at both ends
    bool unbroken = false;       ///< no bond has broken by its end
    bool linear = false;         ///< and none has slid, no point slides or touches that did not
};

/// In their order; positive in the sense of the test.
std::vector<LoadingCycle> find_cycles(std::span<const CurveRow> rows, bool compression);

/// The rows that lie farther than all before them: the curve without its cycles.
struct FirstLoading {
    std::vector<CurveRow> rows;
    std::int64_t peak_row = -1;  ///< among them
};
/// @param peak_row in `rows`, one of those that lie farther; -1: none
FirstLoading first_loading(std::span<const CurveRow> rows, std::int64_t peak_row);

}  // namespace crackle
