// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle plot` as called by a user, by reading its figures.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>

#include "tests/support/drawn_figure.hpp"
#include "tests/support/png_file.hpp"
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
        const Answer answer = call(words + " --force -o " + file);
        EXPECT_EQ(answer.code, 0) << answer.err;
        EXPECT_EQ(answer.out, file + "\n");
        return read(file);
    }
    SampleCounts counts_;
};

double distance_from(Vec2 point, Vec2 a, Vec2 b) {
    const Vec2 along = b - a;
    const double square = dot(along, along), share = square > 0.0 ? dot(point - a, along) / square : 0.0;
    return norm(point - a - std::clamp(share, 0.0, 1.0) * along);
}

/// Number of ticks to the left of an axis.
int ticks_of(const std::string& svg, const std::vector<Vec2>& frame) {
    int count = 0;
    for (const std::vector<Vec2>& line : lines_of(svg)) {
        count += line.size() == 2 && line[0].y == line[1].y && line[0].x == frame[0].x && line[1].x < line[0].x &&
                         line[0].y >= frame[0].y - 1e-3 && line[0].y <= frame[1].y + 1e-3
                     ? 1
                     : 0;
    }
    return count;
}

/// Number of shapes in an SVG that are filled with a colour, as Cairo writes it.
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

constexpr std::array<int, 3> grain{0xe3, 0xe0, 0xd9};

/// The longest line in a figure.
std::vector<Vec2> curve_in(const std::string& svg) {
    const std::vector<std::vector<Vec2>> lines = lines_of(svg);
    return *std::ranges::max_element(lines, {}, &std::vector<Vec2>::size);
}

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
    // Compares the total heights of the bars of the two modes.
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
    // The samples in the legend have equal heights.
    const double sample = 5.0, expected = static_cast<double>(counts_.shear_breaks) / counts_.tension_breaks;
    const double got = (sums[1] - sample) / (sums[0] - sample);
    fmt::print("  shear over tension: expected {:.4f}, got {:.4f}\n", expected, got);
    EXPECT_NEAR(got, expected, 0.01 * expected);
}

TEST_F(PlotCommand, MagnitudesOfAllTestsAreDrawnTogetherWithTheirLine) {
    SampleTest heard;
    heard.emission = 120;
    write_sample_results(folder_ / "heard", heard);
    heard.emission = 80;
    write_sample_results(folder_ / "heard_too", heard);
    const std::string svg = drawn("heard heard_too --what emission --width 200", "figure.svg");
    // One disc per event on the curve (plus one in the legend), and one on a map.
    EXPECT_EQ(shapes_filled(svg, {29, 33, 37}), 200 + 1);
    std::vector<std::vector<Vec2>> fitted;
    for (const std::vector<Vec2>& line : lines_of(svg))
        if (line.size() == 2 && line[0].x < line[1].x - 20.0 && line[0].y < line[1].y - 20.0) fitted.push_back(line);
    ASSERT_EQ(fitted.size(), 1U) << "the line, downwards";
    // In axis units: magnitudes are quantiles of the law with b = 1, for which the maximum-likelihood fit of 60 events
    // gives the same tail.
    const std::vector<std::vector<Vec2>> frames = frames_of(svg);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_GT(fitted[0][0].x, frames[0][1].x);
    EXPECT_LT(fitted[0][1].y, frames[0][1].y);
}

TEST_F(PlotCommand, OfATestThatDidNotListenThereIsNoEmission) {
    expect_refused("pulled --force -o figure.pdf --what emission", "pulled: found no ae.csv");
    EXPECT_FALSE(drawn("pulled", "figure.pdf").empty());
}

TEST_F(PlotCommand, FewMagnitudesHaveNoLine) {
    SampleTest heard;
    heard.emission = 30;
    write_sample_results(folder_ / "heard", heard);
    const std::string svg = drawn("heard --what emission --width 200", "figure.svg");
    EXPECT_EQ(shapes_filled(svg, {29, 33, 37}), 30 + 1);
    for (const std::vector<Vec2>& line : lines_of(svg))
        EXPECT_FALSE(line.size() == 2 && line[0].x < line[1].x - 20.0 && line[0].y < line[1].y - 20.0);
}

