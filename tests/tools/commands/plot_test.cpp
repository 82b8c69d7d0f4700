// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle plot` as a user calls it: what its figures hold, by reading them back.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <pugixml.hpp>

#include "tests/support/program_call.hpp"
#include "tests/support/sample_results.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using namespace testing;
namespace fs = std::filesystem;

class PlotCommand : public ProgramCall {
  protected:
    PlotCommand() : ProgramCall("plot") {
        SampleTest tension;
        tension.kind = "tension";
        counts_ = write_sample_results(folder_ / "pulled", tension);
        write_sample_results(folder_ / "squeezed", SampleTest{});
    }
    std::string drawn(const std::string& words, const std::string& file) const {
        const Answer answer = call(words + " -o " + file);
        EXPECT_EQ(answer.code, 0) << answer.err;
        EXPECT_EQ(answer.out, file + "\n");
        return read(file);
    }
    SampleCounts counts_;
};

/// Width or height of a PNG, from its header.
std::uint32_t png_number(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t k = at; k < at + 4; ++k) number = 256 * number + static_cast<unsigned char>(bytes.at(k));
    return number;
}

/// Numbers of a path as they stand in it, pairs of x and y.
std::vector<Vec2> corners_of(const std::string& path) {
    std::vector<double> numbers;
    for (const char* at = path.c_str(); *at != '\0';) {
        char* end = nullptr;
        const double value = std::strtod(at, &end);
        if (end == at) {
            ++at;
            continue;
        }
        numbers.push_back(value);
        at = end;
    }
    std::vector<Vec2> corners;
    for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) corners.push_back({numbers[k], numbers[k + 1]});
    return corners;
}

double distance_from(Vec2 point, Vec2 a, Vec2 b) {
    const Vec2 along = b - a;
    const double square = dot(along, along), share = square > 0.0 ? dot(point - a, along) / square : 0.0;
    return norm(point - a - std::clamp(share, 0.0, 1.0) * along);
}

/// Shapes of an SVG that are filled with a colour, as Cairo writes it.
int shapes_filled(const std::string& svg, std::array<int, 3> rgb) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    int count = 0;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='path' or local-name()='rect']")) {
        const std::string style = node.node().attribute("style").value();
        std::array<double, 3> found{};
        const std::size_t fill = style.find("fill:rgb(");
        if (fill == std::string::npos ||
            std::sscanf(style.c_str() + fill, "fill:rgb(%lf%%,%lf%%,%lf%%)", &found[0], &found[1], &found[2]) != 3)
            continue;
        bool same = true;
        for (std::size_t k = 0; k < 3; ++k) same = same && std::abs(found[k] - 100.0 * rgb[k] / 255.0) < 0.01;
        count += same ? 1 : 0;
    }
    return count;
}

constexpr std::array<int, 3> grain{0xe3, 0xe0, 0xd9}, tension_colour{0x00, 0x72, 0xb2}, shear_colour{0xd5, 0x5e, 0x00};

TEST_F(PlotCommand, APngHasTheWidthAskedForAtItsResolution) {
    for (const auto& [words, mm, dpi] : {std::tuple("", 85.0, 300.0), std::tuple("--columns 2 --dpi 100", 180.0, 100.0),
                                         std::tuple("--width 120 --dpi 254", 120.0, 254.0)}) {
        const std::string png = drawn(fmt::format("pulled --what curve {}", words), "figure.png");
        ASSERT_TRUE(png.starts_with("\x89PNG\r\n"));
        const double expected = mm / 25.4 * dpi, got = png_number(png, 16);
        fmt::print("  {} mm at {} dpi: expected {:.1f} pixels, got {}\n", mm, dpi, expected, got);
        EXPECT_NEAR(got, expected, 0.5);
        EXPECT_GT(png_number(png, 20), 0.5 * expected);
    }
}

TEST_F(PlotCommand, APdfHasTheWidthAskedForAndCarriesItsFonts) {
    const std::string pdf = drawn("pulled squeezed", "figure.pdf");
    EXPECT_TRUE(pdf.starts_with("%PDF-"));
    EXPECT_NE(pdf.find("/FontFile"), std::string::npos) << "no font in it";
    const std::size_t box = pdf.find("/MediaBox [ 0 0 ");
    ASSERT_NE(box, std::string::npos);
    const double got = std::stod(pdf.substr(box + 16)), expected = 85.0 / 25.4 * 72.0;
    fmt::print("  width: expected {:.2f} pt, got {:.2f}\n", expected, got);
    EXPECT_NEAR(got, expected, 0.01);
}

