// SPDX-License-Identifier: GPL-3.0-or-later
// The subcommands of `crackle`, each in a file of its own; commands.cpp has their table.
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
struct JointCase;
struct MeshReport;
struct PackingRequest;
struct Scene;
struct ResolvedCase;
struct TestCheck;
struct TestHooks;
struct TestOptions;
struct TestProgress;
struct VirtualTest;

}  // namespace crackle

namespace crackle::tools {

namespace po = boost::program_options;

/// The commands, in the order of a typical workflow.
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

/// Path of crackle-bench: in the same folder as this program, or on the PATH; empty if it was not found.
std::string bench_program();

// Functions that do the work of commands without printing, for callers that need the values (tools/python).

/// The packing that the options of `crackle pack` request. @throws InputError that names the invalid option
PackingRequest packing_request(const po::variables_map& values, Messages& messages);
/// The kind of mesh that --kind selects. @throws InputError if it is not given
MeshKind mesh_kind(const po::variables_map& values);
/// Makes polygons from the text of a packing or of a list of centres. @param name name of the text, for errors @param
/// of_joints receives the report lines about joint traces, before and after meshing; may be null @param interrupted as
/// in MeshRequest
/// @throws TestInterrupted
Scene meshed_scene(const std::string& name, const std::string& text, const po::variables_map& values, MeshKind kind,
                   Messages& messages, MeshReport& report, std::vector<std::string>* of_joints = nullptr,
                   const std::function<bool()>& interrupted = {});
/// Runs `crackle joints` for the joints of a case. @param name name of the case, for errors
int joints_of(JointCase test, const std::string& name, const Invocation& given);
/// Limits options.most_threads to the number of threads worth using, at most `asked`.
void limit_threads(TestOptions& options, std::int64_t asked);
/// Number of threads for a resumed test: as given in the options, otherwise as in its case. @throws InputError
std::int64_t threads_to_resume(const TestOptions& options);
/// Progress of a test as shown by the program.
Progress shown_progress(const TestProgress& test);
/// Output of `crackle test --check --json`. @param indent spaces per level; -1 for a single line
std::string check_as_json(const TestCheck& check, int indent = -1);
/// The case as used for the linear solution. @param notices receives a notice for each part of the case that is ignored
ResolvedCase elastic_case(ResolvedCase description, std::vector<std::string>& notices);
/// Output of `crackle elastic --json`. @param indent as in check_as_json()
std::string elastic_as_json(const VirtualTest& test, const ElasticAnalysis& analysis,
                            const std::optional<JointedCompliance>& compliance, double seconds, int indent = -1);

}  // namespace crackle::tools
