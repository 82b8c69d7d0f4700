// SPDX-License-Identifier: GPL-3.0-or-later
// Tests several minerals: how a case defines them, which grain gets which, and contacts between two of them.

#include "specimens/making/minerals.hpp"

#include <cairo.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/making/lattices.hpp"
#include "specimens/making/make_specimen.hpp"
#include "specimens/making/materials.hpp"
#include "specimens/recordings/recording.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::odd_stiffness;
using testing::ScratchFolder;
using testing::SmallCase;
using testing::within;
using testing::write_small_case;

constexpr const char* three_minerals =
    "[[mineral]]\nname = \"quartz\"\narea_share = 0.3\ncolour = \"#ff0000\"\nnormal_stiffness = 2e7\n"
    "[[mineral]]\nname = \"feldspar\"\ncolour = \"#00FF00\"\n"
    "[[mineral]]\nname = \"mica\"\narea_share = 0.1\ncolour = \"#0000ff\"\nfriction_angle = 10\ndensity = 2800\n";

class MineralRock : public ::testing::Test {
  protected:
    /// Writes a case of discs, or of their cells, with additional text at its end. @return its path
    std::filesystem::path write(const std::string& minerals, const std::string& mesh = "") const {
        SmallCase wanted;
        wanted.mesh = mesh;
        const auto path = write_small_case(scratch_ / "", wanted);
        std::ofstream(path, std::ios::app) << minerals;
        return path;
    }
    Specimen specimen(const std::string& minerals, const std::string& mesh = "") const {
        return make_specimen(read_case(write(minerals, mesh)), {});
    }
    std::string refusal(const std::string& minerals) const {
        const auto path = write(minerals);
        return testing::refusal([&] { make_specimen(read_case(path), {}); });
    }

    ScratchFolder scratch_;
};

std::vector<int> materials_of(const Specimen& specimen) {
    std::vector<int> all;
    for (const Body& body : specimen.scene.bodies) all.push_back(body.material);
    return all;
}

double area_of(const Specimen& specimen, const Body& body) {
    return mass_properties(specimen.scene, body).mass /
           specimen.scene.materials[static_cast<std::size_t>(body.material)].density;
}

/// Fraction of the area of each mineral, computed again, and that of the largest grain.
std::pair<std::vector<double>, double> counted_shares(const Specimen& specimen) {
    std::vector<double> shares(specimen.minerals.size(), 0.0);
    double all = 0.0, largest = 0.0;
    for (const Body& body : specimen.scene.bodies) {
        const double area = area_of(specimen, body);
        shares[static_cast<std::size_t>(body.material)] += area;
        all += area;
        largest = std::max(largest, area);
    }
    for (double& share : shares) share /= all;
    return {shares, largest / all};
}

TEST_F(MineralRock, HasWhatItsTableGivesAndTheRestOfMaterial) {
    const ResolvedCase test = read_case(write(three_minerals));
    const std::vector<parts::Mineral>& list = test.minerals.list;
    ASSERT_EQ(list.size(), 3u);
    EXPECT_EQ(list[1].name, "feldspar");
    EXPECT_TRUE(std::holds_alternative<parts::RandomGrains>(test.minerals.assign));
    EXPECT_EQ(list[0].material.normal_stiffness, 2e7);
    EXPECT_EQ(list[0].material.damping_ratio, 0.2) << "[material]'s";
    EXPECT_FALSE(list[1].material.normal_stiffness.has_value()) << "the file's";
    const Specimen rock = make_specimen(test, {});
    const auto& materials = rock.scene.materials;
    ASSERT_EQ(materials.size(), 4u) << "the last one is that of the platens";
    EXPECT_EQ(materials[0].normal_stiffness, 2e7);
    EXPECT_EQ(materials[0].shear_stiffness, 2.5e6);
    EXPECT_EQ(materials[1], materials[3]);
    EXPECT_EQ(materials[2].friction_angle, 10.0);
    EXPECT_EQ(materials[2].density, 2800.0);
    EXPECT_EQ(rock.platen_material, 3);
    EXPECT_EQ(materials[3].normal_stiffness, 1e7);
}

TEST_F(MineralRock, PlatensAreOfMaterialWhateverGrainsLieAtThem) {
    const VirtualTest test = prepare_test(read_case(write(three_minerals)));
    EXPECT_EQ(test.world.bodies.info(test.setup.apparatus.top).material, 3);
    EXPECT_EQ(test.world.bodies.info(test.setup.apparatus.bottom).material, 3);
}

