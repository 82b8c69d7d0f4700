// SPDX-License-Identifier: GPL-3.0-or-later
// The subcommands of `crackle`, one file each; commands.cpp has their table.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/command_line/program.hpp"
#include "tools/terminal/messages.hpp"

namespace boost::program_options {
class variables_map;
}

namespace crackle {

enum class MeshKind : std::uint8_t;

struct ElasticAnalysis;
struct JointedCompliance;
struct MeshReport;
struct PackingRequest;
struct Scene;
struct TestCase;
struct TestCheck;
struct TestHooks;
struct TestOptions;
struct TestProgress;
struct VirtualTest;

}  // namespace crackle

namespace crackle::tools {

namespace po = boost::program_options;

/// In the order of a user's work.
const std::vector<Command>& commands();

CommandLine describe_pack();
int pack(const Invocation& given);
CommandLine describe_mesh();
int mesh(const Invocation& given);
CommandLine describe_joints();
int joints(const Invocation& given);
CommandLine describe_run();
int run_deck(const Invocation& given);
CommandLine describe_test();
int test(const Invocation& given);
CommandLine describe_elastic();
int elastic(const Invocation& given);
CommandLine describe_campaign();
int campaign(const Invocation& given);
const std::vector<Command>& campaign_studies();
CommandLine describe_envelope();
int envelope(const Invocation& given);
CommandLine describe_calibrate();
int calibrate_rock(const Invocation& given);
CommandLine describe_report();
int report(const Invocation& given);
CommandLine describe_view();
int view(const Invocation& given);
CommandLine describe_plot();
int plot(const Invocation& given);
CommandLine describe_bench();
int bench(const Invocation& given);
CommandLine describe_doctor();
int doctor(const Invocation& given);
CommandLine describe_completion();
int completion(const Invocation& given);
CommandLine describe_manual();
int manual(const Invocation& given);

/// Where crackle-bench is: beside this program, else on the PATH; empty: nowhere.
std::string bench_program();

// What the commands do, without their printing: for callers that want values (tools/python).

/// @throws InputError naming the option
PackingRequest packing_request(const po::variables_map& values, Messages& messages);
/// Of the option --kind. @throws InputError where it is not given
MeshKind mesh_kind(const po::variables_map& values);
/// Polygons from the text of a packing or of a list of centres. @param name of it, for errors @param of_joints lines on
/// the traces and on the mesh without them, where there are some @param interrupted as of MeshRequest
/// @throws TestInterrupted
Scene meshed_scene(const std::string& name, const std::string& text, const po::variables_map& values, MeshKind kind,
                   Messages& messages, MeshReport& report, std::vector<std::string>* of_joints = nullptr,
                   const std::function<bool()>& interrupted = {});
/// What `crackle joints` does with the joints of a case. @param name of it, for errors
int joints_of(TestCase test, const std::string& name, const Invocation& given);
/// Threads that are of use here, of those that are asked for.
void limit_threads(TestOptions& options, std::int64_t asked);
/// Threads that a test that is gone on with asks for: the options', else its case's. @throws InputError
std::int64_t threads_to_resume(const TestOptions& options);
/// How far a test is, as the program shows it.
Progress shown_progress(const TestProgress& test);
/// What `crackle test --check --json` prints. @param indent spaces a level; -1: all on one line
std::string check_as_json(const TestCheck& check, int indent = -1);
/// The case as the linear solution takes it; a notice of each thing that it leaves out.
TestCase elastic_case(TestCase description, std::vector<std::string>& notices);
/// What `crackle elastic --json` prints. @param indent as of check_as_json()
std::string elastic_as_json(const VirtualTest& test, const ElasticAnalysis& analysis,
                            const std::optional<JointedCompliance>& compliance, double seconds, int indent = -1);

}  // namespace crackle::tools
