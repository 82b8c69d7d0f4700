// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/report_page.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <span>
#include <system_error>

#include "solver/errors.hpp"
#include "specimens/observers/base64.hpp"
#include "tools/page_template.hpp"

namespace crackle::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view data_marker = "@CRACKLE_DATA@";

template <class T>
constexpr const char* type_name();
template <>
constexpr const char* type_name<double>() {
    return "f64";
}
template <>
constexpr const char* type_name<float>() {
    return "f32";
}
template <>
constexpr const char* type_name<std::int32_t>() {
    return "i32";
}
template <>
constexpr const char* type_name<std::uint8_t>() {
    return "u8";
}

/// The arrays of one test: bytes, and where each array lies in them.
class ArrayStore {
  public:
    template <class T>
    void add(const std::string& name, const std::vector<T>& values) {
        bytes_.resize((bytes_.size() + 7) / 8 * 8);  // the page views them in place: each on a multiple of its size
        places_[name] = {{"type", type_name<T>()}, {"offset", bytes_.size()}, {"length", values.size()}};
        const std::size_t begin = bytes_.size();
        bytes_.resize(begin + values.size() * sizeof(T));
        if (!values.empty()) std::memcpy(bytes_.data() + begin, values.data(), values.size() * sizeof(T));
    }

    const Json& places() const { return places_; }

    std::string packed() const {
        auto size = compressBound(static_cast<uLong>(bytes_.size()));
        std::vector<unsigned char> out(size);
        if (compress2(out.data(), &size, bytes_.data(), static_cast<uLong>(bytes_.size()), Z_BEST_COMPRESSION) !=
            Z_OK) {
            throw std::runtime_error("zlib could not compress the report's data");
        }
        return encode_base64(std::span(out).first(size));
    }

  private:
    std::vector<unsigned char> bytes_;
    Json places_ = Json::object();
};

template <class T>
std::vector<T> converted(const std::vector<double>& values) {
    std::vector<T> out;
    out.reserve(values.size());
    for (const double value : values) out.push_back(static_cast<T>(value));
    return out;
}

Vec2 mean(const std::vector<Vec2>& points) {
    Vec2 sum;
    for (const Vec2 point : points) sum = sum + point;
    return (1.0 / static_cast<double>(points.size())) * sum;
}

void add_events(ArrayStore& store, const NumberTable& events) {
    for (const char* name : {"time", "axial_strain", "x", "y"})
        store.add(std::string("events.") + name, *events.find(name));
    for (const char* name : {"body_i", "body_j"})
        store.add(std::string("events.") + name, converted<std::int32_t>(*events.find(name)));
    store.add("events.shear", converted<std::uint8_t>(*events.find("mode")));
    store.add("events.last_of_interface", converted<std::uint8_t>(*events.find("last_of_interface")));
}

/// Outlines once, from the first frame (a circle's polygon shrinks to its centre, about which the page draws the true
/// circle), then the rigid motions of each frame.
/// Single precision: a hundred-millionth of the specimen, far below what a screen shows.
Json add_frames(ArrayStore& store, const std::vector<KeyFrame>& frames) {
    std::vector<std::int32_t> id, first_point{0};
    std::vector<float> radius, x, y;
    std::vector<std::uint8_t> open;
    const std::vector<FrameBody> none;
    for (const FrameBody& body : frames.empty() ? none : frames.front().particles.bodies) {
        id.push_back(body.id);
        radius.push_back(static_cast<float>(body.radius));
        open.push_back(body.open ? 1 : 0);
        const std::vector<Vec2> points = body.radius > 0.0 ? std::vector<Vec2>{mean(body.outline)} : body.outline;
        for (const Vec2 point : points) {
            x.push_back(static_cast<float>(point.x));
            y.push_back(static_cast<float>(point.y));
        }
        first_point.push_back(static_cast<std::int32_t>(x.size()));
    }
    store.add("bodies.id", id);
    store.add("bodies.radius", radius);
    store.add("bodies.open", open);
    store.add("bodies.first_point", first_point);
    store.add("bodies.x", x);
    store.add("bodies.y", y);

    Json listed = Json::array();
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const KeyFrame& frame = frames[k];
        const std::string prefix = fmt::format("frame{}", k);
        std::vector<float> centre_x, centre_y, angle;
        for (const FrameBody& body : frame.particles.bodies) {
            const Vec2 centre = mean(body.outline);
            centre_x.push_back(static_cast<float>(centre.x));
            centre_y.push_back(static_cast<float>(centre.y));
            angle.push_back(static_cast<float>(body.angle));
        }
        store.add(prefix + ".x", centre_x);
        store.add(prefix + ".y", centre_y);
        store.add(prefix + ".angle", angle);
        listed.push_back({{"role", frame.role},
                          {"file", frame.file},
                          {"time", frame.particles.time},
                          {"axial_strain", frame.particles.axial_strain},
                          {"prefix", prefix}});
    }
    return listed;
}