TEST_F(MineralRock, EveryNumberOfMaterialIsAKeyOfAMineral) {
    int found = 0;
    for (const Parameter& p : case_parameters()) {
        if (p.table != "material" || p.kind != ValueKind::real) continue;
        const auto& all = case_parameters();
        const auto own = std::find_if(all.begin(), all.end(),
                                      [&](const Parameter& q) { return q.table == "mineral" && q.key == p.key; });
        ASSERT_NE(own, all.end()) << p.key;
        TestCase test;
        test.mineral.resize(2);
        own->set(test, CaseValue(0.25), 1);
        EXPECT_EQ(own->get(test, 1), CaseValue(0.25)) << p.key;
        EXPECT_EQ(own->get(test, 0), std::nullopt) << p.key << " of another mineral";
        EXPECT_EQ(p.get(test, 0), std::nullopt) << p.key << " of [material]";
        ++found;
    }
    EXPECT_GE(found, 7);
}

TEST_F(MineralRock, ResolvedCaseReadsBackToTheSameResolvedCase) {
    const ResolvedCase test = read_case(
        write("[minerals]\nassign = \"size\"\n" + std::string(three_minerals) +
              "[[mineral_pair]]\nbetween = [\"mica\", \"quartz\"]\nshear_stiffness = 1e6\nfriction_angle = 0\n"));
    std::ostringstream once, twice;
    write_resolved_case(once, test, scratch_ / "");
    std::ofstream(scratch_ / "resolved.toml") << once.str();
    write_resolved_case(twice, read_case(scratch_ / "resolved.toml"), scratch_ / "");
    EXPECT_EQ(once.str(), twice.str());
    EXPECT_NE(once.str().find("between = ['mica', 'quartz']"), std::string::npos) << once.str();
    EXPECT_NE(once.str().find("[[mineral]]"), std::string::npos);
}

TEST_F(MineralRock, OwnListStandsInPlaceOfTheIncludedFiles) {
    write(three_minerals);
    std::ofstream(scratch_ / "own.toml") << "include = \"case.toml\"\n[[mineral]]\nname = \"olivine\"\n";
    const ResolvedCase test = read_case(scratch_ / "own.toml");
    ASSERT_EQ(test.minerals.list.size(), 1u);
    EXPECT_EQ(test.minerals.list[0].name, "olivine");
    EXPECT_FALSE(test.minerals.list[0].asked.has_value()) << "quartz's, which stood at this place";
}

TEST_F(MineralRock, DrawnSharesMissByNoMoreThanAGrain) {
    for (const char* mesh : {"", "voronoi"}) {
        for (int seed = 0; seed < 20; ++seed) {
            const Specimen rock = specimen(fmt::format("[minerals]\nseed = {}\n", seed) + three_minerals, mesh);
            const auto [shares, grain] = counted_shares(rock);
            const double asked[] = {0.3, 0.6, 0.1};
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_LE(std::abs(shares[k] - asked[k]), grain) << mesh << seed;
                EXPECT_NEAR(*rock.minerals[k].asked, asked[k], 1e-15);
                EXPECT_NEAR(rock.minerals[k].reached, shares[k], 1e-12);
                EXPECT_EQ(rock.minerals[k].grains, std::ranges::count(materials_of(rock), static_cast<int>(k)));
            }
        }
    }
}

TEST_F(MineralRock, SameSeedGivesTheSameGrainsInAnyOrderOfTheFile) {
    const auto of_seed = [&](int seed) {
        const Specimen rock = specimen(fmt::format("[minerals]\nseed = {}\n", seed) + three_minerals);
        std::map<int, int> minerals;
        for (const Body& body : rock.scene.bodies) minerals[body.id] = body.material;
        return minerals;
    };
    const auto first = of_seed(1);
    EXPECT_EQ(of_seed(1), first);
    std::set<std::map<int, int>> all;
    for (int seed = 0; seed < 8; ++seed) all.insert(of_seed(seed));
    EXPECT_EQ(all.size(), 8u) << "each seed its own";
    const ResolvedCase test = read_case(write(std::string("[minerals]\nseed = 1\n") + three_minerals));
    Scene scene = testing::small_rock_scene();
    for (CircleElement& circle : scene.circles) circle.radius = testing::rock_radius;
    scene.materials.resize(4, scene.materials[0]);
    std::reverse(scene.bodies.begin(), scene.bodies.end());
    std::vector<std::string> notices;
    assign_minerals(scene, test.minerals, test.places, notices);
    for (const Body& body : scene.bodies) EXPECT_EQ(body.material, first.at(body.id)) << body.id;
    EXPECT_TRUE(notices.empty());
}

