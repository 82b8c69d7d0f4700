// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle pack`: packs random circles in a box, compresses them to equilibrium and writes an in_gm.dat.

#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/demseg/geometry.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/packing/packing.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/printable.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::tools {
namespace {

template <typename T>
std::optional<T> optional_value(const po::variables_map& values, const char* name) {
    if (!values.contains(name)) return std::nullopt;
    return values[name].as<T>();
}

SizeDistribution sizes_of(const po::variables_map& values) {
    const auto low = optional_value<double>(values, "radius-min"), high = optional_value<double>(values, "radius-max");
    const auto median = optional_value<double>(values, "lognormal-median");
    const auto deviation = optional_value<double>(values, "lognormal-deviation");
    if (values.contains("sieve")) {
        if (low || high || median || deviation)
            throw InputError("--sieve: found together with other options for sizes, expected --sieve alone");
        return read_sieve_curve(values["sieve"].as<std::string>());
    }
    if (median || deviation) {
        if (!median || !deviation)
            throw InputError("--lognormal-median and --lognormal-deviation: found only one, expected both");
        return LognormalRadii{*median, *deviation, low.value_or(0.0), high.value_or(0.0)};
    }
    if (!low || !high)
        throw InputError(
            "sizes: found no option, expected --radius-min and --radius-max, the --lognormal options, or --sieve FILE");
    return UniformRadii{*low, *high};
}

void print_report(const PackingReport& r, const std::string& output) {
    print_text(fmt::format("circles          {}, radii {:.6g} to {:.6g} m\n", r.circles, r.radius_min, r.radius_max) +
               fmt::format("box              {:.9g} m x {:.9g} m\n", r.width, r.height) +
               fmt::format("void ratio       {:.6g}\n", r.void_ratio) +
               fmt::format("mean overlap     {:.6g} m (circles, bottom and top)\n", r.mean_overlap) +
               fmt::format("contacts         {} between circles; walls {} left, {} right, {} bottom, {} top\n",
                           r.circle_contacts, r.wall_contacts[0], r.wall_contacts[1], r.wall_contacts[2],
                           r.wall_contacts[3]) +
               fmt::format("coordination     {:.4g} of all circles, {:.4g} of those that carry load, walls included\n",
                           r.coordination, r.coordination_of_carrying) +
               fmt::format("floating         {} circles without contact\n", r.floating) +
               fmt::format("stress           x {:.6g}, y {:.6g} N/m; anisotropy {:.2g}\n", r.stress_x, r.stress_y,
                           r.anisotropy) +
               fmt::format("unbalanced       at most {:.2g} of the mean contact force, {:.6g} N\n", r.residual,
                           r.mean_contact_force));
    if (r.radius_scale != 1.0) print_out("radii            scaled by {:.6f} to fill the box\n", r.radius_scale);
    for (const std::string& notice : packing_notices(r)) print_out("notice           {}\n", notice);
    print_out("written          {}\n", output);
}

}  // namespace

PackingRequest packing_request(const po::variables_map& values, Messages& messages) {
    PackingRequest request;
    request.count = optional_value<std::int64_t>(values, "count");
    request.height_to_width = optional_value<double>(values, "height-to-width");
    request.width = optional_value<double>(values, "width");
    request.height = optional_value<double>(values, "height");
    request.sizes = sizes_of(values);
    request.mean_overlap = optional_value<double>(values, "mean-overlap");
    request.void_ratio = optional_value<double>(values, "void-ratio");
    const auto seed = values["seed"].as<std::int64_t>();
    if (seed < 0) throw InputError(fmt::format("--seed: found {}, expected a whole number >= 0", seed));
    request.seed = static_cast<std::uint64_t>(seed);
    request.threads = threads_of_machine(values["threads"].as<int>(), messages);
    request.material.density = values["density"].as<double>();
    request.material.normal_stiffness = values["normal-stiffness"].as<double>();
    request.material.shear_stiffness = values["shear-stiffness"].as<double>();
    request.material.friction_angle = values["friction-angle"].as<double>();
    return request;
}

