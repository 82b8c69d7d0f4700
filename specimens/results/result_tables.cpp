// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/result_tables.hpp"

#include "specimens/emission/acoustic_event.hpp"
#include "specimens/observers/curve.hpp"
#include "specimens/observers/events.hpp"

namespace crackle {
namespace {

template <class Column>
std::vector<Quantity> meanings(const std::vector<Column>& columns) {
    std::vector<Quantity> all;
    all.reserve(columns.size());
    for (const Column& column : columns) all.push_back(column.what);
    return all;
}

bool always(const FileOptions& /*options*/) { return true; }

// Properties of the tables, in the order of the enumerators of ResultTable.
constexpr auto all_facts = std::to_array<ResultTableFacts>({
    {.holds = "one row for each recorded point of the stress-strain curve",
     .section = R"(
One row for each of `output.curve_rows` equal parts of `loading.max_axial_strain`; the first row is at the start of loading, the last at the end of the test.
Peak, failure and moduli are determined from at least 2000 rows, even if fewer are written. Counts, losses and work are totals since loading began.
)",
     .wanted = always,
     .header = [](const FileOptions& options) { return curve_header(options.pressed); },
     .columns = [] { return meanings(curve_columns()); }},
    {.holds = "one row per bonded contact point that broke",
     .section = R"(
One row for each bonded contact point that broke, in the order in which they broke, similar to a record of acoustic emission. Two polygons may have several
bonded contact points (their *interface*); each of these has its own row.
)",
     .wanted = always,
     .header = [](const FileOptions& options) { return events_header(options.jointed); },
     .columns = [] { return meanings(event_columns()); }},
    {.holds = "one row per bonded contact point that slips, at its first slip; only with `output.slips = true`",
     .section = R"(
With `output.slips = true`, one row for each back-tension bond that reached its Coulomb limit, written when it first did so. The file shows shear damage that does not appear
among breaks: a back-tension bond slides at its limit, and breaks only when its overlap vanishes. Coulomb bonds do not slide before they fail.
)",
     .wanted = [](const FileOptions& options) { return options.output.slips; },
     .header = [](const FileOptions& /*options*/) { return slips_header(); },
     .columns = [] { return meanings(slip_columns()); }},
    {.holds = "one row per acoustic event, a group of bond breaks close in place and time, with the moment of its "
              "source; only with `output.emission = true`",
     .section = R"(
With `output.emission = true`, one row for each acoustic event, in the order in which the events ended. An event is a group of breaks close in
place and time ([method](../emission/METHODS.md)); its moment is the largest moment of the source during the event. Every break belongs to exactly one event.
Energies and moments are those of the two-dimensional model, per metre of thickness. Magnitudes are those of a specimen whose thickness is `output.out_of_plane_thickness`.
)",
     .wanted = [](const FileOptions& options) { return options.emission; },
     .header = [](const FileOptions& /*options*/) { return acoustic_header(); },
     .columns = [] { return meanings(acoustic_columns()); }},
});
static_assert(all_facts.size() == result_tables);

}  // namespace

const ResultTableFacts& facts_of(ResultTable table) { return all_facts[static_cast<std::size_t>(table)]; }

std::vector<ResultTable> tables_of(const FileOptions& options) {
    std::vector<ResultTable> tables;
    for (std::size_t k = 0; k < result_tables; ++k)
        if (all_facts[k].wanted(options)) tables.push_back(static_cast<ResultTable>(k));
    return tables;
}

FileMarks named_marks(const std::vector<ResultTable>& tables, const TableMarks& marks) {
    FileMarks named;
    for (const ResultTable table : tables) named.emplace_back(name_of(table), marks[static_cast<std::size_t>(table)]);
    return named;
}

}  // namespace crackle