TEST_F(MineralRock, NoMineralIsDrawnForPlaceOrSize) {
    // Two minerals of equal area in 1,000 cells. Over 400 seeds, the fraction of mineral 0 in the left half, and among
    // the larger half of the grains, is 0.5 on average. Its standard deviation is 0.5/sqrt(1000) = 0.016 for one seed
    // and 0.0008 for the mean.
    Scene scene = square_lattice(40, 25, 0.01, 1e-5, undamped_rock(1e7, 27.0));
    scene.materials.resize(3, scene.materials[0]);
    for (std::size_t k = 0; k < scene.circles.size(); ++k)
        scene.circles[k].radius = 0.01 * (1.0 + 0.5 * static_cast<double>(k % 7) / 7.0);
    parts::Minerals minerals;
    minerals.list = {{"a", {}, 0.5, 0.5}, {"b", {}, 0.5, 0.5}};
    double left = 0.0, large = 0.0, large_all = 0.0;
    for (int seed = 0; seed < 400; ++seed) {
        minerals.assign = parts::RandomGrains{seed};
        std::vector<std::string> notices;
        assign_minerals(scene, minerals, {}, notices);
        for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
            const bool first = scene.bodies[b].material == 0;
            if (b % 40 < 20) left += first ? 1.0 : 0.0;
            if (b % 7 < 3) continue;
            large_all += 1.0;
            large += first ? 1.0 : 0.0;
        }
    }
    EXPECT_TRUE(within("share in the left half", left / (400.0 * 500.0), 0.5, 4 * 0.0011));
    EXPECT_TRUE(within("share among the larger", large / large_all, 0.5, 4 * 0.0011));
}

TEST_F(MineralRock, BySizeTheLargestGrainsHaveTheMineralListedFirst) {
    const Specimen rock = specimen(std::string("[minerals]\nassign = \"size\"\n") + three_minerals, "voronoi");
    double least[] = {1e9, 1e9, 1e9}, most[] = {0.0, 0.0, 0.0};
    for (const Body& body : rock.scene.bodies) {
        const double area = area_of(rock, body);
        least[body.material] = std::min(least[body.material], area);
        most[body.material] = std::max(most[body.material], area);
    }
    EXPECT_GE(least[0], most[1]);
    EXPECT_GE(least[1], most[2]);
    const auto [shares, grain] = counted_shares(rock);
    EXPECT_LE(std::abs(shares[0] - 0.3), 0.5 * grain);
    EXPECT_LE(std::abs(shares[2] - 0.1), 0.5 * grain);
}