/// Cells of a table's last line.
std::vector<double> last_line(const std::string& table) {
    const std::size_t begin = table.rfind('\n', table.size() - 2) + 1;
    std::istringstream cells(table.substr(begin));
    std::vector<double> numbers;
    for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::stod(cell));
    return numbers;
}

TEST_F(PlotCommand, AreaStrainIsDrawnWithWhatOfItIsCracks) {
    std::vector<std::vector<Vec2>> curves;
    for (const std::vector<Vec2>& line : lines_of(drawn("squeezed --what strain --width 200", "figure.svg")))
        if (line.size() > 20) curves.push_back(line);
    ASSERT_EQ(curves.size(), 2U);
    const std::vector<double> end = last_line(read("squeezed/curve.csv"));
    // The sample's modulus and Poisson's ratio.
    const double area = end[0] - end[4], cracks = area - (1.0 - 0.21) * end[1] / 5.0e6;
    const auto height_of = [](const std::vector<Vec2>& curve) { return curve.front().y - curve.back().y; };
    const double got = height_of(curves[1]) / height_of(curves[0]), expected = cracks / area;
    fmt::print("  strain of cracks over that of the area: expected {:.4f}, got {:.4f}\n", expected, got);
    EXPECT_NEAR(got, expected, 1e-3);
}

TEST_F(PlotCommand, OfASpecimenWithoutSidesHasNoAreaStrain) {
    std::istringstream rows(read("squeezed/curve.csv"));
    std::string table, row;
    for (bool head = true; std::getline(rows, row); head = false) {
        std::vector<std::string> cells;
        std::istringstream line(row);
        for (std::string cell; std::getline(line, cell, ',');) cells.push_back(cell);
        if (!head) cells[4] = "nan";
        table += fmt::format("{}\n", fmt::join(cells, ","));
    }
    std::ofstream(folder_ / "squeezed" / "curve.csv") << table;
    expect_refused("squeezed --force -o figure.pdf --what strain", "found no lateral strain");
    EXPECT_FALSE(drawn("squeezed", "figure.svg").empty()) << "of all bodies";
}

TEST_F(PlotCommand, CracksLieOnTheFacesThatTheyParted) {
    write_small_case(folder_, {.mesh = "voronoi", .output = "curve_rows = 2000\nframes = 5"});
    ASSERT_EQ(
        std::system(
            fmt::format("cd '{}' && '{}' test case.toml -o parted -q", folder_.string(), CRACKLE_PROGRAM).c_str()),
        0);
    // Magnified, so that separated faces are far from each other and from their mean.
    const std::string svg = drawn("parted --what specimen --at end --magnify 50 --width 150", "figure.svg");
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg.c_str()));
    std::vector<std::vector<Vec2>> surfaces, cracks;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='path']")) {
        const std::string style = node.node().attribute("style").value();
        std::vector<Vec2> corners = corners_of(node.node().attribute("d").value());
        const bool closed = std::string(node.node().attribute("d").value()).find('Z') != std::string::npos;
        if (closed && style.find("fill:rgb(89") != std::string::npos) {  // a particle
            corners.push_back(corners.front());
            surfaces.push_back(corners);
        } else if (style.find("stroke:rgb(29.4") != std::string::npos) {  // a platen
            surfaces.push_back(corners);
        } else if (style.find("stroke:rgb(0%,44.7") != std::string::npos && corners.size() == 2) {
            cracks.push_back(corners);
        }
    }
    cracks.pop_back();  // removes that of the key
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
    EXPECT_LT(worst, 0.5);  // half the gap of 1.08 mm at about 600 pt per metre, plus single precision
}

/// Straight lines of a colour, as Cairo writes it.
std::vector<std::vector<Vec2>> lines_in(const std::string& svg, const std::string& stroke) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    std::vector<std::vector<Vec2>> lines;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='path']")) {
        const std::string style = node.node().attribute("style").value();
        std::vector<Vec2> corners = corners_of(node.node().attribute("d").value());
        if (corners.size() == 2 && style.find("stroke:rgb(" + stroke) != std::string::npos) lines.push_back(corners);
    }
    return lines;
}

