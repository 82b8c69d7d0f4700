// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle joints CASE.toml`: generates or reads joint traces, and reports and draws them.

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "solver/base/errors.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/joints/joint_network.hpp"
#include "specimens/joints/joint_report.hpp"
#include "specimens/joints/trace_files.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/joints/joint_panels.hpp"
#include "tools/plot/figure_options.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;

constexpr double most_grains = 1e9;

/// The box given by the case or the options. As in a packing, its lower left corner is the origin.
Domain box_of(const JointCase& given, const po::variables_map& values) {
    Domain box{0.0, 0.0, 0.0, 0.0};
    const auto take = [&](double& to, const std::optional<double>& of_case, const char* option, CaseKey key) {
        if (values.contains(option)) {
            to = values[option].as<double>();
            if (!(to > 0.0 && is_a_size(to)))
                throw InputError(fmt::format("--{}: found {}, expected a length > 0 in m", option, to));
        } else if (of_case) {
            to = *of_case;
        } else {
            throw InputError(fmt::format("{}: found nothing, expected the size of the box; state it, or give --{}",
                                         given.joints.places.at(key), option));
        }
    };
    take(box.x2, given.width, "box-width", CaseKey::packing_width);
    take(box.y2, given.height, "box-height", CaseKey::packing_height);
    return box;
}

/// Number of grains in the box, for the mean spacing given by --grain; 0 without this option.
std::size_t grains_in(const Domain& box, const po::variables_map& values) {
    if (!values.contains("grain")) return 0;
    const double grain = values["grain"].as<double>();
    const double count = (box.x2 - box.x1) * (box.y2 - box.y1) / (grain * grain);
    if (!(grain > 0.0 && count >= 1.0 && count <= most_grains))
        throw InputError(
            fmt::format("--grain: found {}, expected the size of a grain in m, > 0, with 1 to {:.0e} grains in the box",
                        grain, most_grains));
    return static_cast<std::size_t>(std::lround(count));
}

using Json = nlohmann::ordered_json;

Json json_of(const SourceReport& r) {
    Json json{{"name", r.name},
              {"traces", r.traces},
              {"p10", r.p10},
              {"p20", r.p20},
              {"p21", r.p21},
              {"scan_line", r.scan_line},
              {"mean_length", r.mean_length},
              {"longest", r.longest},
              {"direction", r.direction},
              {"kappa", r.kappa},
              {"rose", r.rose.weights}};
    Json asked = nullptr;
    if (r.amount) {
        asked = {{r.amount->key, r.amount->value},
                 {"mean_length", r.mean_length_asked},
                 {"direction", r.direction_asked},
                 {"kappa", r.kappa_asked}};
    }
    json["asked"] = asked;
    return json;
}

Json as_json(const JointNetwork& network, const JointReport& report) {
    Json sources = Json::array();
    for (const SourceReport& r : report.sources) sources.push_back(json_of(r));
    return {
        {"width", network.box.x2 - network.box.x1},
        {"height", network.box.y2 - network.box.y1},
        {"sources", sources},
        {"all", json_of(report.all)},
        {"blocks", report.blocks ? Json(*report.blocks) : Json()},
        {"largest_block", report.largest_block},
        {"median_block", report.median_block},
        {"snap", network.cleaning.snap},
        {"points_left_out", network.cleaning.points_left_out},
        {"brought_together", network.cleaning.brought_together},
        {"largest_displacement", network.cleaning.largest_displacement},
        {"notices", report.notices},
        {"units",
         {{"p10",
           "1/m, number of traces crossed per unit length, averaged over all scan lines in the direction scan_line"},
          {"p20", "1/m2, number of midpoints of traces per unit area"},
          {"p21", "m/m2, length of traces per unit area"},
          {"scan_line, direction", "degrees from +x, counter-clockwise; direction is the mean, weighted by length"},
          {"mean_length",
           "m, mean length of the traces whose midpoint is in the box, before they are cut off at its sides"},
          {"longest", "m, length of the longest trace; only the part in the box counts"},
          {"kappa", "-, concentration of an axial von Mises distribution fitted to the traces, each counted once"},
          {"snap", "m, distance within which nodes and points were merged; 0 if traces were left unchanged"},
          {"largest_displacement", "m, largest displacement caused by merging nodes and leaving out points"},
          {"rose", "m, total length of traces within 5 degrees of 0, 10, ..., 170 degrees"},
          {"largest_block, median_block",
           "-, block areas as fractions of the box's area, as if all traces were open"}}}};
}