TEST_F(MineralRock, LabelsByNameOrNumberInTheOrderOfTheFile) {
    {
        std::ofstream labels(scratch_ / "labels.txt");
        labels << "# grains of the section\n\n";
        for (int k = 0; k < 77; ++k) labels << (k % 3 == 0 ? "  mica\r\n" : k % 3 == 1 ? "1\n" : "feldspar \n");
    }
    const std::string minerals = std::string("[minerals]\nassign = \"labels\"\nlabels = \"labels.txt\"\n");
    const Specimen rock = specimen(minerals + three_minerals);
    for (std::size_t b = 0; b < 77; ++b) EXPECT_EQ(rock.scene.bodies[b].material, (std::array{2, 0, 1})[b % 3]) << b;
    EXPECT_EQ(rock.minerals[1].asked, std::nullopt);
    EXPECT_NE(std::ranges::find_if(rock.notices, [](const std::string& n) { return n.find("mica has 0.33") == 0; }),
              rock.notices.end())
        << "asked for 0.1";
    std::ofstream(scratch_ / "labels.txt", std::ios::app) << "mica\n";
    EXPECT_NE(refusal(minerals + three_minerals).find(":18: minerals.labels: found 78 labels"), std::string::npos);
    std::ofstream(scratch_ / "labels.txt") << "quartz\nfelspar\n";
    EXPECT_NE(refusal(minerals + three_minerals).find("labels.txt:2: label: found \"felspar\", expected a mineral"),
              std::string::npos);
    std::ofstream(scratch_ / "labels.txt") << "4\n";
    EXPECT_NE(refusal(minerals + three_minerals).find("labels.txt:1: label: found \"4\""), std::string::npos);
    std::ofstream(scratch_ / "labels.txt") << std::string(100'000, 'x');
    EXPECT_LT(refusal(minerals + three_minerals).size(), 400u);
    std::ofstream(scratch_ / "labels.txt") << "\xef\xbb\xbfquartz\n";
    EXPECT_NE(refusal(minerals + three_minerals).find("found 1 labels"), std::string::npos) << "a byte order mark";
    std::filesystem::remove(scratch_ / "labels.txt");
    EXPECT_NE(refusal(minerals + three_minerals).find("minerals.labels: found no file"), std::string::npos);
    std::ofstream(scratch_ / "labels.txt") << "1 quartz\n";
    std::filesystem::resize_file(scratch_ / "labels.txt", most_bytes_of_table + 1);
    EXPECT_NE(refusal(minerals + three_minerals).find("labels.txt: found more than 1073741824 bytes"),
              std::string::npos);
    std::filesystem::remove(scratch_ / "labels.txt");
    std::filesystem::create_directory(scratch_ / "labels.txt");
    EXPECT_NE(refusal(minerals + three_minerals).find("labels.txt: found a folder, expected a file"),
              std::string::npos);
}

/// Writes an image with pixel colours 0xaarrggbb, row by row from the top.
void write_png(const std::filesystem::path& file, int width, const std::vector<std::uint32_t>& pixels,
               cairo_format_t format = CAIRO_FORMAT_ARGB32) {
    const int height = static_cast<int>(pixels.size()) / width;
    cairo_surface_t* surface = cairo_image_surface_create(format, width, height);
    cairo_surface_flush(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int row = 0; row < height; ++row) {
        auto* to = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(surface) + row * stride);
        for (int column = 0; column < width; ++column)
            to[column] = pixels[static_cast<std::size_t>(row * width + column)];
    }
    cairo_surface_mark_dirty(surface);
    ASSERT_EQ(cairo_surface_write_to_png(surface, file.string().c_str()), CAIRO_STATUS_SUCCESS);
    cairo_surface_destroy(surface);
}

constexpr std::uint32_t red = 0xffff0000, green = 0xff00ff00, blue = 0xff0000ff;

TEST_F(MineralRock, ImageLiesOverTheBoxWithItsTopRowAtTheTop) {
    const std::string minerals = std::string("[minerals]\nassign = \"image\"\nimage = \"section.png\"\n");
    for (const cairo_format_t format : {CAIRO_FORMAT_ARGB32, CAIRO_FORMAT_RGB24}) {
        write_png(scratch_ / "section.png", 2, {red, green, blue, blue}, format);
        for (const char* mesh : {"", "voronoi"}) {
            const Specimen rock = specimen(minerals + three_minerals, mesh);
            const Domain& box = rock.scene.domain;
            for (const Body& body : rock.scene.bodies) {
                const Vec2 at = mass_properties(rock.scene, body).centroid;
                const bool left = at.x < 0.5 * (box.x1 + box.x2), low = at.y < 0.5 * (box.y1 + box.y2);
                if (std::abs(at.x - 0.5 * (box.x1 + box.x2)) < 1e-3) continue;
                EXPECT_EQ(body.material, low ? 2 : left ? 0 : 1) << body.id;
            }
            EXPECT_NE(
                std::ranges::find_if(rock.notices, [](const auto& n) { return n.find("is stretched") < n.size(); }),
                rock.notices.end());
        }
    }
}

TEST_F(MineralRock, GrainHasTheColourOfMostOfItsPixels) {
    // A fine pattern in which one of four pixels is red, so that most of each disc is green wherever its centre is.
    std::vector<std::uint32_t> pixels;
    for (int row = 0; row < 240; ++row)
        for (int column = 0; column < 120; ++column) pixels.push_back(row % 2 + column % 2 == 0 ? red : green);
    write_png(scratch_ / "section.png", 120, pixels);
    for (const char* mesh : {"", "voronoi"}) {
        const Specimen rock =
            specimen(std::string("[minerals]\nassign = \"image\"\nimage = \"section.png\"\n") + three_minerals, mesh);
        EXPECT_EQ(rock.minerals[1].grains, 77) << mesh;
    }
}

