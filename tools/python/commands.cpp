// SPDX-License-Identifier: GPL-3.0-or-later
// Runs commands of the program within the Python process: their options, and commands whose results are files or JSON.
// Tested by tests/tools/python/commands_test.py.
#include "tools/commands/commands.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <chrono>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/elastic/analysis.hpp"
#include "specimens/elastic/jointed_compliance.hpp"
#include "specimens/loading/check.hpp"
#include "specimens/loading/prepare.hpp"
#include "tools/campaign/campaign.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/python/arrays.hpp"
#include "tools/python/parts.hpp"
#include "tools/python/reports.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::python {
namespace {

struct Called {
    const char* name;
    tools::CommandLine (*describe)();
    int (*run)(const tools::Invocation&);
};

/// Commands that the module calls with arguments as on a command line.
const std::vector<Called>& called() {
    static const std::vector<Called> all{{"pack", tools::describe_pack, tools::pack},
                                         {"mesh", tools::describe_mesh, tools::mesh},
                                         {"joints", tools::describe_joints, tools::joints},
                                         {"test", tools::describe_test, tools::test},
                                         {"elastic", tools::describe_elastic, tools::elastic},
                                         {"campaign", tools::describe_campaign, tools::campaign},
                                         {"campaign show", tools::describe_campaign_show, tools::campaign_show},
                                         {"envelope", tools::describe_envelope, tools::envelope},
                                         {"calibrate", tools::describe_calibrate, tools::calibrate_rock},
                                         {"report", tools::describe_report, tools::report},
                                         {"view", tools::describe_view, tools::view},
                                         {"plot", tools::describe_plot, tools::plot}};
    return all;
}

const Called& command(const std::string& name) {
    for (const Called& one : called())
        if (name == one.name) return one;
    throw InputError(fmt::format("command: found '{:.40}', expected a command that the module can run", name));
}

/// Options of a command, as tuples: name, argument, whether it takes several values, default, description, accepted
/// words.
py::list options(const std::string& name) {
    py::list all;
    for (const tools::OptionGroup& group : tools::option_groups(command(name).describe()))
        for (const tools::OptionFacts& option : group.options)
            all.append(py::make_tuple(option.name, option.argument, option.several, option.value, option.description,
                                      option.words));
    return all;
}

/// During its lifetime, std::cout writes to this object, and tools::interrupted() polls the given Interrupts. Only one
/// such object may exist in a process.
class OneCommand {
  public:
    explicit OneCommand(Interrupts& interrupts) {
        if (running)
            throw std::runtime_error(
                "found another command of crackle running in this process, expected one at a time");
        running = true;
        before_ = std::cout.rdbuf(text_.rdbuf());
        tools::hear_interrupts_by([&interrupts] { return interrupts.heard(); });
    }
    OneCommand(const OneCommand&) = delete;
    OneCommand& operator=(const OneCommand&) = delete;
    ~OneCommand() {
        tools::hear_interrupts_by([] { return false; });
        std::cout.rdbuf(before_);
        running = false;
    }
    std::string printed() const { return text_.str(); }

  private:
    inline static bool running = false;  // protected by the interpreter lock
    std::ostringstream text_;
    std::streambuf* before_ = nullptr;
};

/// Runs a command and captures what it prints to stdout. @return its exit code and output
template <class Run>
py::tuple run_words(const std::string& name, const tools::Arguments& words, const py::object& report, const Run& run) {
    const tools::ParsedWords parsed = tools::parse_words("crackle " + name, command(name).describe(), words);
    Interrupts interrupts;
    tools::Messages messages(reporting_listener(report, interrupts));
    const OneCommand output(interrupts);
    int code = 0;
    run_free(interrupts, [&] { code = run({parsed.values, parsed.operands, words, messages}); });
    return py::make_tuple(code, output.printed());
}

py::tuple run_command(const std::string& name, const tools::Arguments& words, const py::object& report) {
    return run_words(name, words, report, command(name).run);
}

/// Runs `crackle joints` for a case, which may have been made in Python.
py::tuple run_joints(const JointCase& test, const std::string& name, const tools::Arguments& words) {
    return run_words("joints", words, py::none(),
                     [&](const tools::Invocation& given) { return tools::joints_of(test, name, given); });
}

/// Computes the linear solution for a case. @return result as JSON text, all bonds, and notices
py::tuple elastic(const ResolvedCase& description, double strain, int modes, const py::object& report) {
    if (!(strain > 0.0) || !(strain < 1.0))
        throw InputError(fmt::format("crackle elastic: strain: found {}, expected a number > 0 and < 1", strain));
    if (modes < 0) throw InputError(fmt::format("crackle elastic: modes: found {}, expected a number >= 0", modes));
    std::vector<std::string> notices;
    Interrupts interrupts;
    const TestHooks hooks = reporting_hooks(report, interrupts);
    auto analysis = std::make_shared<ElasticAnalysis>();
    std::string json;
    run_free(interrupts, [&] {
        const auto start = std::chrono::steady_clock::now();
        const VirtualTest test = bond_test(tools::elastic_case(description, notices), hooks);
        *analysis = analyse_elastic(test.world, test.setup, moduli_of(test), strain, modes);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        notices.insert(notices.end(), test.setup.origin.notices.begin(), test.setup.origin.notices.end());
        TestHooks quietly = hooks;  // hooks for making the same specimen again without reports
        quietly.stage = quietly.detail = {};
        json = tools::elastic_as_json(test, *analysis, jointed_compliance(test.description, quietly),
                                      seconds - test.specimen_seconds);
    });
    return py::make_tuple(json, view_of(analysis->bonds, analysis), notices);
}

/// Estimates results and cost of a test. @return result as JSON text
std::string check(ResolvedCase description, int threads, const py::object& report) {
    tools::Messages messages(tools::Loudness::quiet);
    if (threads > 0) description.numerics.threads = threads;
    description.numerics.threads = tools::threads_of_machine(description.numerics.threads, messages);
    Interrupts interrupts;
    const TestHooks hooks = reporting_hooks(report, interrupts);
    std::string json;
    run_free(interrupts, [&] { json = tools::check_as_json(check_test(description, hooks)); });
    return json;
}

}  // namespace

void bind_commands(py::module_& module) {
    module.def("options", &options, py::arg("command"));
    module.def("run_command", &run_command, py::arg("command"), py::arg("words"), py::arg("report"));
    module.def("run_joints", &run_joints, py::arg("case"), py::arg("name"), py::arg("words"));
    module.def("elastic", &elastic, py::arg("case"), py::arg("strain"), py::arg("modes"), py::arg("report"));
    module.def("check", &check, py::arg("case"), py::arg("threads"), py::arg("report"));
}

}  // namespace crackle::python