std::string beside(double reached, double asked) {
    if (std::isnan(reached)) return "-";
    return std::isnan(asked) ? fmt::format("{:.4g}", reached)
                             : fmt::format("{:.4g} (requested {:.4g})", reached, asked);
}

void print(const SourceReport& r) {
    const auto asked = [&](const char* key) {
        return r.amount && r.amount->key == key ? r.amount->value : SourceReport::none;
    };
    print_out("{}\n", r.name);
    print_out("  traces       {}\n", beside(static_cast<double>(r.traces), asked("number")));
    if (r.traces == 0) return;
    print_out("  P10          {} 1/m along {:.4g} degrees\n", beside(r.p10, asked("p10")), r.scan_line);
    if (!std::isnan(r.p20)) print_out("  P20          {} 1/m2\n", beside(r.p20, asked("p20")));
    print_out("  P21          {} m/m2\n", beside(r.p21, asked("p21")));
    print_out("  mean length  {} m; longest in the box {:.4g} m\n", beside(r.mean_length, r.mean_length_asked),
              r.longest);
    print_out("  direction    {} degrees; kappa {}\n", beside(r.direction, r.direction_asked),
              std::isinf(r.kappa) ? "infinite: parallel" : beside(r.kappa, r.kappa_asked));
}

void print(const JointNetwork& network, const JointReport& report) {
    print_out("box {:.6g} m x {:.6g} m\n", network.box.x2 - network.box.x1, network.box.y2 - network.box.y1);
    if (const std::string cleaning = cleaning_text(network.cleaning); !cleaning.empty()) print_out("{}\n", cleaning);
    for (const SourceReport& r : report.sources) print(r);
    if (report.sources.size() > 1) print(report.all);
    if (!report.blocks) {
        print_out("blocks         -\n");
        return;
    }
    print_out(
        "blocks         {} if all traces were open; the largest has {:.3g} of the area, the median block {:.3g}\n",
        *report.blocks, report.largest_block, report.median_block);
}

void draw(const JointNetwork& network, const JointReport& report, const fs::path& output, const plot::FigureLook& look,
          plot::Format format) {
    using Rows = std::vector<std::vector<plot::Panel>>;
    constexpr double widest_stacked = 120.0 * plot::points_of_mm;
    const plot::Panel map = plot::trace_map(network), rose = plot::trace_rose(network, report);
    const Rows rows = look.width < widest_stacked ? Rows{{map}, {rose}} : Rows{{map, rose}};
    replace_file(output, plot::figure(rows, look.title, look.width, format, look.sheet));
}

std::string text_of(const JointNetwork& network) {
    TracePoints traces;
    for (const JointTrace& trace : network.traces) traces.push_back(trace.points);
    return traces_text(traces);
}

}  // namespace