TEST_F(MineralRock, ImagesThatDoNotFitAreRefused) {
    const std::string minerals =
        std::string("[minerals]\nassign = \"image\"\nimage = \"section.png\"\n") + three_minerals;
    EXPECT_NE(refusal(minerals).find(":18: minerals.image: found no file"), std::string::npos);
    std::ofstream(scratch_ / "section.png") << "GIF89a";
    EXPECT_NE(refusal(minerals).find("cannot be read as PNG"), std::string::npos);
    // Decompressed, the image would take 1.6 GB.
    std::ofstream(scratch_ / "section.png", std::ios::binary)
        << std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x4e\x20\0\0\x4e\x20", 24);
    EXPECT_NE(refusal(minerals).find("with 400000000 pixels, expected at most 100000000"), std::string::npos);
    write_png(scratch_ / "section.png", 2, {red, green, blue, 0xff0000fe});
    const std::string colour = refusal(minerals);
    EXPECT_NE(colour.find("section.png: pixel 2 of row 2: found #0000fe, expected a colour of a mineral"),
              std::string::npos);
    EXPECT_NE(colour.find("#00ff00 (feldspar)"), std::string::npos);
    write_png(scratch_ / "section.png", 2, {red, green, blue, 0x7f00007f});
    EXPECT_NE(refusal(minerals).find("found a transparent pixel"), std::string::npos);
}

/// An image of 4 x 3 red pixels with one flaw; the bytes after the name IHDR.
struct FlawedImage {
    std::string bytes;
    const char* flaw;
};

std::vector<FlawedImage> flawed_images() {
    // Octal escapes, because letters after a hexadecimal escape could belong to it.
    const auto text = []<std::size_t N>(const char(&bytes)[N]) { return std::string(bytes, N - 1); };
    return {
        {text("\000\000\000\004\000\000\000\003\010\002\000\000\000\073\226\071\221\000\000\000\000\111\105\116\104\256"
              "\102\140\202"),
         "no IDAT chunk and therefore no pixels"},
        {text("\000\000\000\004\000\000\000\003\010\002\000\000\000\073\226\071\221\000\000\000\025\111\104\101\124\147"
              "\141\162\142\141\147\145\147\141\162\142\141\147\145\147\141\162\142\141\147\145\177\366\030\341\000\000"
              "\000\000\111\105\116\104\256\102\140\202"),
         "IDAT chunks that cannot be decompressed"},
        {text("\000\000\000\004\000\000\000\003\010\002\000\000\000\073\226\071\221\000\000\000\015\111\104\101\124\170"
              "\234\143\370\317\300\000\101\000\021\370\002\376\343\345\357\266\000\000\000\000\111\105\116\104\256\102"
              "\140\202"),
         "pixels for only 0 of 3 rows"},
        {text("\000\000\000\000\000\000\000\003\010\002\000\000\000\062\175\231\353\000\000\000\020\111\104\101\124\170"
              "\234\143\370\317\300\000\107\014\070\071\000\365\061\013\365\065\173\373\202\000\000\000\000\111\105\116"
              "\104\256\102\140\202"),
         "0 x 3 pixels, outside of 1 to 32767 each"},
        {text("\000\000\234\100\000\000\000\001\010\002\000\000\000\062\002\134\323\000\000\000\020\111\104\101\124\170"
              "\234\143\370\317\300\000\107\014\070\071\000\365\061\013\365\065\173\373\202\000\000\000\000\111\105\116"
              "\104\256\102\140\202"),
         "40000 x 1 pixels, outside of 1 to 32767 each"},
        {text("\000\000\000\004\000\000\000\003\007\002\000\000\000\271\306\256\100\000\000\000\020\111\104\101\124\170"
              "\234\143\370\317\300\000\107\014\070\071\000\365\061\013\365\065\173\373\202\000\000\000\000\111\105\116"
              "\104\256\102\140\202"),
         "7 bits per channel and colour type 2"},
        {text("\000\000\000\004\000\000\000\003\010\003\000\000\000\203\052\136\364\000\000\000\020\111\104\101\124\170"
              "\234\143\370\317\300\000\107\014\070\071\000\365\061\013\365\065\173\373\202\000\000\000\000\111\105\116"
              "\104\256\102\140\202"),
         "palette colours without a PLTE chunk"},
        {text("\000\000\000\004\000\000\000\003\010\002\000\100\000\313\357\166\224\000\000\000\020\111\104\101"
              "\124\170\234\143\370\317\300\000\107\014\070\071\000\365\061\013\365\065\173\373\202\000\000\000"
              "\000\111\105\116\104\256\102\140\202"),
         "a method of compression, filtering or interlacing that PNG does not define"},
        {text("\000\000\000\004\000\000\000\003\004\002\000\000\000\376\146\324\220\000\000\000\020\111\104\101"
              "\124\170\234\143\370\317\300\000\107\014\070\071\000\365\061\013\365\065\173\373\202\000\000\000"
              "\000\111\105\116\104\256\102\140\202"),
         "4 bits per channel and colour type 2"},
        {text("\000\000\000\004\000\000\000\003\010\002\000\000\000\073\226\071\221\000\000\000\000\101\102\103"
              "\104\333\027\040\245\000\000\000\020\111\104\101\124\170\234\143\370\317\300\000\107\014\070\071"
              "\000\365\061\013\365\065\173\373\202\000\000\000\000\111\105\116\104\256\102\140\202"),
         "a defect in one of its chunks"},
    };
}

