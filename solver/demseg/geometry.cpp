// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes in_gm.dat. See geometry.hpp and FORMATS.md.

#include "solver/demseg/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <unordered_set>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/demseg/circle_list.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/files/file_kind.hpp"

namespace crackle {
namespace {

constexpr std::int64_t largest_count = std::numeric_limits<int>::max();
// Largest distance at which the ends of adjacent segments count as coincident, relative to the length of the chain.
constexpr double joint_tolerance = 1e-6;

/// Values at the beginning of a file, common to both modes.
struct Head {
    double time_step = 0.0;
    Vec2 gravity;
    std::vector<Material> materials;
    Domain domain;
    double thick = 0.0;
};

constexpr const char* particle_file = "a particle file (in_gm.dat)";

int read_mode(DeckReader& reader) {
    refuse_foreign(reader.name(), reader.text(), particle_file);
    if (const std::string_view form = circle_list_form(reader.text()); !form.empty()) {
        throw InputError(
            fmt::format("{}: found a list of {}, expected {}; `crackle mesh` makes one with polygons around "
                        "such centres",
                        reader.name(), form, particle_file));
    }
    return static_cast<int>(reader.integer("mode", 0, 1));
}

void read_sub_modes(DeckReader& reader) {
    for (const char* key : {"mode2", "mode3"}) {
        if (reader.integer(key, std::numeric_limits<int>::min(), largest_count) != 0)
            reader.refuse(key, "0 (other values are not supported)");
    }
}

Head read_head(DeckReader& reader) {
    Head head;
    reader.begin_read();
    head.time_step = reader.number_not_negative("dt");
    head.gravity.x = reader.number("gx");
    head.gravity.y = reader.number("gy");
    reader.begin_read();
    const std::int64_t materials = reader.integer("nmat", 1, largest_count);
    for (std::int64_t m = 0; m < materials; ++m) {
        Material material;
        reader.begin_read();
        material.density = reader.positive_number(fmt::format("rho({})", m + 1));
        material.normal_stiffness = reader.positive_number(fmt::format("kn({})", m + 1));
        material.shear_stiffness = reader.number_not_negative(fmt::format("ks({})", m + 1));
        material.normal_damping = reader.number_not_negative(fmt::format("cn({})", m + 1));
        material.shear_damping = reader.number_not_negative(fmt::format("cs({})", m + 1));
        material.friction_angle = reader.number_not_negative(fmt::format("mu({})", m + 1));
        if (material.friction_angle >= 90.0)
            reader.refuse(fmt::format("mu({})", m + 1), "an angle in degrees, 0 <= mu < 90");
        head.materials.push_back(material);
    }
    reader.begin_read();
    head.domain.x1 = reader.number("x1");
    head.domain.x2 = reader.number("x2");
    if (!(head.domain.x2 > head.domain.x1)) reader.refuse("x2", fmt::format("more than x1 = {}", head.domain.x1));
    head.domain.y1 = reader.number("y1");
    head.domain.y2 = reader.number("y2");
    if (!(head.domain.y2 > head.domain.y1)) reader.refuse("y2", fmt::format("more than y1 = {}", head.domain.y1));
    head.thick = reader.number_not_negative("thick");
    return head;
}

/// Makes corners counter-clockwise. This is done here rather than in validate(), so that the first segment stays first;
/// its direction defines the body's angle.
void turn_counter_clockwise(std::vector<Vec2>& corners) {
    double twice_area = 0.0;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        twice_area += cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    if (twice_area >= 0.0) return;
    std::reverse(corners.begin(), corners.end());
    std::rotate(corners.begin(), corners.end() - 2, corners.end());
}

/// Reads bodies into the scene; their ids must be unique.
class BodyReader {
  public:
    BodyReader(DeckReader& reader, Scene& scene) : reader_(reader), scene_(scene) {}

    void read_circles() {
        Body body = read_head("ncir");
        body.first_circle = static_cast<std::uint32_t>(scene_.circles.size());
        body.circle_count = elements_;
        for (std::uint32_t e = 1; e <= elements_; ++e) {
            reader_.begin_read();
            reader_.integer(key(body.id, "ielm"), e, e);
            CircleElement circle;
            circle.radius = reader_.positive_number(key(body.id, "radius"));
            reader_.begin_read();
            circle.centre.x = reader_.number(key(body.id, "xc"));
            circle.centre.y = reader_.number(key(body.id, "yc"));
            circle.angle = reader_.number(key(body.id, "angle"));
            scene_.circles.push_back(circle);
        }
        scene_.bodies.push_back(body);
    }