CommandLine describe_pack() {
    const Material usual{2500.0, 1.0e7, 2.5e6, 0.0, 0.0, {}, 27.0};
    const auto number = [] { return po::value<double>()->value_name("X"); };
    po::options_description options, material;
    options.add_options()("count", po::value<std::int64_t>()->value_name("N"),
                          "number of circles, which determines the size of the box")                               //
        ("height-to-width", number(), "ratio of height to width of the box, with --count (default: 2)")            //
        ("width", number(), "width of the box, m; to obtain it exactly, the radii are scaled by at most 0.5 %")    //
        ("height", number(), "height of the box, m; obtained exactly, as for --width")                             //
        ("radius-min", number(), "smallest radius, m (uniform distribution, unless lognormal options are given)")  //
        ("radius-max", number(), "largest radius, m")                                                              //
        ("lognormal-median", number(), "median radius, m")                                                         //
        ("lognormal-deviation", number(), "standard deviation of ln(radius)")                                      //
        ("sieve", po::value<std::string>()->value_name("FILE"),
         "grading curve, a table with the columns size (diameter, m) and passing_by_mass")  //
        ("mean-overlap", number(),
         "target: mean overlap of circles with each other and with the bottom and top walls, m")              //
        ("void-ratio", number(), "target: (area of the box - area of the circles) / area of the circles")     //
        ("seed", po::value<std::int64_t>()->value_name("N")->default_value(1), "seed of the random numbers")  //
        ("threads", po::value<int>()->value_name("N")->default_value(1),
         "number of threads; does not affect the results")                                                       //
        ("output,o", po::value<std::string>()->value_name("FILE")->default_value("in_gm.dat"), "file to write")  //
        ("force", "replace an existing output");
    material.add_options()("density", number()->default_value(usual.density), "kg/m2")  //
        ("normal-stiffness", number()->default_value(usual.normal_stiffness), "N/m")    //
        ("shear-stiffness", number()->default_value(usual.shear_stiffness), "N/m")      //
        ("friction-angle", number()->default_value(usual.friction_angle), "degrees");
    return {
        .synopses = {"crackle pack (--count N | --width W --height H) SIZES (--mean-overlap D | --void-ratio E) "
                     "[OPTIONS]"},
        .description =
            "Packs random circles between four smooth walls to mechanical equilibrium and writes them to an in_gm.dat.",
        .options = {{"options", options}, {"material written to the file", material}},
        .verbose = "time taken by each stage in seconds, and the packing attempts",
        .examples = {
            {"crackle pack --count 304 --radius-min 1.333e-2 --radius-max 2.667e-2 --mean-overlap 7.74e-5 -o "
             "in_gm.dat"},
            {"crackle pack --width 0.5 --height 1 --radius-min 0.01 --radius-max 0.02 --void-ratio 0.19 -o dense.dat"},
            {"crackle pack --count 1000 --lognormal-median 0.01 --lognormal-deviation 0.3 --mean-overlap 2e-5"},
            {"crackle pack --count 500 --sieve curve.csv --mean-overlap 2e-5", "CSV: size,passing_by_mass"}}};
}

int pack(const Invocation& given) {
    const po::variables_map& values = given.values;
    std::vector<std::filesystem::path> inputs;
    if (values.contains("sieve")) inputs.emplace_back(values["sieve"].as<std::string>());
    const std::filesystem::path output =
        output_file(values["output"].as<std::string>(), values.contains("force"), inputs);
    Messages& messages = given.messages;
    const PackingRequest request = packing_request(values, messages);
    std::string stage;
    const Packing packing = make_packing(request, [&](const PackingProgress& p) {
        if (messages.verbose() && p.stage != stage) {
            stage = p.stage;
            messages.detail(fmt::format("attempt {}: {}", p.attempt, stage));
        }
        if (!messages.progress().shown()) return;
        messages.progress().draw(
            {.detail = fmt::format("{} (attempt {}): unbalanced by {:.1e} of the mean contact force", p.stage,
                                   p.attempt, p.residual)});
    });
    messages.make_room();
    messages.detail(fmt::format("packed {} circles with {} contacts in {} attempts", packing.report.circles,
                                packing.report.circle_contacts, packing.report.attempts));
    std::ostringstream deck;
    write_geometry(deck, packing.scene);
    make_folder(folder_of(output));
    replace_file(output, deck.str());
    if (!messages.quiet()) print_report(packing.report, output.string());
    return exit_done;
}

}  // namespace crackle::tools
