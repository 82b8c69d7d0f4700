// SPDX-License-Identifier: GPL-3.0-or-later
// Tests writing a packing as text and reading it: identical to the bit with any material, or refused.

#include "specimens/packing/packing_text.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "solver/demseg/geometry.hpp"

namespace crackle {
namespace {

PackingRequest request_of(double stiffness) {
    PackingRequest request;
    request.count = 60;
    request.sizes = UniformRadii{1.333e-2, 2.667e-2};
    request.mean_overlap = 7.74e-5;
    request.material.density = 2500.0;
    request.material.normal_stiffness = stiffness;
    request.material.shear_stiffness = 0.25 * stiffness;
    request.material.friction_angle = 27.0;
    return request;
}

std::string deck(const Scene& scene) {
    std::ostringstream out;
    write_geometry(out, scene);
    return out.str();
}

TEST(PackingText, ReadsBackToTheSameBitsWithAnyMaterial) {
    const std::string text = packing_text(make_packing(request_of(1e7)));
    for (const double stiffness : {1e7, 3.3e9}) {
        const PackingRequest request = request_of(stiffness);
        const Packing made = make_packing(request);
        const std::optional<Packing> read = packing_of_text(text, request.material, request.threads);
        ASSERT_TRUE(read.has_value());
        EXPECT_EQ(deck(read->scene), deck(made.scene));
        const PackingReport &a = read->report, &b = made.report;
        EXPECT_EQ(a.void_ratio, b.void_ratio);
        EXPECT_EQ(a.mean_overlap, b.mean_overlap);
        EXPECT_EQ(a.stress_x, b.stress_x);
        EXPECT_EQ(a.stress_y, b.stress_y);
        EXPECT_EQ(a.anisotropy, b.anisotropy);
        EXPECT_EQ(a.residual, b.residual);
        EXPECT_EQ(a.radius_scale, b.radius_scale);
        EXPECT_EQ(a.size_distance, b.size_distance);
        EXPECT_EQ(a.aspect_error, b.aspect_error);
        EXPECT_EQ(a.attempts, b.attempts);
        EXPECT_EQ(a.isotropic, b.isotropic);
        EXPECT_EQ(a.box_met, b.box_met);
        EXPECT_EQ(a.coordination_of_carrying, b.coordination_of_carrying);
    }
}

TEST(PackingText, IsReadWholeOrNotAtAll) {
    const PackingRequest request = request_of(1e7);
    const std::string text = packing_text(make_packing(request));
    for (std::size_t at = 0; at < text.size(); at += text.size() / 50) {
        std::string damaged = text;
        damaged[at] = damaged[at] == '7' ? '8' : '7';
        EXPECT_FALSE(packing_of_text(damaged, request.material, 1).has_value()) << at;
        EXPECT_FALSE(packing_of_text(text.substr(0, at), request.material, 1).has_value()) << at;
    }
}

}  // namespace
}  // namespace crackle
