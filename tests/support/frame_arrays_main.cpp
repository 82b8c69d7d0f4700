// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the contents of a test's frames, for a test that reads them with VTK:
//   frame_arrays read FILE...   every array of each .vtp file, as read by the program's own reader
//   frame_arrays state OUT      the same arrays at the end of a test, from the solver's state in OUT/checkpoint
//                               (view_point() and the bodies, without painter or reader), and the shapes of
//                               particles

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "solver/base/errors.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/frames/read_frames.hpp"
#include "specimens/results/checkpoint.hpp"

namespace {

using namespace crackle;
using Arrays = std::map<std::string, std::vector<double>>;
using nlohmann::json;

json described(const std::vector<double>& values) {
    if (values.empty()) return {0, 0, 0, 0};
    long double sum = 0.0L, magnitudes = 0.0L;
    for (const double value : values) {
        sum += static_cast<long double>(value);
        magnitudes += static_cast<long double>(std::abs(value));
    }
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return {*least, *most, static_cast<double>(sum), static_cast<double>(magnitudes)};
}

json described(const Arrays& arrays) {
    json all = json::object();
    for (const auto& [name, values] : arrays) all[name] = described(values);
    return all;
}

json read_file(const std::string& file) {
    const PolyData data = read_polydata(file);
    json cells = described(Arrays(data.cell_data.begin(), data.cell_data.end()));
    std::vector<double> places;
    for (const Vec2 point : data.points) places.insert(places.end(), {point.x, point.y, 0.0});
    std::size_t lines = 0, corners = 0;
    for (const PolyData::Cell& cell : data.cells) {
        lines += cell.line ? 1 : 0;
        corners += cell.points.size();
    }
    return {{"cells", cells},
            {"fields", data.field_values},
            {"points", described(places)},
            {"counts", {data.points.size(), lines, data.cells.size() - lines, corners}}};
}

/// Cell data of particles and contacts that the last frame of a test must contain.
json state_of(const std::string& folder) {
    std::ifstream in(folder + "/checkpoint", std::ios::binary);
    TestCheckpoint test = load_test(in, folder + "/checkpoint");
    World& world = test.world;
    const TestSetup& setup = test.setup;
    compute_forces(world);

    Arrays contacts;
    struct Stress {
        double xx = 0.0, yy = 0.0, xy = 0.0;
    };
    std::vector<Stress> stress(world.bodies.size());
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const PointView view = view_point(world, k);
        if (!view.touching) continue;
        contacts["normal_force"].push_back(view.normal_force);
        contacts["shear_force"].push_back(view.shear_force);
        const Vec2 force = view.shear_force * perpendicular(view.normal) - view.normal_force * view.normal;
        const auto add = [&](BodyIndex b, Vec2 on, Vec2 arm) {
            stress[b].xx -= arm.x * on.x;
            stress[b].yy -= arm.y * on.y;
            stress[b].xy -= 0.5 * (arm.x * on.y + arm.y * on.x);
        };
        add(view.body_i, force, view.arm_i);
        add(view.body_j, -force, view.arm_j);
    }

    Arrays particles;
    json discs = json::array(), polygons = json::array();
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies.state[b];
        const BodyInfo info = world.bodies.info(b);
        const bool circles = info.piece_count == 0;
        const std::vector<Vec2> places = element_positions(world, b);
        if (!circles && !setup.apparatus.is_platen(b)) {
            json corners = json::array();
            for (const Vec2 place : places) corners.push_back({place.x, place.y});
            polygons.push_back(corners);
        }
        const double share = setup.apparatus.is_platen(b)
                                 ? 0.0
                                 : world.settings.materials[info.material].density / world.bodies.inertia[b].mass;
        for (std::uint32_t e = 0; e < (circles ? info.element_count : 1); ++e) {
            const double radius = circles ? element_of(BodyView(world), b, info.first_element + e).radius : 0.0;
            if (circles) discs.push_back({places[e].x, places[e].y, radius});
            const auto put = [&](const char* name, std::initializer_list<double> values) {
                particles[name].insert(particles[name].end(), values);
            };
            put("id", {static_cast<double>(info.id)});
            put("radius", {radius});
            put("material", {info.material + 1.0});
            put("angle", {body.angle - setup.bonds.start[b].angle});
            put("displacement", {body.x - setup.bonds.start[b].x, body.y - setup.bonds.start[b].y, 0.0});
            put("velocity", {body.vx, body.vy, 0.0});
            put("rotation_rate", {body.omega});
            put("stress_xx", {share * stress[b].xx});
            put("stress_yy", {share * stress[b].yy});
            put("stress_xy", {share * stress[b].xy});
        }
    }
    return {{"particles", described(particles)},
            {"contacts", described(contacts)},
            {"bonds", setup.bonds.points.size()},
            {"time", world.stepping.time},
            {"discs", discs},
            {"polygons", polygons}};
}

}  // namespace

int main(int argc, char** argv) {
    const std::span words(argv, static_cast<std::size_t>(argc));
    const std::string mode = argc > 2 ? words[1] : "";
    if (mode != "read" && mode != "state") {
        std::cerr << "usage: frame_arrays read FILE... | frame_arrays state OUT\n";
        return 2;
    }
    try {
        json all = json::object();
        if (mode == "state") {
            all = state_of(words[2]);
        } else {
            for (const char* file : words.subspan(2)) all[file] = read_file(file);
        }
        std::cout << all << '\n';
        return 0;
    } catch (const InputError& error) {
        std::cerr << error.what() << '\n';
        return 2;
    }
}
