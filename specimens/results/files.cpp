// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/files.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "solver/files/read_file.hpp"
#include "specimens/observers/events.hpp"
#include "specimens/results/checkpoint.hpp"
#include "specimens/summary/summary_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds collection_interval{1};
/// Number of frames that may wait to be drawn, and the largest number of bodies for which several may wait.
constexpr std::size_t most_waiting = 4, most_bodies_of_several = 20'000;

/// Removes frame files that are not listed in the state: they were written after the checkpoint, and the resumed test
/// might not write them again.
void remove_unlisted_frames(const fs::path& frames, const TestState& state) {
    std::set<std::string> listed;
    for (const FrameEntry& entry : state.frames)
        listed.insert(
            {particles_file(entry.row), contacts_file(entry.row), cracks_file(entry.row), joints_file(entry.row)});
    std::error_code ignored;
    for (const std::string& name : names_in(frames))
        if (is_picture(name) && !listed.contains(name)) fs::remove(frames / name, ignored);
}

}  // namespace

TestFiles::TestFiles(const OutputFolder& folder, std::string case_hash, TestState& state, const FileOptions& options)
    : folder_(folder), case_hash_(std::move(case_hash)), options_(options), collection_due_(!state.frames.empty()) {
    for (const ResultTable table : tables_of(options)) {
        const FileMark& mark = state.tables[static_cast<std::size_t>(table)];
        GrowingFile& file = tables_[static_cast<std::size_t>(table)].emplace(folder.path() / name_of(table), mark);
        if (mark.bytes == 0) file.write(facts_of(table).header(options));
    }
    remove_unlisted_frames(folder.path() / "frames", state);
    if (state.peak_frame.bodies.size() < options_.large_frame) return;
    peak_on_disc_.emplace(folder.path());
    peak_on_disc_->put(state.peak_frame);
    state.peak_frame = {};
}

void TestFiles::add(ResultTable table, const std::string& line) {
    if (auto& file = tables_[static_cast<std::size_t>(table)]) file->write(line);
}

void TestFiles::add_row(const CurveRow& row) { add(ResultTable::curve, curve_line(row, options_.pressed)); }

void TestFiles::add_event(const BreakEvent& event, double axial_strain, std::int32_t trace) {
    add(ResultTable::events, event_line(event, axial_strain, options_.jointed ? std::optional(trace) : std::nullopt));
}

void TestFiles::add_frame(const CurveRow& row, std::int64_t row_index, const TestSetup& setup, TestState& state,
                          const World& world) {
    if (!list_frame({row_index, row.axial_strain, row.time}, setup, state, world)) return;
    Frame frame;
    take_frame(world, setup.bonds, state.history, row, row_index, frame);
    draw(std::move(frame), setup, state, world);
}

void TestFiles::keep_peak(const CurveRow& row, std::int64_t row_index, const TestSetup& setup, TestState& state,
                          const World& world) {
    if (world.bodies.size() < options_.large_frame) {
        take_frame(world, setup.bonds, state.history, row, row_index, state.peak_frame);
        return;
    }
    if (!peak_on_disc_) peak_on_disc_.emplace(folder_.path());
    take_frame(world, setup.bonds, state.history, row, row_index, *peak_on_disc_);
}

void TestFiles::add_peak(const TestSetup& setup, TestState& state, const World& world) {
    Frame frame = peak_on_disc_ ? peak_on_disc_->whole() : state.peak_frame;
    if (frame.row < 0 || !list_frame({frame.row, frame.axial_strain, frame.time}, setup, state, world)) return;
    draw(std::move(frame), setup, state, world);
}

bool TestFiles::list_frame(const FrameEntry& entry, const TestSetup& setup, TestState& state, const World& world) {
    const auto later = std::lower_bound(state.frames.begin(), state.frames.end(), entry.row,
                                        [](const FrameEntry& one, std::int64_t row) { return one.row < row; });
    if (later != state.frames.end() && later->row == entry.row) return false;
    state.frames.insert(later, entry);
    if (!painter_ || !painter_->paints(world, setup)) {
        background_.wait();
        painter_.emplace(world, setup, options_.output.frame_precision);
    }
    collection_due_ = true;
    background_.make_room(world.bodies.size() <= most_bodies_of_several ? most_waiting : 0);
    return true;
}

