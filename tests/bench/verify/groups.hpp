// SPDX-License-Identifier: GPL-3.0-or-later
// The claims that each source file defines; claims() lists them in the order of the page.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <vector>

#include "tests/bench/verify/claim.hpp"

namespace crackle::verification {

std::vector<Claim> one_body_claims();
std::vector<Claim> friction_claims();
std::vector<Claim> block_on_slope_claims();
std::vector<Claim> critical_step_claims();
std::vector<Claim> contact_opening_claims();
std::vector<Claim> exact_step_claims();
std::vector<Claim> polygon_claims();
std::vector<Claim> chain_claims();
std::vector<Claim> triangular_lattice_claims();
std::vector<Claim> lattice_strength_claims();
std::vector<Claim> lattice_wave_claims();
std::vector<Claim> stiffness_claims();
std::vector<Claim> loading_claims();
std::vector<Claim> conservation_claims();
std::vector<Claim> invariance_claims();
std::vector<Claim> bond_claims();
std::vector<Claim> coulomb_bond_claims();
std::vector<Claim> strength_factor_claims();
std::vector<Claim> bundle_claims();
std::vector<Claim> face_claims();
std::vector<Claim> mesh_claims();
std::vector<Claim> stress_claims();
std::vector<Claim> disc_claims();
std::vector<Claim> beam_claims();
std::vector<Claim> pressure_claims();
std::vector<Claim> joint_claims();
std::vector<Claim> joint_face_claims();
std::vector<Claim> joint_compliance_claims();
std::vector<Claim> weakness_plane_claims();
std::vector<Claim> face_strength_claims();
std::vector<Claim> broken_face_claims();
std::vector<Claim> face_elasticity_claims();
std::vector<Claim> face_energy_claims();

}  // namespace crackle::verification