/// Runs a test of a small rock of cells with joints or minerals. @param tables TOML tables of traces or minerals
void test_cells(const fs::path& folder, const std::string& name, const std::string& tables) {
    write_small_case(folder, {.kind = "compression",
                              .mesh = "voronoi",
                              .max_strain = 1e-4,
                              .output = "curve_rows = 20\nframes = 2",
                              .material = "units = \"area\"\ncontact_modulus = 5e7\nstiffness_ratio = 2.5\n"
                                          "friction_angle = 30.0\ntensile_strength = 1e4\ncohesion = 3e4",
                              .bond = "law = \"coulomb\"",
                              .minerals = tables});
    const std::string words = fmt::format("'{}' test case.toml -o {} -q", CRACKLE_PROGRAM, name);
    ASSERT_EQ(std::system(fmt::format("cd '{}' && {}", folder.string(), words).c_str()), 0);
}

TEST_F(PlotCommand, OpenJointsAreDrawnFromTheStart) {
    const auto drawn_with = [&](const std::string& name, const std::string& tables) {
        test_cells(folder_, name, tables);
        return drawn(name + " --what specimen --at start --width 150", "figure.svg");
    };
    // The trace has a slope of one half.
    const auto on_trace = [](const std::string& svg, const std::string& stroke) {
        return std::ranges::count_if(lines_in(svg, stroke), [](const std::vector<Vec2>& line) {
            const double along = line[1].x - line[0].x, up = line[0].y - line[1].y;
            return std::abs(along) > 0.1 && std::abs(up / along - 0.5) < 0.05;
        });
    };
    const std::string trace = "[[trace]]\nname = \"flaw\"\npoints = [0.05, 0.2, 0.19, 0.27]\n";
    const std::string ink = "11.3", green = "16.4";
    const std::string open = drawn_with("open", trace + "bonded = false\n"), closed = drawn_with("closed", trace);
    fmt::print("  faces of the open joint {}, of the bonded one {}\n", on_trace(open, ink), on_trace(closed, green));
    EXPECT_GT(on_trace(open, ink), 3);
    EXPECT_EQ(on_trace(open, green), 0);
    EXPECT_GT(on_trace(closed, green), 3);
    EXPECT_EQ(on_trace(closed, ink), 0);
}

TEST_F(PlotCommand, MineralsHaveColoursAndAKey) {
    test_cells(folder_, "grains",
               "[[mineral]]\nname = \"quartz\"\narea_share = 0.3\n[[mineral]]\nname = \"mica\"\narea_share = 0.7\n"
               "cohesion = 2e4");
    const nlohmann::json minerals = nlohmann::json::parse(read("grains/summary.json")).at("minerals");
    const std::string svg = drawn("grains --what specimen --at start", "figure.svg");
    EXPECT_EQ(shapes_filled(svg, grain), 0);
    constexpr std::array<std::array<int, 3>, 2> colours{{{0xec, 0xe9, 0xe2}, {0xd9, 0xb9, 0xa3}}};
    for (std::size_t k = 0; k < colours.size(); ++k)
        EXPECT_EQ(shapes_filled(svg, colours.at(k)), minerals[k].at("grains").get<int>() + 1) << "grains, and the key";
}