TEST_F(MineralRock, ImagesThatAreMalformedAreToldWhy) {
    const std::string minerals =
        std::string("[minerals]\nassign = \"image\"\nimage = \"section.png\"\n") + three_minerals;
    const auto refusal_of = [&](const std::string& bytes) {
        std::ofstream(scratch_ / "section.png", std::ios::binary) << bytes;
        return refusal(minerals);
    };
    const std::string head("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
    for (const FlawedImage& image : flawed_images())
        EXPECT_NE(refusal_of(head + image.bytes).find(std::string("because it has ") + image.flaw), std::string::npos)
            << refusal_of(head + image.bytes);
    write_png(scratch_ / "section.png", 2, {red, green, blue, blue});
    const std::string whole = read_file(scratch_ / "section.png");
    EXPECT_NE(refusal_of(whole.substr(0, whole.size() - 8)).find("an end at byte"), std::string::npos);
    EXPECT_NE(refusal_of("GIF89a").find("because it has other data"), std::string::npos);
    std::string changed = whole;
    changed[whole.find("IDAT") + 6] ^= 1;
    EXPECT_NE(refusal_of(changed).find("a wrong checksum in the IDAT chunk at byte"), std::string::npos)
        << refusal_of(changed);
    changed = whole;
    changed[8] = 1;
    EXPECT_NE(refusal_of(changed).find("a chunk of 16777229 bytes at byte 8 that extends beyond the end"),
              std::string::npos);
    EXPECT_EQ(refusal_of(changed).find("memory"), std::string::npos);
}

TEST_F(MineralRock, FileWithMaterialsOfItsOwnIsRefused) {
    const auto path = write(three_minerals);
    Scene scene = testing::small_rock_scene();
    scene.materials.push_back(scene.materials[0]);
    std::ofstream out(scratch_ / "rock.dat");
    write_geometry(out, scene);
    out.close();
    EXPECT_NE(
        testing::refusal([&] { make_specimen(read_case(path), {}); }).find("found a particle file with 2 materials"),
        std::string::npos);
}

TEST_F(MineralRock, TwoMineralsOfEqualPropertiesGiveTheBytesOfOne) {
    constexpr double stiffness = odd_stiffness;
    volatile double k = stiffness;
    ASSERT_NE(2.0 * k * k / (k + k), k) << "springs in series differ from a single one in the last bit";
    for (const char* mesh : {"", "voronoi"}) {
        std::vector<std::string> curves, events;
        for (const bool minerals : {false, true}) {
            const auto path = write("", mesh);
            std::string text = read_file(path);
            text.insert(text.find("damping_ratio"), fmt::format("normal_stiffness = {}\n", stiffness));
            if (minerals)
                text += fmt::format(
                    "[[mineral]]\nname = \"a\"\narea_share = 0.4\n[[mineral]]\nname = \"b\"\n"
                    "normal_stiffness = {}\nshear_stiffness = 2.5e6\nfriction_angle = 27\n",
                    stiffness);
            std::ofstream(path) << text;
            TestOptions options;
            options.folder = scratch_ / fmt::format("{}{}", mesh, minerals);
            const TestOutcome outcome = run_test(read_case(path), options);
            curves.push_back(read_file(outcome.folder / "curve.csv"));
            events.push_back(read_file(outcome.folder / "events.csv"));
            EXPECT_EQ(outcome.summary.minerals.has_value(), minerals);
        }
        EXPECT_GT(std::ranges::count(events[0], '\n'), 5) << "breaks";
        EXPECT_EQ(curves[0], curves[1]) << mesh;
        EXPECT_EQ(events[0], events[1]) << mesh;
    }
}

TEST_F(MineralRock, FramesAndSummaryTellTheMinerals) {
    TestOptions options;
    options.folder = scratch_ / "out";
    const ResolvedCase test = read_case(write(three_minerals, "voronoi"));
    const TestOutcome outcome = run_test(test, options);
    const Specimen rock = make_specimen(test, {});
    const Recording recording = read_test_recording(outcome.folder, 5);
    std::size_t compared = 0;
    for (const RecordedCell& cell : recording.cells) {
        if (cell.platen) continue;
        EXPECT_EQ(cell.material, rock.scene.bodies[static_cast<std::size_t>(cell.id - 1)].material + 1) << cell.id;
        ++compared;
    }
    EXPECT_EQ(compared, 77u);
    const std::vector<MineralFigures>& minerals = *outcome.summary.minerals;
    ASSERT_EQ(minerals.size(), 3u);
    EXPECT_EQ(minerals[0].name, "quartz");
    EXPECT_EQ(minerals[0].area_share, 0.3);
    EXPECT_EQ(minerals[2].grains, rock.minerals[2].grains);
    EXPECT_EQ(minerals[2].area_share_reached, rock.minerals[2].reached);
}

/// Discs on top of each other, so that columns are springs in series: `below` rows of quartz, the others of feldspar.
class LayeredColumn : public MineralRock {
  protected:
    static constexpr int columns = 4, rows = 9, below = 4;
    static constexpr double rock = 1e7, quartz = 3e7, feldspar = 0.7e7;  // N/m

    VirtualTest column(const std::string& pair) const {
        constexpr double radius = 0.02, overlap = 1e-4;
        Scene scene = square_lattice(columns, rows, radius, overlap, undamped_rock(rock, 27.0));
        const double reach = radius - overlap, spacing = 2.0 * radius - overlap;
        scene.domain = {
            -reach, reach + spacing * (columns - 1), -reach, reach + spacing * (rows - 1), {true, true, true, true}};
        scene.time_step = 1e-5;
        const auto path =
            write(fmt::format("[minerals]\nassign = \"labels\"\nlabels = \"labels.txt\"\n"
                              "[[mineral]]\nname = \"quartz\"\nnormal_stiffness = {}\n"
                              "[[mineral]]\nname = \"feldspar\"\nnormal_stiffness = {}\n{}",
                              quartz, feldspar, pair));
        std::ofstream file(scratch_ / "rock.dat"), labels(scratch_ / "labels.txt");
        write_geometry(file, scene);
        file.close();
        for (int k = 0; k < columns * rows; ++k) labels << (k < columns * below ? "quartz\n" : "feldspar\n");
        labels.close();
        return prepare_test(read_case(path));
    }
    /// Modulus of springs in series, for a given spring between the layers.
    static double series_modulus(const TestSetup& setup, double between) {
        const auto series = [](double a, double b) { return 2.0 / (1.0 / a + 1.0 / b); };
        const double compliance = 1.0 / series(rock, quartz) + (below - 1) / quartz + 1.0 / between +
                                  (rows - below - 1) / feldspar + 1.0 / series(feldspar, rock);
        return columns / compliance * setup.specimen.height / setup.specimen.width;
    }
};

TEST_F(LayeredColumn, IsAsStiffAsItsSpringsInSeries) {
    const VirtualTest test = column("");
    const double between = 2.0 * quartz * feldspar / (quartz + feldspar);
    EXPECT_TRUE(agrees("E of two layers", test.state.youngs_modulus, series_modulus(test.setup, between), 1e-9));
}

TEST_F(LayeredColumn, HasTheStiffnessThatThePairTableGivesBetweenTheLayers) {
    for (const char* names : {"\"quartz\", \"feldspar\"", "\"feldspar\", \"quartz\""}) {
        const VirtualTest test =
            column(fmt::format("[[mineral_pair]]\nbetween = [{}]\nnormal_stiffness = 2e6\n", names));
        EXPECT_TRUE(agrees("E of two layers", test.state.youngs_modulus, series_modulus(test.setup, 2e6), 1e-9));
    }
}

}  // namespace
}  // namespace crackle