CommandLine describe_joints() {
    const auto number = [] { return po::value<double>()->value_name("X"); };
    po::options_description options;
    options.add_options()("json", "print one JSON object")                                    //
        ("seed", po::value<std::int64_t>()->value_name("N"), "seed in place of joints.seed")  //
        ("box-width", number(), "width of the box, m, if the case has no packing.width")      //
        ("box-height", number(), "height of the box, m, if the case has no packing.height")   //
        ("grain", number(),
         "mean spacing of the grains, m; traces are prepared as for a mesh of such grains (see joints.snap and "
         "joints.shortest)")  //
        ("traces", po::value<std::string>()->value_name("FILE"),
         "file to write: the traces in the box, with one line x1 y1 x2 y2 ... per trace")  //
        ("output,o", po::value<std::string>()->value_name("FIGURE"),
         "figure to write: .svg, .pdf or .png; it shows the traces in the box and a rose of their directions");
    plot::add_figure_options(options, 2);
    options.add_options()("force", "replace existing files");
    std::vector<Companion> companions{{"force", {"output", "traces"}}};
    for (const std::string& option : plot::figure_options()) companions.push_back({option, {"output"}});
    return {.synopses = {"crackle joints CASE.toml [OPTIONS]"},
            .description =
                "Generates or reads traces of joints in the box of a specimen. They are defined by [[joint_set]] and "
                "[[trace]] of a case, or of a file with only these tables that cases include. Prints the requested and "
                "the obtained amounts (P10, P20, P21, lengths, directions), and the blocks that the traces would cut "
                "out if all of them were open. The same seed gives the same traces. With joints.snap in the file, or "
                "with --grain, traces are prepared as for a mesh. Segments of one fault are then joined, and nodes "
                "that nearly coincide are merged; the changes are printed.",
            .options = {{"options", options}},
            .operand = "CASE.toml",
            .companions = companions,
            .examples = {{"crackle joints specimens/jointed/two_sets.toml", "prints amounts, directions and blocks"},
                         {"crackle joints specimens/jointed/two_sets.toml -o traces.svg"},
                         {"crackle joints specimens/jointed/two_sets.toml --seed 7 --traces traces.txt"},
                         {"crackle joints specimens/jointed/survey.toml --grain 0.05", "for cells of 5 cm"}}};
}

int joints(const Invocation& given) {
    if (given.operands.size() != 1)
        throw InputError(fmt::format("joints: found {} files, expected one: crackle joints CASE.toml (see --help)",
                                     given.operands.size()));
    const std::string& source = given.operands.front();
    return joints_of(CaseFiles(fs::path(source)).joints(), source, given);
}

int joints_of(JointCase test, const std::string& name, const Invocation& given) {
    const po::variables_map& values = given.values;
    JointRequest& joints = test.joints;
    if (joints.empty())
        throw InputError(
            fmt::format("{}: found no [[joint_set]] and no [[trace]], expected one; see crackle test --keys", name));
    if (values.contains("seed")) {
        if (joints.sets.empty()) throw without_effect("crackle joints", "--seed", "a case without any [[joint_set]]");
        const auto seed = values["seed"].as<std::int64_t>();
        if (seed < 0) throw InputError(fmt::format("--seed: found {}, expected a whole number >= 0", seed));
        joints.seed = static_cast<std::uint64_t>(seed);
    }
    const std::vector<fs::path>& inputs = test.files;
    plot::Format format = plot::Format::svg;
    const std::string figure = values.contains("output") ? values["output"].as<std::string>() : "";
    const std::string table = values.contains("traces") ? values["traces"].as<std::string>() : "";
    if (!figure.empty()) {
        format = plot::format_of_output("joints", figure);
        output_file(figure, values.contains("force"), inputs);
    }
    const plot::FigureLook look = plot::figure_look("joints", values, format);
    if (!table.empty()) output_file(table, values.contains("force"), inputs);
    const Domain box = box_of(test, values);
    const JointNetwork network = make_joints(joints, box, grains_in(box, values));
    const JointReport report = report_joints(joints, network);
    if (!figure.empty()) draw(network, report, figure, look, format);
    if (!table.empty()) replace_file(table, text_of(network));
    if (values.contains("json")) {
        print_text(as_json(network, report).dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
        return exit_done;
    }
    if (!given.messages.quiet()) {
        print(network, report);
        for (const std::string& notice : report.notices) print_out("notice: {}\n", notice);
    }
    return exit_done;
}

}  // namespace crackle::tools
