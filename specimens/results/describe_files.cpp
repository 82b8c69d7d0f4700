// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/describe_files.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <ostream>
#include <string>

#include "specimens/emission/acoustic_event.hpp"
#include "specimens/frames/frame_painter.hpp"
#include "specimens/observers/curve.hpp"
#include "specimens/observers/events.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/results/summary_keys.hpp"

namespace crackle {
namespace {

void begin_table(std::ostream& out, const char* what) {
    fmt::print(out, "\n| {} | unit | meaning |\n| --- | --- | --- |\n", what);
}

/// In a cell of a table.
std::string in_cell(const std::string& text) {
    std::string cell;
    for (const char letter : text) {
        if (letter == '|') cell += '\\';
        cell += letter;
    }
    return cell;
}

void print_row(std::ostream& out, const Quantity& q, const std::string& beside = "") {
    std::string meaning = q.meaning;
    if (*q.more != '\0') meaning += meaning.empty() ? q.more : std::string("; ") + q.more;
    fmt::print(out, "| `{}`{} | {} | {} |\n", q.name, beside, q.unit, in_cell(meaning));
}

void print_table(std::ostream& out, const char* what, std::span<const Quantity> quantities) {
    begin_table(out, what);
    for (const Quantity& q : quantities) print_row(out, q);
}

constexpr const char* introduction =
    R"(# Files of a test

Printed by `crackle test --files`, from the declarations by which the files are written.

`crackle test CASE.toml -o OUT` leaves in `OUT/`:

| file | holds |
| --- | --- |
)";

constexpr const char* folder_text = R"(
A folder that holds results is refused; with `--force` the new results grow in `OUT.new` (a file `replaces-older-results` marks it) and
take the place of the old ones once they are complete. `crackle report OUT` adds `report.html`.

What a stop leaves: a signal, a full disc or a loss of power at any moment leaves the earlier results whole, or a checkpoint from which
`--resume` goes on to the same bytes. A checkpoint gets its name when it and all that it knows of are on the disc; `curve.csv`,
`events.csv`, `slips.csv` and `ae.csv` must still begin with what was written up to it (by their hash), or the test is not resumed. Files that are
moved away or changed while the test runs end it with an error. `summary.json` states length and hash of these files and of the checkpoint:
whatever reads results, and `--resume` of a finished test, refuses a file that is not the one that the test wrote.

Units are those of the case, SI in what is shipped. Everything is per unit thickness: masses are in kg, forces in N, stresses and moduli are
force over a length, N/m. «Positive in the sense of the test»: compression positive when the specimen is squeezed, tension positive when it is
pulled. A normal force is positive when it pushes apart. Angles are in radians, counter-clockwise. Ids are those of the particle file or
packing, whatever the internal numbering; the platens come last. Numbers read back to the same bits. The physics behind
them: [solver/MODEL.md](../../solver/MODEL.md), [specimens/METHODS.md](../METHODS.md).
)";

constexpr const char* curve_text = R"(
## `curve.csv`

One row for each of `output.curve_rows` equal parts of `loading.max_axial_strain`, the first at the start of loading, the last at the end.
Peak, failure and moduli are judged by at least 2000 rows, whatever is written.
)";

constexpr const char* events_text = R"(
## `events.csv`

One row for each bonded point that broke, in the order in which they broke (what acoustic emission hears). Of two polygons an *interface* holds
several bonded points, and each has its row.
)";

constexpr const char* slips_text = R"(
## `slips.csv`

With `output.slips = true`, one row for each back-tension bond that reached its Coulomb limit for the first time: the shear damage that no break
shows, for such a bond slides within its limit and parts where its overlap is used up. Coulomb bonds stick until they fail.
)";

constexpr const char* emission_text = R"(
## `ae.csv`

With `output.emission = true`, one row for each acoustic event, in the order in which they ended: breaks that belong together in place and
time, and the largest moment of their source meanwhile ([how](../METHODS.md#acoustic-emission)). Every break is in one event. Energies and moments are those of the
model, per unit thickness; magnitudes are those of the specimen as thick as `output.out_of_plane_thickness` says.
)";

constexpr const char* summary_text = R"(
## `summary.json`

Written at the end, and when a test is interrupted. What is not defined is `null`. A key with `.` lies in the table named before it; `*` stands for any
name, `[]` for each entry of a list. Beside each stress and modulus stands the same with `_pa`, in Pa: over `output.out_of_plane_thickness`. A key
that stands here twice has the meaning that fits the test.
)";

constexpr const char* frames_text = R"(
## `frames/`

Each moment is three files, of a jointed specimen four, named by its row of the judged curve (from 0, five digits or more), which `frames.pvd` lists as
parts 0 to 3 of a time series. They are VTK's XML PolyData (compressed, `.vtp`), with the moment as field data. Points are Float32 (Float64 with `output.frame_precision = "double"`), what was computed Float64.

| file | holds |
| --- | --- |
| `particles_NNNNN.vtp` | platens as lines, polygons by their corners, circles as regular polygons of the circle's area (24 corners, 12 beyond 2000 particles); a clump's circles all have its values |
| `contacts_NNNNN.vtp` | every bond that loading began with, in the same order in each file, then what else touches at the moment: as lines centre-point-centre between circles, from surface to surface between polygons |
| `cracks_NNNNN.vtp` | a line for each bonded point broken so far, in the order of `events.csv`: its share of the face at which the bodies were held together, where they have carried it |
| `joints_NNNNN.vtp` | a line for each face on a trace of joints, of a jointed specimen |
| `frames.pvd` | the list of all of them, for ParaView |

Field data of all of them:
)";

}  // namespace

void describe_test_files(std::ostream& out) {
    out << introduction;
    for (const ResultFile& file : result_files()) fmt::print(out, "| `{}` | {} |\n", file.name, file.holds);
    out << folder_text << curve_text;
    begin_table(out, "column");
    for (const CurveColumn& column : curve_columns()) print_row(out, column.what);
    out << events_text;
    begin_table(out, "column");
    for (const EventColumn& column : event_columns()) print_row(out, column.what);
    out << slips_text;
    begin_table(out, "column");
    for (const SlipColumn& column : slip_columns()) print_row(out, column.what);
    out << emission_text;
    begin_table(out, "column");
    for (const AcousticColumn& column : acoustic_columns()) print_row(out, column.what);
    out << summary_text;
    begin_table(out, "key");
    for (const SummaryKey& key : summary_keys())
        print_row(out, key.what, key.converted ? fmt::format(", `{}{}`", key.what.name, converted_suffix) : "");
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
