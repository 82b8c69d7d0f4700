// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/own_loading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/stepping/controls.hpp"

namespace crackle {
namespace {

constexpr const char* own_speed = "the calling program has controlled the speed of the driving part since a strain of ";

}  // namespace

double platen_speed(const VirtualTest& test) {
    const BodyState& driver = test.world.bodies.state[test.setup.apparatus.top];
    const double along = test.setup.apparatus.axis == 0 ? driver.vx : driver.vy;
    return test.setup.apparatus.compression ? -along : along;
}

void set_platen_speed(VirtualTest& test, double speed) {
    const parts::Loading& loading = test.description.loading;
    if (!std::isfinite(speed)) throw InputError(fmt::format("platen speed: found {}, expected a number in m/s", speed));
    if (loading.unloads() || loading.by_lateral_strain()) {
        throw InputError(fmt::format(
            "platen speed: found a speed set by the calling program and a case that controls loading by {}, "
            "expected only one of them; to set the speed, remove that control from the case",
            loading.unloads() ? "a list of unloadings" : "lateral strain"));
    }
    TestSetup& setup = test.setup;
    if (!driven_at_velocity(test.world, setup.apparatus.top, setup.apparatus.axis)) {
        throw InputError(
            "platen speed: found a driving part that moves freely or under a force along the axis, expected one driven "
            "at a given velocity; set its velocity first");
    }
    LoadingPath& path = test.state.path;
    const double strain = setup.apparatus.axial_strain(test.world);
    if (std::ranges::none_of(setup.origin.notices, [](const std::string& text) { return text.starts_with(own_speed); }))
        setup.origin.notices.push_back(fmt::format("{}{:.6g}", own_speed, strain));
    setup.rate_rule.tolerance = 0.0;
    path.own_from = std::min(path.own_from, path.travel(strain));
    path.change_speed(speed / setup.apparatus.length, std::numeric_limits<double>::infinity(), strain);
    change_velocity(test.world, setup.apparatus.top, setup.apparatus.axis,
                    setup.apparatus.compression ? -speed : speed);
}

}  // namespace crackle