TEST_F(PlotCommand, SignsOfCracksHideNeitherTheCurveNorEachOther) {
    SampleTest test;
    const auto middles = [&](double initiation, double damage) {
        write_sample_results(folder_ / "marked", test);
        nlohmann::ordered_json summary = nlohmann::ordered_json::parse(read("marked/summary.json"));
        summary["crack_initiation_stress"] = initiation * summary["peak_stress"].get<double>();
        summary["crack_damage_stress"] = damage * summary["peak_stress"].get<double>();
        std::ofstream(folder_ / "marked/summary.json") << summary.dump(2) << '\n';
        const std::string svg = drawn("marked --what curve --width 120", "figure.svg");
        // The symbol σ is the only letter in its font and size, so each label has one.
        std::map<std::string, std::vector<Vec2>> by_glyph;
        pugi::xml_document document;
        EXPECT_TRUE(document.load_string(svg.c_str()));
        for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='use']"))
            by_glyph[node.node().attribute("xlink:href").value()].push_back(
                {node.node().attribute("x").as_double(), node.node().attribute("y").as_double()});
        std::vector<std::vector<Vec2>> pairs;
        const std::vector<Vec2> frame = frames_of(svg).front();
        for (const auto& [glyph, places] : by_glyph)
            if (places.size() == 2 && std::ranges::all_of(places, [&](Vec2 p) {
                    return p.x > frame[1].x && p.y > frame[0].y && p.y < frame[1].y;
                }))
                pairs.push_back(places);
        return std::pair(pairs, curve_in(svg));
    };
    for (const double damage : {0.46, 0.55, 0.9}) {
        const auto [pairs, curve] = middles(0.45, damage);
        ASSERT_FALSE(pairs.empty()) << damage;
        for (const std::vector<Vec2>& pair : pairs) {
            EXPECT_TRUE(std::abs(pair[0].x - pair[1].x) > 10.0 || std::abs(pair[0].y - pair[1].y) > 6.0) << damage;
            for (const Vec2 letter : pair)
                for (std::size_t k = 0; k + 1 < curve.size(); ++k)
                    EXPECT_GT(distance_from(letter, curve[k], curve[k + 1]), 0.4) << damage;
        }
    }
}

TEST_F(PlotCommand, OneTestHasItsTitleSeveralTheirNamesAboveSpecimens) {
    const auto glyphs = [&](const std::string& words) {
        pugi::xml_document document;
        EXPECT_TRUE(document.load_string(drawn(words, "figure.svg").c_str()));
        return static_cast<int>(document.select_nodes("//*[local-name()='use']").size());
    };
    const int named = glyphs("squeezed --what specimen --labels abc");
    EXPECT_EQ(glyphs("squeezed --what specimen") - named, 11 - 3) << "Sample test";
    EXPECT_EQ(glyphs("squeezed pulled --what specimen --labels abc defgh") -
                  glyphs("squeezed pulled --what specimen --labels a d"),
              2 + 4);
}

TEST_F(PlotCommand, TheSameResultsGiveTheSameBytes) {
    for (const char* file : {"figure.svg", "figure.pdf", "figure.png"}) {
        const std::string first = drawn("pulled squeezed --labels one two --title Both", file);
        EXPECT_TRUE(first == drawn("pulled squeezed --labels one two --title Both", file)) << file;
    }
}

TEST_F(PlotCommand, APngIsWhiteUpToItsLastPixels) {
    // At these widths the figure is not a whole number of pixels wide.
    for (const char* words : {"--width 85", "--width 85.02", "--width 60 --dpi 97"}) {
        const auto rows = png_rows(drawn(fmt::format("pulled --what curve {}", words), "figure.png"));
        int right = 255, below = 255;
        for (const auto& row : rows) {
            for (std::size_t k = row.size() - 3; k < row.size(); ++k) right = std::min<int>(right, row[k]);
        }
        for (const unsigned char value : rows.back()) below = std::min<int>(below, value);
        fmt::print("  {}: darkest value at the right edge {}, at the lower edge {}\n", words, right, below);
        EXPECT_EQ(right, 255) << words;
        EXPECT_EQ(below, 255) << words;
    }
}

TEST_F(PlotCommand, AnAxisOfCountsHasATickBesideThatAtZero) {
    for (const int most : {1, 2, 3, 4, 9, 11, 43, 46, 430}) {
        // Enough broken bonds in total that a single round interval would be too large for the axis.
        for (const char* folder : {"pulled", "squeezed"}) {
            std::istringstream lines(read(std::string(folder) + "/curve.csv"));
            std::string line, table;
            std::getline(lines, line);
            const auto before = static_cast<std::size_t>(
                std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(line.find("bonds_broken")), ','));
            table = line + "\n";
            for (std::size_t row = 0; std::getline(lines, line); ++row) {
                std::size_t at = 0;
                for (std::size_t k = 0; k < before; ++k) at = line.find(',', at) + 1;
                line.replace(at, line.find(',', at) - at, row == 0 ? "0" : std::to_string(most));
                table += line + "\n";
            }
            write(std::string(folder) + "/curve.csv", table);
        }
        const std::string svg = drawn("pulled squeezed --what curve", "figure.svg");
        const auto frames = frames_of(svg);
        ASSERT_EQ(frames.size(), 2U);
        const int got = ticks_of(svg, frames[1]);
        fmt::print("  {} broken: {} ticks\n", most, got);
        EXPECT_GE(got, 2) << most;
    }
}