Json test_entry(const TestResults& test) {
    ArrayStore store;
    for (std::size_t k = 0; k < test.curve.names.size(); ++k)
        store.add("curve." + test.curve.names[k], test.curve.columns[k]);
    add_events(store, test.events);
    Json frames = add_frames(store, test.frames);
    return {{"name", test.name},
            {"summary", test.summary},
            {"arrays", store.places()},
            {"frames", std::move(frames)},
            {"data", store.packed()}};
}

/// Inside a script element only `<` can do harm (</script>, <!--); in JSON it stands in strings alone.
std::string safe_in_script(const std::string& json) {
    std::string out;
    out.reserve(json.size());
    for (const char letter : json) {
        if (letter == '<') {
            out += "\\u003c";
        } else {
            out += letter;
        }
    }
    return out;
}

std::string default_title(const std::vector<TestResults>& tests) {
    if (tests.size() != 1) return "Virtual rock tests";
    const TestResults& test = tests.front();
    if (const auto title = test.summary.find("title");
        title != test.summary.end() && title->is_string() && !title->get<std::string>().empty()) {
        return title->get<std::string>();
    }
    return test.name;
}

void refuse_foreign_file(const std::filesystem::path& output) {
    std::error_code error;  // write_report() says what cannot be written
    if (!std::filesystem::exists(output, error)) return;
    if (!is_report_page(output)) {
        throw InputError(fmt::format(
            "{}: found something that is not a crackle report, expected a new name or an earlier report; choose "
            "another name with -o",
            output.string()));
    }
}

}  // namespace

std::string report_page(std::string_view page, const std::string& title, const std::vector<TestResults>& tests) {
    const std::size_t marker = page.find(data_marker);
    if (marker == std::string_view::npos) {
        throw InputError(
            "this build of crackle holds no report page; configure with -DCRACKLE_VIEWER=ON (needs Node 18 or later "
            "and npm)");
    }
    Json manifest{
        {"format", "crackle-report 1"}, {"title", title}, {"version", CRACKLE_VERSION}, {"tests", Json::array()}};
    for (const TestResults& test : tests) manifest["tests"].push_back(test_entry(test));

    std::string out(page.substr(0, marker));
    // Names from file systems may not be UTF-8: shown with replacement characters rather than refused.
    out += safe_in_script(manifest.dump(-1, ' ', false, Json::error_handler_t::replace));
    out += page.substr(marker + data_marker.size());
    return out;
}

void write_report(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& output,
                  const std::string& title) {
    refuse_foreign_file(output);
    std::vector<TestResults> tests;
    tests.reserve(folders.size());
    for (const std::filesystem::path& folder : folders) tests.push_back(read_results(folder));
    const std::string page = report_page(page_template(), title.empty() ? default_title(tests) : title, tests);

    const std::filesystem::path temporary = output.string() + ".tmp";
    std::ofstream out(temporary, std::ios::binary);
    out.write(page.data(), static_cast<std::streamsize>(page.size()));
    out.close();
    std::error_code error;
    if (out) std::filesystem::rename(temporary, output, error);
    if (!out || error) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw InputError(fmt::format("{}: cannot be written{}; choose another place with -o", output.string(),
                                     error ? " (" + error.message() + ")" : ""));
    }
}

}  // namespace crackle::tools
