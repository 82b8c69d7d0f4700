// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a particle file (in_gm.dat or similar) as a recording of one frame.
// Tested by tests/tools/commands/view_test.cpp.

#include "solver/demseg/deck_reader.hpp"
#include "solver/demseg/geometry.hpp"
#include "solver/demseg/random_circles.hpp"
#include "specimens/recordings/recording.hpp"

namespace crackle {
Recording read_particle_recording(const std::filesystem::path& file, std::uint64_t seed) {
    DeckReader reader = DeckReader::open(file);
    Recording recording;
    recording.drawn_by_seed = read_geometry_mode(file) == 0;
    const Scene scene = recording.drawn_by_seed ? make_random_circles(read_random_geometry(reader), seed).scene
                                                : read_deck_geometry(reader).scene;
    if (const auto ignored = reader.ignored_numbers()) recording.notices.push_back(*ignored);
    recording.name = file.filename().string();
    recording.path = std::filesystem::weakly_canonical(file);
    recording.walls = {scene.domain.x1, scene.domain.x2, scene.domain.y1, scene.domain.y2};
    RecordedFrame frame;
    for (const Body& body : scene.bodies) {
        const auto add = [&](RecordedCell cell) {
            recording.cells.push_back(std::move(cell));
            frame.vx.push_back(body.velocity.x);
            frame.vy.push_back(body.velocity.y);
            frame.rotation_rate.push_back(body.spin);
        };
        for (std::uint32_t k = body.first_circle; k < body.first_circle + body.circle_count; ++k) {
            const CircleElement& circle = scene.circles[k];
            add({body.id, body.material + 1, circle.radius, false, false, circle.centre, {}});
        }
        if (body.vertex_count > 0) {
            const auto first = scene.vertices.begin() + body.first_vertex;
            std::vector<Vec2> outline(first, first + body.vertex_count);
            const Vec2 centre = centroid(outline, !body.closed);
            add({body.id, body.material + 1, 0.0, !body.closed, false, centre, std::move(outline)});
        }
    }
    for (std::vector<double>* motion : {&frame.ux, &frame.uy, &frame.angle}) motion->resize(recording.cells.size());
    recording.frames.emplace_back();
    recording.frames.back().file = recording.name;
    recording.frame = [frame](std::size_t) { return frame; };
    return recording;
}

}  // namespace crackle