    void read_segments() {
        Body body = read_head("nseg");
        std::vector<Vec2> joints;
        double length = 0.0;
        for (std::uint32_t e = 1; e <= elements_; ++e) {
            reader_.begin_read();
            reader_.integer(key(body.id, "ielm"), e, e);
            const Vec2 start = read_point(body.id, "xs", "ys");
            const int start_line = reader_.line();
            // The DEMseg guide does not show whether a single READ statement reads both ends.
            if (!reader_.numbers_follow(2)) reader_.begin_read();
            const Vec2 end = read_point(body.id, "xe", "ye");
            length += norm(end - start);
            if (!(norm(end - start) > 0.0))
                reader_.refuse(key(body.id, "xe ye"), fmt::format("{} {}", end.x, end.y),
                               "a point that differs from xs ys");
            if (e == 1) {
                joints.push_back(start);
            } else if (norm(start - joints.back()) > joint_tolerance * length) {
                throw InputError(fmt::format(
                    "{}:{}: body {}: segment {} starts at {} {}, expected it at {} {}, where segment {} ends; "
                    "the segments of a body form one chain",
                    reader_.name(), start_line, body.id, e, start.x, start.y, joints.back().x, joints.back().y, e - 1));
            }
            joints.push_back(end);
        }
        body.closed = elements_ >= 3 && norm(joints.back() - joints.front()) <= joint_tolerance * length;
        if (body.closed) {
            joints.pop_back();
            turn_counter_clockwise(joints);
        }
        body.first_vertex = static_cast<std::uint32_t>(scene_.vertices.size());
        body.vertex_count = static_cast<std::uint32_t>(joints.size());
        scene_.vertices.insert(scene_.vertices.end(), joints.begin(), joints.end());
        scene_.bodies.push_back(body);
    }

  private:
    static std::string key(int id, const char* name) { return fmt::format("body {}: {}", id, name); }

    Vec2 read_point(int id, const char* x, const char* y) {
        const double px = reader_.number(key(id, x));
        return {px, reader_.number(key(id, y))};
    }

    Body read_head(const char* group) {
        Body body;
        reader_.begin_read();
        const std::string which = fmt::format("id of {} body {}", group, scene_.bodies.size() + 1);
        body.id = static_cast<int>(reader_.integer(which, 1, largest_count));
        if (!ids_.insert(body.id).second)
            reader_.refuse(which, fmt::format("{} a second time", body.id), "a number that no other body has");
        body.material = static_cast<int>(reader_.integer(key(body.id, "imat"), 1,
                                                         static_cast<std::int64_t>(scene_.materials.size()))) -
                        1;
        elements_ = static_cast<std::uint32_t>(reader_.integer(key(body.id, "nelm"), 1, largest_count));
        reader_.begin_read();
        body.velocity.x = reader_.number(key(body.id, "vx"));
        body.velocity.y = reader_.number(key(body.id, "vy"));
        body.spin = reader_.number(key(body.id, "vw"));
        return body;
    }

    DeckReader& reader_;
    Scene& scene_;
    std::unordered_set<int> ids_;
    std::uint32_t elements_ = 0;  // number of elements of the body being read
};

/// Refuses properties that a scene may have but the format cannot represent, instead of dropping them.
void check_writable(const Scene& scene) {
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        if (scene.materials[m].damping_ratio) {
            throw InputError(
                fmt::format("material {}: found a damping ratio, expected coefficients of normal and shear damping, "
                            "because in_gm.dat cannot hold a ratio",
                            m + 1));
        }
    }
    const Domain& domain = scene.domain;
    for (std::size_t w = 0; w < domain.wall_present.size(); ++w) {
        if (!domain.wall_present[w])
            throw InputError(
                "domain: found a side without a wall, expected walls on all four sides, because in_gm.dat cannot omit "
                "a wall");
    }
    for (const double side : {domain.x1, domain.x2, domain.y1, domain.y2}) {
        if (!std::isfinite(side))
            throw InputError(fmt::format(
                "domain: found the coordinate {}, expected finite coordinates of all sides for in_gm.dat", side));
    }
}

void write_head(std::ostream& out, const Scene& scene) {
    out << "1 0 0\n";
    out << fmt::format("{} {} {}\n", scene.time_step, scene.gravity.x, scene.gravity.y);
    out << scene.materials.size() << '\n';
    for (const Material& m : scene.materials) {
        out << fmt::format("{} {} {} {} {} {}\n", m.density, m.normal_stiffness, m.shear_stiffness, m.normal_damping,
                           m.shear_damping, m.friction_angle);
    }
    out << fmt::format("{} {} {} {} {}\n", scene.domain.x1, scene.domain.x2, scene.domain.y1, scene.domain.y2,
                       scene.thick);
}

void write_body_head(std::ostream& out, const Body& body, std::uint32_t elements) {
    out << fmt::format("{} {} {}\n{} {} {}\n", body.id, body.material + 1, elements, body.velocity.x, body.velocity.y,
                       body.spin);
}

void write_segments(std::ostream& out, const Scene& scene, const Body& body) {
    const std::uint32_t segments = body.closed ? body.vertex_count : body.vertex_count - 1;
    write_body_head(out, body, segments);
    for (std::uint32_t k = 0; k < segments; ++k) {
        const Vec2 start = scene.vertices[body.first_vertex + k];
        const Vec2 end = scene.vertices[body.first_vertex + (k + 1) % body.vertex_count];
        out << fmt::format("{} {} {}\n{} {}\n", k + 1, start.x, start.y, end.x, end.y);
    }
}

}  // namespace

