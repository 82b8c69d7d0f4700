// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/events.hpp"

#include <fmt/format.h>

namespace crackle {

std::string events_header() {
    return "time,step,axial_strain,x,y,body_i,body_j,orientation,energy,strength,normal_force,shear_force,slid,mode,"
           "last_of_interface\n";
}

std::string event_line(const BreakEvent& e, double axial_strain) {
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", e.time, e.step, axial_strain, e.position.x,
                       e.position.y, e.body_i, e.body_j, e.orientation, e.energy, e.strength, e.normal_force,
                       e.shear_force, e.slid ? 1 : 0, e.shear_mode ? "shear" : "tension", e.last_of_interface ? 1 : 0);
}

}  // namespace crackle
