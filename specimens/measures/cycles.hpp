// SPDX-License-Identifier: GPL-3.0-or-later
// Unloading and reloading cycles in the rows of a curve.
//
// A cycle starts at a row from which the strain decreases. It ends at the first row beyond the strain of its first row,
// or where the strain decreases again. The latter is needed because cycles of equal amplitude reverse at the same
// strain or slightly before. The values of a cycle refer to its start and to its lowest strain (Martin & Chandler, Int.
// J. Rock Mech. Min. Sci. 31, 1994):
//       modulus            (stress - stress at the lowest strain)/(strain - lowest strain)
//       Poisson's ratio    lateral strain change/axial strain change between the same two rows, widening positive
//       permanent strain   lowest strain - (stress at it)/modulus: the strain that would remain at zero stress
//       loss               work that is not recovered: the loop's area times the specimen's section and length
// Damage is 1 - modulus/E, where E is the modulus of the intact specimen from the linear solution. If no bond has
// broken by the end of the cycle, damage is set to 0: at the reversal the platens' stresses include dashpot and inertia
// forces, which are not damage. If, in addition, nothing has slid or come into contact, the linear solution still
// holds: the modulus is E and the permanent strain is 0. For other cycles the inertia error is given. It is half the
// difference between the stresses of the two platens, summed over the start and the lowest strain, and divided by the
// change of stress between them.
//
// If more than `most_breaks_of_unloading` of the bonds break between the start and the lowest strain, the stress falls
// because the specimen fails, not because it is unloaded. Such a cycle has no modulus, and none of the values that
// depend on it.
// Tested by tests/specimens/measures/cycles_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "specimens/observers/curve.hpp"

namespace crackle {

/// Largest share of the initial bonds that may break during an unloading whose modulus is stated. It was chosen between
/// sound unloadings of a granite of faces, where less than 0.1 % broke, and collapses, where 13 % and 23 % did.
constexpr double most_breaks_of_unloading = 0.005;

/// One cycle of unloading and reloading.
struct LoadingCycle {
    double strain = 0.0, stress = 0.0;          ///< strain, and stress in N/m, when unloading starts
    double low_strain = 0.0, low_stress = 0.0;  ///< strain and stress at the lowest strain
    double modulus = 0.0;                       // N/m
    double poissons_ratio = 0.0;
    double permanent_strain = 0.0;
    double loop = 0.0;           ///< area of the hysteresis loop, N/m; NaN if the curve ends within the cycle
    double modulus_error = 0.0;  ///< relative error, from the difference between the stresses of the two platens
    std::int64_t breaks_of_unloading = 0;  ///< bonds that broke between the start and the lowest strain
    bool unbroken = false;                 ///< whether no bond had broken by the end of the cycle
    bool linear = false;  ///< whether, in addition, no contact had slid or formed by the end of the cycle

    /// Whether the specimen failed during the unloading. @param bonds  number of bonds at the start of the test
    bool collapsed(std::int64_t bonds) const {
        return static_cast<double>(breaks_of_unloading) > most_breaks_of_unloading * static_cast<double>(bonds);
    }
};

/// The cycles in order; strains and stresses are positive in the direction of loading.
std::vector<LoadingCycle> find_cycles(std::span<const CurveRow> rows, bool compression);

/// The rows whose strain exceeds the strain of all earlier rows: the curve without its cycles.
struct FirstLoading {
    std::vector<CurveRow> rows;
    std::int64_t peak_row = -1;  ///< index of the peak in these rows
};
/// @param peak_row  index of the peak in `rows`, where the strain exceeds the strain of all earlier rows; -1: no peak
FirstLoading first_loading(std::span<const CurveRow> rows, std::int64_t peak_row);

}  // namespace crackle