TEST_F(PlotCommand, ACurveThatWouldBeASliverHasAnInset) {
    EXPECT_EQ(frames_of(drawn("pulled squeezed --what curve", "figure.svg")).size(), 2U);
    SampleTest weak;
    weak.kind = "tension";
    weak.peak_strain = 1e-4;
    write_sample_results(folder_ / "weak", weak);
    for (const char* width : {"85", "180"}) {
        const std::string svg = drawn(fmt::format("weak squeezed --what curve --width {}", width), "figure.svg");
        const auto frames = frames_of(svg);
        ASSERT_EQ(frames.size(), 3U) << "curves, inset, breaks";
        const std::vector<Vec2>*main = &frames[0], *inset = &frames[1];
        if ((*main)[2].x - (*main)[0].x < (*inset)[2].x - (*inset)[0].x) std::swap(main, inset);
        double highest = (*inset)[1].y;
        int inside = 0;
        for (const std::vector<Vec2>& line : lines_of(svg)) {
            if (line.size() < 30) continue;  // a curve, not a mark
            const bool of_inset = line.front().x > (*inset)[0].x - 1.0 && line.front().y < (*inset)[1].y + 1.0 &&
                                  line.front().y > (*inset)[0].y;
            for (const Vec2 point : line) {
                if (point.x < (*inset)[0].x || point.x > (*inset)[2].x || point.y < (*inset)[0].y ||
                    point.y > (*inset)[1].y)
                    continue;
                if (of_inset) highest = std::min(highest, point.y);
                inside += of_inset ? 0 : 1;
            }
        }
        const double share = ((*inset)[1].y - highest) / ((*inset)[1].y - (*inset)[0].y);
        fmt::print("  {} mm: the curve has {:.2f} of the inset's height; {} points of others lie in it\n", width, share,
                   inside);
        EXPECT_GT(share, 0.85) << "the weak curve should fill its inset";
        EXPECT_EQ(inside, 0) << "the inset should hide no curve";
    }
}

TEST_F(PlotCommand, AMeasuredCurveIsDrawnOverTheTestsOnTheirScale) {
    const std::string alone = drawn("squeezed --what curve", "figure.svg");
    write_text(folder_ / "lab.csv", "axial_strain (%),axial_stress (kPa)\n0,0\n0.05,2.5\n0.1,5\n0.4,4\n");
    const std::string both = drawn("squeezed --what curve --measured lab.csv", "figure.svg");
    const auto dashed = [](const std::string& svg) { return svg.find("stroke-dasharray") != std::string::npos; };
    EXPECT_FALSE(dashed(alone));
    EXPECT_TRUE(dashed(both));
    const auto width = [](const std::string& svg) {
        const std::vector<Vec2> curve = curve_in(svg);
        return curve.back().x - curve.front().x;
    };
    EXPECT_LT(width(both), 0.8 * width(alone)) << "the axis should reach the measured strain of 0.004";
    write_text(folder_ / "lab.csv", "axial_strain,axial_stress\n0,0\n0.001,5e9\n");
    expect_refused("squeezed -o figure.svg --force --what curve --measured lab.csv", "state the unit in the heading");
    write_text(folder_ / "lab.csv", "axial_strain,axial_stress\n0,0\n0.001,5e3\n");
    expect_refused("squeezed pulled -o figure.svg --force --what curve --measured lab.csv",
                   "kinds compression and tension");
}

