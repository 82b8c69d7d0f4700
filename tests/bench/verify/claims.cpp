// SPDX-License-Identifier: GPL-3.0-or-later
// Lists all claims, in the order of the page.
// Tested by tests/verification/claims_test.cpp.

#include <exception>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/verify/claim.hpp"
#include "tests/bench/verify/groups.hpp"

namespace crackle::verification {

const std::vector<Claim>& claims() {
    static const std::vector<Claim> all = [] {
        std::vector<Claim> list;
        for (std::vector<Claim> part : {
                 one_body_claims(),
                 friction_claims(),
                 block_on_slope_claims(),
                 contact_opening_claims(),
                 polygon_claims(),
                 chain_claims(),
                 triangular_lattice_claims(),
                 lattice_strength_claims(),
                 lattice_wave_claims(),
                 critical_step_claims(),
                 exact_step_claims(),
                 stiffness_claims(),
                 loading_claims(),
                 conservation_claims(),
                 invariance_claims(),
                 bond_claims(),
                 coulomb_bond_claims(),
                 strength_factor_claims(),
                 bundle_claims(),
                 face_claims(),
                 mesh_claims(),
                 stress_claims(),
                 disc_claims(),
                 beam_claims(),
                 pressure_claims(),
                 joint_claims(),
                 joint_face_claims(),
                 joint_compliance_claims(),
                 weakness_plane_claims(),
                 face_strength_claims(),
                 broken_face_claims(),
                 face_elasticity_claims(),
                 face_energy_claims(),
             }) {
            std::move(part.begin(), part.end(), std::back_inserter(list));
        }
        return list;
    }();
    return all;
}

std::vector<ClaimRow> check_claim(const Claim& claim) {
    try {
        return claim.check();
    } catch (const std::exception& error) {
        ClaimRow row;
        row.label = std::string("ended by: ") + error.what();
        return {row};
    }
}

const char* verdict_of(const Claim& claim, const ClaimRow& row) {
    if (!claim.offered) return "not offered";
    if (row.shown_only) return "shown";
    return row.holds ? "holds" : "FAILS";
}

}  // namespace crackle::verification