int read_geometry_mode(const std::filesystem::path& path) {
    DeckReader reader = DeckReader::open(path);
    return read_mode(reader);
}

int read_geometry_mode(const DeckReader& reader) {
    DeckReader own = reader;
    return read_mode(own);
}

Scene read_geometry(const std::filesystem::path& path) { return read_deck_geometry(path).scene; }

DeckGeometry read_deck_geometry(const std::filesystem::path& path) {
    DeckReader reader = DeckReader::open(path);
    return read_deck_geometry(reader);
}

DeckGeometry read_deck_geometry(DeckReader& reader) {
    if (read_mode(reader) != 1) {
        reader.refuse("mode",
                      "1 (the file lists all bodies); mode 0 requests random circles, which `crackle run` generates");
    }
    read_sub_modes(reader);
    const Head head = read_head(reader);
    DeckGeometry geometry;
    Scene& scene = geometry.scene;
    scene.time_step = head.time_step;
    scene.gravity = head.gravity;
    scene.materials = head.materials;
    scene.domain = head.domain;
    scene.thick = head.thick;
    scene.first_kick = FirstKick::full;
    scene.bare_segment_width = deck_bare_segment_width;

    reader.begin_read();
    const std::int64_t circles = reader.integer("ncir", 0, largest_count);
    const std::int64_t segments = reader.integer("nseg1", 0, largest_count);
    const std::int64_t large = reader.integer("nseg2", 0, largest_count);
    if (circles + segments + large == 0) reader.refuse("ncir nseg1 nseg2", "0 0 0", "at least one body");
    BodyReader bodies(reader, scene);
    for (std::int64_t k = 0; k < circles; ++k) bodies.read_circles();
    for (std::int64_t k = 0; k < segments + large; ++k) bodies.read_segments();
    reader.end_reads();
    geometry.large_segments = static_cast<std::size_t>(large);
    try {
        validate(scene);
    } catch (const InputError& error) {
        throw InputError(reader.name() + ": " + error.what());
    }
    return geometry;
}

RandomGeometry read_random_geometry(const std::filesystem::path& path) {
    DeckReader reader = DeckReader::open(path);
    return read_random_geometry(reader);
}

RandomGeometry read_random_geometry(DeckReader& reader) {
    if (read_mode(reader) != 0) reader.refuse("mode", "0 (random circles)");
    read_sub_modes(reader);
    const Head head = read_head(reader);
    RandomGeometry geometry;
    geometry.time_step = head.time_step;
    geometry.gravity = head.gravity;
    geometry.materials = head.materials;
    geometry.domain = head.domain;
    geometry.thick = head.thick;
    reader.begin_read();
    geometry.radius_min = reader.positive_number("rmin");
    geometry.radius_max = reader.positive_number("rmax");
    if (geometry.radius_max < geometry.radius_min)
        reader.refuse("rmax", fmt::format("at least rmin = {}", geometry.radius_min));
    reader.begin_read();
    geometry.material =
        static_cast<int>(reader.integer("material", 1, static_cast<std::int64_t>(head.materials.size()))) - 1;
    reader.begin_read();
    geometry.void_ratio = reader.number_not_negative("void ratio");
    reader.end_reads();
    return geometry;
}

void write_geometry(std::ostream& out, const Scene& scene, std::size_t large_segments) {
    std::size_t circles = 0;
    for (const Body& body : scene.bodies) circles += body.circle_count > 0 ? 1 : 0;
    const std::size_t chains = scene.bodies.size() - circles;
    if (large_segments > chains) {
        throw InputError(
            fmt::format("nseg2: found {}, expected at most the number of segment bodies, {}", large_segments, chains));
    }
    check_writable(scene);
    write_head(out, scene);
    out << fmt::format("{} {} {}\n", circles, chains - large_segments, large_segments);
    for (const Body& body : scene.bodies) {
        if (body.circle_count == 0) continue;
        write_body_head(out, body, body.circle_count);
        for (std::uint32_t k = 0; k < body.circle_count; ++k) {
            const CircleElement& circle = scene.circles[body.first_circle + k];
            out << fmt::format("{} {}\n{} {} {}\n", k + 1, circle.radius, circle.centre.x, circle.centre.y,
                               circle.angle);
        }
    }
    for (const Body& body : scene.bodies) {
        if (body.circle_count == 0) write_segments(out, scene, body);
    }
}

}  // namespace crackle