TEST_F(PlotCommand, FragmentsAreDrawnWholeOrLeftOut) {
    ASSERT_EQ(
        std::system(fmt::format("cd '{}' && '{}' test '{}/specimens/guide_rock/voronoi_compression.toml' -o burst -q",
                                folder_.string(), CRACKLE_PROGRAM, CRACKLE_SOURCE_DIR)
                        .c_str()),
        0);
    const std::string svg = drawn("burst --what specimen --at end", "figure.svg");
    const int shown = shapes_filled(svg, grain);
    // Cairo clips what extends beyond the area of a drawing: the platens, but no particle.
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg.c_str()));
    int clipped = 0, cut = 0;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='g'][@clip-path]")) {
        ++clipped;
        for (const pugi::xpath_node& inner : node.node().select_nodes(".//*[local-name()='path']"))
            cut +=
                std::string(inner.node().attribute("style").value()).find("fill:rgb(89") != std::string::npos ? 1 : 0;
    }
    fmt::print("  {} of 304 particles shown, {} of them cut at the frame; {} shapes clipped\n", shown, cut, clipped);
    EXPECT_EQ(clipped, 2) << "platens";
    EXPECT_EQ(cut, 0);
    EXPECT_GT(shown, 180);
    EXPECT_LT(shown, 304) << "this test needs fragments that fly off";
}

TEST_F(PlotCommand, TheNearestFrameIsDrawn) {
    // There are frames at strain 0, the peak (1e-3) and the end (1.5e-3).
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

TEST_F(PlotCommand, LettersOfTheGuidesFirstFigureAreTheGuides) {
    for (const auto& folder : write_six_sample_results(folder_ / "six")) {
        std::string name = folder.filename().string();
        name[name.find('-')] = '_';
        fs::rename(folder, folder.parent_path() / name);
    }
    ASSERT_EQ(call("--guide six -o figures --format svg").code, 0);
    const std::string svg = read("figures/figure26.svg");
    const std::vector<Vec2> letters = letters_of(svg);
    ASSERT_EQ(letters.size(), 4U) << "(a) packing, (b) what is left, (c) curve, (d) breaks";
    EXPECT_EQ(letters[0].y, letters[1].y) << "drawings in one row";
    EXPECT_GT(letters[1].x, letters[0].x + 50.0);
    // The first frame is that of the curve, the last that of the breaks.
    const std::vector<std::vector<Vec2>> frames = frames_of(svg);
    ASSERT_GE(frames.size(), 3U);
    fmt::print("  (c) at {:.1f} pt, its frame from {:.1f}; (d) at {:.1f}, its frame from {:.1f}\n", letters[2].y,
               frames.front()[0].y, letters[3].y, frames.back()[0].y);
    EXPECT_NEAR(letters[2].y, frames.front()[0].y, 12.0);
    EXPECT_NEAR(letters[3].y, frames.back()[0].y, 24.0);
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
    expect_refused("pulled -o figure.pdf", "figure.pdf: found an existing file, expected a new file");
    expect_refused("", "found no folder of results");
    expect_refused("pulled", "found no -o");
    expect_refused("pulled -o figure.eps", "found 'eps', expected svg, pdf or png");
    expect_refused("pulled -o figure", "found '', expected svg, pdf or png");
    expect_refused("nowhere --force -o figure.pdf", "nowhere: found no such folder");
    expect_refused("pulled --force -o figure.pdf --what cracks",
                   "--what: found 'cracks', expected curve, ae, emission, strain, specimen, forces or all");
    expect_refused("pulled --force -o figure.pdf --at 0.5",
                   "--at: found 0.5, expected 0 to 0.0015, the last strain of pulled");
    expect_refused("pulled --force -o figure.pdf --at soon",
                   "--at: found 'soon', expected a strain, start, peak or end");
    expect_refused("pulled --force -o figure.pdf --width 3", "--width: found 3, expected 30 to 1000 mm");
    expect_refused("pulled --force -o figure.pdf --columns 3", "--columns: found 3, expected 1 or 2");
    expect_refused("pulled --force -o figure.pdf --font-size 0", "--font-size: found 0");
    expect_refused("pulled --force -o figure.pdf --dpi 1e9", "--dpi: found");
    expect_refused("pulled squeezed --force -o figure.pdf --labels one", "--labels: found 1 name, expected 2");
    expect_refused("pulled -o no/such/figure.pdf", "cannot be written");
}

}  // namespace
}  // namespace crackle