void TestFiles::draw(Frame frame, const TestSetup& setup, const TestState& state, const World& world) {
    const bool collects = std::chrono::steady_clock::now() - collected_ >= collection_interval;
    const auto first = state.history.cracks.begin();
    const auto cracks = static_cast<std::ptrdiff_t>(frame.cracks);
    // Data that change while a frame is drawn are copied; only constant parts of the world are read.
    struct Job {
        Frame frame;
        std::vector<Crack> cracks;
        std::string collection;  // contents of frames.pvd, to be written after the frame; empty if written later
    };
    const auto job = std::make_shared<const Job>(
        Job{std::move(frame), {first, first + cracks}, collects ? due_collection(state) : ""});
    background_.add([this, job, &world, &setup] {
        const PlacedFrame placed(world, setup, job->frame);
        const FrameForces forces = find_forces(placed);
        folder_.write("frames/" + particles_file(job->frame.row),
                      [&](std::ostream& out) { painter_->write_particles(out, placed, forces); });
        folder_.write("frames/" + contacts_file(job->frame.row),
                      [&](std::ostream& out) { painter_->write_contacts(out, placed, forces, job->cracks); });
        folder_.write("frames/" + cracks_file(job->frame.row),
                      [&](std::ostream& out) { painter_->write_cracks(out, placed, job->cracks); });
        if (options_.jointed)
            folder_.write("frames/" + joints_file(job->frame.row),
                          [&](std::ostream& out) { painter_->write_joints(out, placed); });
        if (!job->collection.empty()) folder_.write("frames/frames.pvd", job->collection);
    });
}

std::string TestFiles::due_collection(const TestState& state) {
    std::vector<CollectionEntry> entries;
    for (const FrameEntry& frame : state.frames) {
        entries.push_back({frame.time, 0, particles_file(frame.row)});
        entries.push_back({frame.time, 1, contacts_file(frame.row)});
        entries.push_back({frame.time, 2, cracks_file(frame.row)});
        if (options_.jointed) entries.push_back({frame.time, 3, joints_file(frame.row)});
    }
    collection_due_ = false;
    collected_ = std::chrono::steady_clock::now();
    return pvd_text(entries);
}

void TestFiles::write_collection(const TestState& state) {
    background_.wait();
    if (collection_due_) folder_.write("frames/frames.pvd", due_collection(state));
}

void TestFiles::write_checkpoint(const TestSetup& setup, TestState& state, const World& world) {
    flush();
    write_collection(state);
    state.tables = marks();
    if (peak_on_disc_) state.peak_frame = peak_on_disc_->whole();
    folder_.write(
        "checkpoint", [&](std::ostream& out) { save_test(out, case_hash_, setup, state, world); }, Durable::yes);
    if (peak_on_disc_) state.peak_frame = {};
}

void TestFiles::flush() {
    background_.wait();
    for (auto& file : tables_)
        if (file) file->flush();
}

TableMarks TestFiles::marks() const {
    TableMarks marks;
    for (std::size_t k = 0; k < result_tables; ++k)
        if (tables_[k]) marks[k] = tables_[k]->mark();
    return marks;
}

void TestFiles::write_summary(Summary& summary, const TestState& state) {
    write_collection(state);
    crackle::write_summary(folder_, summary, named_marks(tables_of(options_), marks()));
}

void write_summary(const OutputFolder& folder, Summary& summary, FileMarks files) {
    const fs::path checkpoint = folder.path() / "checkpoint";
    if (is_there(checkpoint)) files.emplace_back("checkpoint", mark_of_file(checkpoint));
    state_files(summary, files);
    folder.write("summary.json", text_of(summary, 2) + '\n', Durable::yes);
}

}  // namespace crackle