TEST_F(PlotCommand, AnSvgHasAShapeForEachParticleAndNoFontButItsOwnOutlines) {
    const std::string svg = drawn("pulled --what specimen --at start", "figure.svg");
    const int got = shapes_filled(svg, grain);
    fmt::print("  particles: expected {}, got {}\n", counts_.particles, got);
    EXPECT_EQ(got, counts_.particles);
    EXPECT_EQ(svg.find("<text"), std::string::npos);
    EXPECT_EQ(svg.find("font-family"), std::string::npos);
}

TEST_F(PlotCommand, BarsOfBreaksAddUpToTheEventsOfEachMode) {
    const std::string svg = drawn("pulled --what ae --width 200", "figure.svg");
    // Heights of bars, in breaks: each mode's sum over the other's.
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg.c_str()));
    std::array<double, 2> sums{};
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='path']")) {
        const std::string style = node.node().attribute("style").value(), path = node.node().attribute("d").value();
        const bool tension = style.find("fill:rgb(0%,44.7") != std::string::npos;
        const bool shear = style.find("fill:rgb(83.5") != std::string::npos;
        if (!tension && !shear) continue;
        std::vector<double> y;
        for (const Vec2 corner : corners_of(path)) y.push_back(corner.y);
        const auto [low, high] = std::minmax_element(y.begin(), y.end());
        sums[shear ? 1 : 0] += *high - *low;
    }
    // The legend's samples are as high as each other.
    const double sample = 5.0, expected = static_cast<double>(counts_.shear_breaks) / counts_.tension_breaks;
    const double got = (sums[1] - sample) / (sums[0] - sample);
    fmt::print("  shear over tension: expected {:.4f}, got {:.4f}\n", expected, got);
    EXPECT_NEAR(got, expected, 0.01 * expected);
}

TEST_F(PlotCommand, CracksLieOnTheFacesThatTheyParted) {
    write_small_case(folder_, {.mesh = "voronoi", .output = "curve_rows = 2000\nframes = 5"});
    ASSERT_EQ(
        std::system(
            fmt::format("cd '{}' && '{}' test case.toml -o parted -q", folder_.string(), CRACKLE_PROGRAM).c_str()),
        0);
    // Magnified, so that parted faces are far from each other, and from their mean.
    const std::string svg = drawn("parted --what specimen --at end --magnify 50 --width 150", "figure.svg");
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg.c_str()));
    std::vector<std::vector<Vec2>> surfaces, cracks;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='path']")) {
        const std::string style = node.node().attribute("style").value();
        std::vector<Vec2> corners = corners_of(node.node().attribute("d").value());
        const bool closed = std::string(node.node().attribute("d").value()).find('Z') != std::string::npos;
        if (closed && style.find("fill:rgb(89") != std::string::npos) {  // a grain
            corners.push_back(corners.front());
            surfaces.push_back(corners);
        } else if (style.find("stroke:rgb(29.4") != std::string::npos) {  // a platen
            surfaces.push_back(corners);
        } else if (style.find("stroke:rgb(0%,44.7") != std::string::npos && corners.size() == 2) {
            cracks.push_back(corners);
        }
    }
    cracks.pop_back();  // the key's
    double worst = 0.0;
    for (const std::vector<Vec2>& crack : cracks) {
        const Vec2 middle = 0.5 * (crack[0] + crack[1]);
        double nearest = 1e300;
        for (const std::vector<Vec2>& surface : surfaces) {
            for (std::size_t k = 0; k + 1 < surface.size(); ++k)
                nearest = std::min(nearest, distance_from(middle, surface[k], surface[k + 1]));
        }
        worst = std::max(worst, nearest);
    }
    fmt::print("  {} faces of cracks, {} surfaces: at most {:.3f} pt from one\n", cracks.size(), surfaces.size(),
               worst);
    EXPECT_GT(cracks.size(), 10U);
    EXPECT_LT(worst, 0.5);  // half the gap of 1.08 mm at some 600 pt a metre, and single precision
}

