// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/describe_files.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "specimens/frames/frame_arrays.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/results/result_tables.hpp"
#include "specimens/summary/summary_keys.hpp"

namespace crackle {
namespace {

void begin_table(std::ostream& out, const char* what) {
    fmt::print(out, "\n| {} | unit | meaning |\n| --- | --- | --- |\n", what);
}

/// Escapes text for a table cell.
std::string in_cell(const std::string& text) {
    std::string cell;
    for (const char letter : text) {
        if (letter == '|') cell += '\\';
        cell += letter;
    }
    return cell;
}

/// Makes the first letter a capital, unless the text begins with the name of a key.
std::string capitalised(std::string text) {
    const std::string word = text.substr(0, text.find_first_of(" ,.:;/("));
    const bool is_word = std::ranges::all_of(word, [](char c) { return (c >= 'a' && c <= 'z') || c == '-'; });
    if (word.size() > 1 && is_word && word != "sqrt" && word != "nan") text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

void print_row(std::ostream& out, const Quantity& q, const std::string& beside = "") {
    const std::string first = capitalised(q.meaning), second = capitalised(q.more);
    const char* const between = first.empty() || second.empty() ? "" : ". ";
    fmt::print(out, "| `{}`{} | {} | {} |\n", q.name, beside, q.unit, in_cell(first + between + second));
}

void print_table(std::ostream& out, const char* what, std::span<const Quantity> quantities) {
    begin_table(out, what);
    for (const Quantity& q : quantities) print_row(out, q);
}

constexpr const char* introduction =
    R"(# Files of a test

Printed by `crackle test --files` and generated from the same declarations as the files themselves.

`crackle test CASE.toml -o OUT` leaves in `OUT/`:

| file | holds |
| --- | --- |
)";

constexpr const char* folder_text = R"(
A folder is refused if it contains files that are not results of a test, or an input of the case. A test's folder is recognised by the
first bytes of `case.toml` or `checkpoint`. A folder with results is also refused. With `--force`, new results are written to `OUT.new`, marked by a file
`replaces-older-results`, and replace the old results once they are complete. If that test is interrupted, `crackle test --resume OUT.new` continues it and replaces the old results in the same way.
Other files are kept. While `OUT.new` contains a test that can be resumed, `--force` is refused; remove `OUT.new` first. `crackle report OUT` adds
`report.html`. Until a file is complete, its name consists of 16 hexadecimal digits and `.crackle_tmp`. If a stopped run leaves such files,
the next run removes them. Results are never written through a symbolic link.

After a signal, a full disk or a power failure, either the earlier results are complete, or there is a checkpoint. `--resume` continues
from the checkpoint and produces the same bytes. A checkpoint receives its name only when it and all data that it refers to are on disk. `curve.csv`, `events.csv`, `slips.csv`
and `ae.csv` must still begin with their contents at the time of the checkpoint (checked by hash), otherwise the test is not resumed. If these files are moved or changed
while the test runs, the test ends with an error. `summary.json` states the length and hash of these files and of the checkpoint. Commands that read
results, and `--resume` of a finished test, refuse a file that differs from the one that the test wrote.

Units are those of the case; the cases supplied use SI units. All quantities are per unit thickness: masses are in kg, forces in N, and stresses and moduli are
forces divided by lengths, in N/m. «Positive in the direction of loading» means that compression is positive if the specimen is compressed, and tension is positive if it is
pulled. A normal force is positive if it pushes the bodies apart. Angles are in radians, counter-clockwise. Ids are those of the particle file or
packing, independent of the internal numbering; platens have the largest ids. Numbers are written with enough digits to be read back exactly. The physics is described
in [solver/MODEL.md](../../solver/MODEL.md) and [specimens/METHODS.md](../METHODS.md).
)";

constexpr const char* summary_text = R"(
## `summary.json`

Written at the end, and when a test is interrupted. Values that are not defined are `null`. In `table.key`, the key belongs to the table named before the point; `*` stands for any
name, `[]` for each entry of a list. Each stress and modulus has a second key with the suffix `_pa`: its value in Pa, divided by `output.out_of_plane_thickness`. If a key
is listed twice, the meaning depends on the test.
)";

constexpr const char* frames_text = R"(
## `frames/`

Each frame consists of three files (four for a jointed specimen). Their names contain the index of the frame's row among the rows from which the peak is determined (from 0, at least five digits). `frames.pvd` lists
the files as parts 0 to 3 of a time series. The files are VTK's XML PolyData (compressed, `.vtp`); field data state the strain, stress and time of the frame. Points are Float32 (Float64 with `output.frame_precision = "double"`), computed values are Float64.

| file | holds |
| --- | --- |
| `particles_NNNNN.vtp` | platens as lines, polygons by their corners, circles as regular polygons of equal area (24 corners, or 12 with more than 2000 particles). All circles of a clump have the values of the clump |
| `contacts_NNNNN.vtp` | all bonds that were intact when loading began, in the same order in each file, followed by other current contacts. Lines run from centre to point to centre between circles, from surface to surface between polygons, and along the face if polygons are bonded by faces |
| `cracks_NNNNN.vtp` | a line for each bonded contact point that has broken, in the order of `events.csv`. The line is the point's part of the face along which two bodies were bonded, at its current position |
| `joints_NNNNN.vtp` | a line for each face on a joint trace; only for jointed specimens |
| `frames.pvd` | list of all these files, for ParaView |

Field data of all of them:
)";

}  // namespace

void describe_test_files(std::ostream& out) {
    out << introduction;
    for (const ResultFile& file : result_files()) fmt::print(out, "| `{}` | {} |\n", file.name, file.holds);
    out << folder_text;
    for (std::size_t k = 0; k < result_tables; ++k) {
        const auto table = static_cast<ResultTable>(k);
        fmt::print(out, "\n## `{}`\n{}", name_of(table), facts_of(table).section);
        print_table(out, "column", facts_of(table).columns());
    }
    out << summary_text;
    begin_table(out, "key");
    for (const SummaryKey& key : summary_keys())
        if (!key.again)
            print_row(out, {key.name.c_str(), key.unit.c_str(), key.meaning.c_str(), key.more.c_str()},
                      key.converted ? fmt::format(", `{}{}`", key.name, converted_suffix) : "");
    out << frames_text;
    print_table(out, "field", frame_fields());
    out << "\nCell data of `particles`:\n";
    print_table(out, "array", particle_arrays());
    out << "\nCell data of `contacts`:\n";
    print_table(out, "array", contact_arrays());
    out << "\nCell data of `cracks`:\n";
    print_table(out, "array", crack_arrays());
    out << "\nCell data of `joints`:\n";
    print_table(out, "array", joint_arrays());
}

}  // namespace crackle