TEST_F(PlotCommand, TheSameResultsGiveTheSameBytes) {
    for (const char* file : {"figure.svg", "figure.pdf", "figure.png"}) {
        const std::string first = drawn("pulled squeezed --labels one two --title Both", file);
        EXPECT_TRUE(first == drawn("pulled squeezed --labels one two --title Both", file)) << file;
    }
}

TEST_F(PlotCommand, TheNearestFrameIsDrawn) {
    // Frames at 0, the peak (1e-3) and the end (1.5e-3).
    const auto at = [&](const std::string& strain) {
        return drawn("pulled --what specimen --at " + strain, "figure.svg");
    };
    EXPECT_TRUE(at("0.00099") == at("peak"));
    EXPECT_TRUE(at("1e-5") == at("start"));
    EXPECT_FALSE(at("end") == at("peak"));
}

TEST_F(PlotCommand, AFrameMayBePeakAndEndAtOnce) {
    replace("pulled/summary.json", "frames/particles_00400.vtp", "frames/particles_00600.vtp");
    EXPECT_TRUE(drawn("pulled --what specimen --at end", "figure.svg") ==
                drawn("pulled --what specimen --at peak", "figure.svg"));
    EXPECT_FALSE(drawn("pulled", "figure.svg").empty());
}

TEST_F(PlotCommand, TheGuidesFiguresComeFromItsSixTests) {
    for (const auto& folder : write_six_sample_results(folder_ / "six")) {
        std::string name = folder.filename().string();
        name[name.find('-')] = '_';
        fs::rename(folder, folder.parent_path() / name);
    }
    const Answer answer = call("--guide six -o figures --format svg");
    ASSERT_EQ(answer.code, 0) << answer.err;
    for (int number = 26; number <= 29; ++number) EXPECT_TRUE(exists(fmt::format("figures/figure{}.svg", number)));
    EXPECT_FALSE(exists("figures/figure30.svg"));
    expect_refused("--guide pulled -o figures", "pulled/circles_tension: found no such folder");
    expect_refused("--guide six -o pulled/curve.csv", "a file, expected a folder");
}

TEST_F(PlotCommand, ATestWithoutFramesHasItsCurves) {
    fs::remove_all(folder_ / "pulled" / "frames");
    for (const char* role : {"start", "peak", "end"})
        replace("pulled/summary.json", std::string("\"frame_") + role, std::string("\"no_frame_") + role);
    EXPECT_FALSE(drawn("pulled", "figure.pdf").empty());
    expect_refused("pulled -o other.pdf --what specimen", "pulled: found no frames");
}

TEST_F(PlotCommand, RefusesWhatItCannotDrawAndLeavesTheFigureThatIsThere) {
    write("figure.pdf", "an earlier figure\n");
    expect_refused("", "found no folder of results");
    expect_refused("pulled", "found no -o");
    expect_refused("pulled -o figure.eps", "found 'eps', expected svg, pdf or png");
    expect_refused("pulled -o figure", "found '', expected svg, pdf or png");
    expect_refused("nowhere -o figure.pdf", "nowhere: found no such folder");
    expect_refused("pulled -o figure.pdf --what cracks", "--what: found 'cracks', expected curve, ae, specimen or all");
    expect_refused("pulled -o figure.pdf --at 0.5", "--at: found 0.5, expected 0 to 0.0015, the last strain of pulled");
    expect_refused("pulled -o figure.pdf --at soon", "--at: found 'soon', expected a strain, start, peak or end");
    expect_refused("pulled -o figure.pdf --width 3", "--width: found 3, expected 30 to 1000 mm");
    expect_refused("pulled -o figure.pdf --columns 3", "--columns: found 3, expected 1 or 2");
    expect_refused("pulled -o figure.pdf --font-size 0", "--font-size: found 0");
    expect_refused("pulled -o figure.pdf --dpi 1e9", "--dpi: found");
    expect_refused("pulled squeezed -o figure.pdf --labels one", "--labels: found 1 names, expected 2");
    expect_refused("pulled -o no/such/figure.pdf", "cannot be written");
}

}  // namespace
}  // namespace crackle
