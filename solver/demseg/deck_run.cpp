// SPDX-License-Identifier: GPL-3.0-or-later
// See deck_run.hpp.

#include "solver/demseg/deck_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <span>
#include <sstream>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/demseg/contact_files.hpp"
#include "solver/demseg/deck_folder.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/demseg/deck_state.hpp"
#include "solver/demseg/outputs.hpp"
#include "solver/demseg/random_circles.hpp"
#include "solver/files/file_set.hpp"
#include "solver/files/folder_lock.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "solver/measure/health.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"

namespace crackle {
namespace {

// Number of steps between checks of the run's state; one check costs about as much as a step.
constexpr std::int64_t health_interval = 100;
constexpr std::int64_t steps_between_clock_looks = 64;

template <typename Write>
std::string text_of(Write&& write) {
    std::ostringstream out;
    write(out);
    return std::move(out).str();
}

/// Whether the bodies of a world are those of the geometry, and include the bodies watched by the boundary conditions.
bool belongs_to(const DeckGeometry& geometry, const BoundaryConditions& boundary, const World& world) {
    std::unordered_map<int, std::uint32_t> elements_of;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyInfo info = world.bodies.info(b);
        elements_of.emplace(info.id, info.element_count);
    }
    const auto is_there = [&](int id) { return elements_of.contains(id); };
    return geometry.scene.bodies.size() == world.bodies.size() && elements_of.size() == world.bodies.size() &&
           std::ranges::all_of(geometry.scene.bodies,
                               [&](const Body& body) {
                                   return is_there(body.id) &&
                                          elements_of[body.id] == body.circle_count + body.vertex_count;
                               }) &&
           std::ranges::all_of(boundary.watched, is_there);
}

bool due(std::int64_t step, std::int64_t interval) { return step % interval == 0; }

}  // namespace

/// The deck's text files, indexed as deck_text_names.
struct DeckRun::Texts {
    DeckTexts contents;
    std::array<bool, 4> present{};
    std::array<std::string, 4> names;  // paths as the user would write them

    DeckReader reader(std::size_t which) const { return {names[which], contents[which]}; }
};

std::filesystem::path DeckRun::input(const std::string& name) const {
    return options_.folder / (options_.goes_on ? "new_" + name : name);
}

DeckRun::DeckRun(DeckOptions options) : options_(std::move(options)) {
    if (!std::filesystem::is_directory(options_.folder)) {
        throw InputError(fmt::format("{}: found no such folder, expected one with in_gm.dat and in_bc.dat",
                                     options_.folder.string()));
    }
    std::error_code same;
    if (std::filesystem::equivalent(options_.folder, options_.output, same)) options_.output.clear();
    if (options_.steps && *options_.steps < 1)
        throw InputError(fmt::format("steps: found {}, expected at least 1", *options_.steps));
    complete_earlier_run();
    if (appends()) lock_.emplace(options_.folder);
    std::optional<FolderLock> reading;  // held while reading, so that all files come from the same run
    if (options_.goes_on && !appends()) reading.emplace(options_.folder, Hold::to_read);
    Texts texts;
    for (std::size_t k = 0; k < texts.contents.size(); ++k) {
        const std::filesystem::path path = input(deck_text_names[k]);
        texts.names[k] = path.string();
        // in_gm.dat and in_bc.dat always count as present, so that reading them reports an error if they are missing.
        texts.present[k] = k < 2 || is_there(path);
        if (!texts.present[k]) continue;
        // The whole file is read, because the state file contains its hash.
        texts.contents[k] = read_file(path, most_bytes_of_particles);
        refuse_wide_letters(path, texts.contents[k]);
    }
    DeckReader reader = texts.reader(1);
    asked_ = read_boundary(reader);
    add_notices(reader);
    if (asked_.start != DeckStart::continued) {
        start_new(texts);
    } else if (!start_from_state(texts)) {
        start_from_contacts(texts);
    }
    if (options_.seed && !drawn_)
        throw InputError(
            fmt::format("seed: found a seed, but {} lists all bodies, so none of them is random; leave the seed out",
                        texts.names[0]));
    find_bodies();
    first_step_ = world_.stepping.steps;
    breaks_written_ = world_.bonds.events.size();
    last_step_ = first_step_ + options_.steps.value_or(asked_.steps);
    refuse_existing_outputs();
}

/// Handles a run in this folder that was interrupted while it replaced the files for the next part.
void DeckRun::complete_earlier_run() const {
    if (!complete_deck_replacement(options_.folder) || options_.goes_on) return;
    throw InputError(fmt::format(
        "{}: found new_*.dat files of a run that was stopped while it replaced them, expected a complete set; the set "
        "is complete now; if the deck's files are copies of new_*.dat, copy them again, and repeat the "
        "command",
        options_.folder.string()));
}

std::vector<std::filesystem::path> DeckRun::states() const {
    std::vector<std::filesystem::path> found;
    for (const char* name : {"in_state.bin", state_name}) {
        const bool asked_for = name == std::string_view(state_name) || !options_.goes_on;
        if (asked_for && is_there(options_.folder / name)) found.push_back(options_.folder / name);
    }
    return found;
}

template <class Choice>
Choice DeckRun::chosen(const char* option, std::optional<Choice> asked, std::optional<Choice> before,
                       const std::filesystem::path& state) {
    if (asked && before && *asked != *before) {
        throw InputError(
            fmt::format("--{}: found {}, expected {}, as recorded for the previous run in {}; leave out the option, or "
                        "remove that file to continue from the text files alone",
                        option, name_of(*asked), name_of(*before), state.string()));
    }
    const Choice choice = asked.value_or(before.value_or(Choice{}));
    if (choice == Choice{}) return choice;
    const std::string words = fmt::format("--{} {}", option, name_of(choice));
    notices_.push_back(asked ? fmt::format("{}: recorded in {}, so that a run continued from there needs no --{}",
                                           words, (output_folder() / state_name).string(), option)
                             : fmt::format("{}, as in the previous run according to {}", words, state.string()));
    return choice;
}

DeckLaws DeckRun::laws_for(const Texts& texts, std::optional<std::size_t> which) {
    std::optional<DeckLaws> before;
    std::filesystem::path state;
    for (const std::filesystem::path& path : states()) {
        if (!before && which) before = laws_of_deck_state(state = path, *which, texts.contents[*which]);
    }
    // For a new start, only the contact law is taken from the previous run; it is needed to identify points.
    const bool goes_on = asked_.start == DeckStart::continued;
    std::optional<SegmentLaw> law;
    std::optional<Integrator> integrator;
    if (before) law = before->law;
    if (before && goes_on) integrator = before->integrator;
    return {chosen("law", options_.law, law, state), chosen("integrator", options_.integrator, integrator, state)};
}

Scene DeckRun::scene_under(const DeckLaws& laws) const {
    Scene scene = base_.scene;
    apply_controls(boundary_, scene);
    scene.segment_law = laws.law;
    scene.integrator = laws.integrator;
    scene.allow_unstable = options_.allow_unstable;
    scene.threads = options_.threads;
    return scene;
}

void DeckRun::start_new(const Texts& texts) {
    DeckReader reader = texts.reader(0);
    if (read_geometry_mode(reader) == 0) {
        const std::uint64_t seed = options_.seed.value_or(1);
        drawn_ = true;
        base_ = make_random_circles(read_random_geometry(reader), seed);
        notices_.push_back(
            fmt::format("{}: {} random circles made with seed {}", texts.names[0], base_.scene.bodies.size(), seed));
    } else {
        base_ = read_deck_geometry(reader);
    }
    add_notices(reader);
    for (const std::string& notice : scene_notices(base_.scene))
        notices_.push_back(fmt::format("{}: {}", texts.names[0], notice));
    boundary_ = asked_;
    const bool has_tensions = asked_.start == DeckStart::bonded && texts.present[3];
    world_ = build_world(scene_under(laws_for(texts, has_tensions ? std::optional<std::size_t>(3) : std::nullopt)));
    if (asked_.start == DeckStart::bonded) {
        if (texts.present[3]) {
            DeckReader tensions = texts.reader(3);
            read_back_tensions(tensions, base_.scene, world_);
            add_notices(tensions);
        } else {
            bond_all(world_, world_.settings.thick);
            notices_.push_back(fmt::format("{}: not found, so {} bonds were made from the current overlaps",
                                           texts.names[3], world_.bonds.initial));
        }
    }
    enter_steps_before();  // an automatic time step is known only after bonds have been made
}

void DeckRun::start_from_contacts(const Texts& texts) {
    if (!texts.present[2]) {
        throw InputError(fmt::format(
            "{}: not found, expected it because jclid is 1; rename the last run's new_in_cf.dat, or set jclid to 0 for "
            "a new start",
            texts.names[2]));
    }
    DeckReader geometry = texts.reader(0), contacts = texts.reader(2);
    base_ = read_deck_geometry(geometry);
    add_notices(geometry);
    boundary_ = asked_;
    world_ = build_world(scene_under(laws_for(texts, 2)));
    read_contacts(contacts, base_.scene, world_);
    add_notices(contacts);
    enter_steps_before();
    world_.stepping.drift =
        world_.stepping.time_step;  // the bodies have just moved, so the first force pass adds the slip of that step
}

bool DeckRun::start_from_state(const Texts& texts) {
    for (const std::filesystem::path& path : states()) {
        std::vector<std::string> edited;
        std::optional<DeckState> state = load_deck_state(path, texts.contents, texts.present, edited);
        if (!state) {
            notices_.push_back(fmt::format("{}: ignored, because {} {} changed since this state was saved",
                                           path.string(), fmt::join(edited, ", "),
                                           edited.size() == 1 ? "has" : "have"));
            continue;
        }
        DeckReader geometry(path.string() + " (geometry)", state->base_geometry);
        DeckReader boundary(path.string() + " (boundary conditions)", state->base_boundary);
        base_ = read_deck_geometry(geometry);
        boundary_ = read_boundary(boundary);
        world_ = std::move(state->world);
        if (!belongs_to(base_, boundary_, world_))
            throw InputError(
                fmt::format("{}: found a state whose bodies differ from its geometry, expected one that "
                            "crackle wrote; remove it to continue from the text files",
                            path.string()));
        chosen<SegmentLaw>("law", options_.law, world_.settings.segment_law, path);
        chosen<Integrator>("integrator", options_.integrator, world_.settings.integrator, path);
        world_.stepping.allow_unstable = options_.allow_unstable;
        set_threads(world_, options_.threads);
        return true;
    }
    return false;
}

/// Adds a notice about numbers that were ignored in a file.
void DeckRun::add_notices(const DeckReader& reader) {
    if (const auto ignored = reader.ignored_numbers()) notices_.push_back(*ignored);
}

void DeckRun::enter_steps_before() {
    world_.stepping.steps = world_.list.built_at = boundary_.steps_before;
    world_.stepping.time = static_cast<double>(world_.stepping.steps) * world_.stepping.time_step;
    for (ControlState& control : world_.bodies.controls) control.first_step = world_.stepping.steps;
}

void DeckRun::find_bodies() {
    std::unordered_map<int, BodyIndex> index_of;
    for (std::size_t b = 0; b < world_.bodies.size(); ++b)
        index_of[world_.bodies.info(b).id] = static_cast<BodyIndex>(b);
    for (const Body& body : base_.scene.bodies) order_.push_back(index_of.at(body.id));
    for (const int id : boundary_.watched) watched_.push_back(index_of.at(id));
    velocity_ = watched_;
    if (velocity_.empty()) velocity_.push_back(order_.front());
}

void DeckRun::refuse_existing_outputs() const {
    if (appends()) return;
    const std::optional<std::filesystem::path> earlier = earlier_output(output_folder());
    if (!earlier) {
        refuse_foreign_folder();
        return;
    }
    if (options_.overwrite) {
        refuse_foreign_outputs(output_folder());
        return;
    }
    const bool can_go_on = is_there(output_folder() / (std::string("new_") + deck_text_names[0]));
    throw InputError(
        fmt::format("{}: found the output of an earlier run{}, expected a folder without outputs; choose another "
                    "folder with -o, {}replace the output with --force",
                    earlier->string(), can_go_on ? "" : " that stopped before it wrote the files needed to continue it",
                    can_go_on ? "continue that run with --continue, or " : "or "));
}

void DeckRun::refuse_foreign_folder() const {
    if (options_.output.empty()) return;
    refuse_foreign_files(options_.output,
                         "a new or empty folder, or the output folder of an earlier run; choose another with -o");
}

bool DeckRun::rows_due() const {
    const std::int64_t step = world_.stepping.steps;
    return step == first_step_ || step == 1 || due(step, asked_.output_interval) || due(step, asked_.row_interval);
}

void DeckRun::write_rows(DeckOutputs& outputs) const {
    const std::int64_t step = world_.stepping.steps;
    const bool beginning = step == first_step_;
    if (beginning || due(step, asked_.output_interval)) outputs.write_frame(world_, order_);
    const bool row = due(step, asked_.row_interval);
    if (beginning || row) {
        outputs.write_energy_row(world_, velocity_);
        outputs.write_bond_row(world_);
    }
    if (!beginning && (row || step == 1)) outputs.write_force_rows(world_, watched_);
}

void DeckRun::write_breaks(DeckOutputs& outputs) {
    const std::span<const BreakEvent> found = std::span(world_.bonds.events).subspan(breaks_written_);
    if (found.empty()) return;
    // The first force pass of this part finds the breaks of the previous part's last step again. The previous part has
    // already written them.
    const auto ours = [&](const BreakEvent& event) { return first_part() || event.step > first_step_; };
    outputs.write_breaks(world_,
                         found.subspan(static_cast<std::size_t>(std::ranges::find_if(found, ours) - found.begin())));
    breaks_written_ = world_.bonds.events.size();
}

void DeckRun::run(const std::function<bool(const World&)>& go_on) {
    make_folder(output_folder());
    const FolderLock lock = lock_ ? *std::exchange(lock_, std::nullopt) : FolderLock(output_folder());
    complete_replacement(deck_journal(output_folder()));  // completes an interrupted run that this run replaces
    refuse_existing_outputs();  // checked again, since another run may have written here in the meantime
    remove_staged_files(output_folder());
    if (appends()) drop_rows_after(output_folder(), first_step_);
    const bool replaces = !appends() && earlier_output(output_folder());
    DeckOutputs outputs(output_folder(), mode(), replaces ? OutputNames::staged : OutputNames::own);
    try {
        step_to_end(outputs, go_on);
    } catch (const UnstableRun& error) {
        if (outputs.renames().empty()) throw;
        throw UnstableRun(
            error,
            fmt::format("earlier outputs in {0} are unchanged, and the outputs of this run so far are in {0}/*.dat{1}",
                        output_folder().string(), staged_suffix));
    } catch (const OutputError& error) {
        if (counts_as_done(outputs)) throw;
        throw OutputError(fmt::format("{}; {}", error.what(), fate_of_earlier_outputs()));
    } catch (const SystemFailure& error) {
        if (counts_as_done(outputs)) throw;
        throw SystemFailure(error, fate_of_earlier_outputs());
    }
}

bool DeckRun::counts_as_done(const DeckOutputs& outputs) const {
    return outputs.renames().empty() || is_there(deck_journal(output_folder()));
}

std::string DeckRun::fate_of_earlier_outputs() const {
    std::string left;
    try {
        remove_staged_files(output_folder());
    } catch (const std::runtime_error& cannot) {
        left = fmt::format("; {}", cannot.what());  // the next run removes the remaining files
    }
    return fmt::format("earlier outputs in {} are unchanged{}", output_folder().string(), left);
}

OutputMode DeckRun::mode() const {
    if (appends()) return OutputMode::appending;
    return first_part() ? OutputMode::fresh : OutputMode::part;
}

void DeckRun::step_to_end(DeckOutputs& outputs, const std::function<bool(const World&)>& go_on) {
    using Clock = std::chrono::steady_clock;
    Clock::time_point saved = Clock::now();
    while (world_.stepping.steps < last_step_ && (!go_on || go_on(world_))) {
        const bool clock_due = due(world_.stepping.steps, steps_between_clock_looks);
        if (!clock_due || std::chrono::duration<double>(Clock::now() - saved).count() < options_.save_interval) {
            do_step(outputs);
            continue;
        }
        const FileSet files = files_for_next();
        do_step(outputs);  // writes this step's row, which the files for the next part assume to exist
        save(files, outputs);
        saved = Clock::now();
    }
    const auto files = files_for_next();
    compute_forces(world_);
    check_health(world_);
    if (first_part() || world_.stepping.steps > first_step_) write_rows(outputs);
    write_breaks(outputs);
    save(files, outputs);
}

void DeckRun::save(const FileSet& files, DeckOutputs& outputs) const {
    // Outputs are flushed before the journal is written, because a run that continues from the files assumes that
    // earlier rows have been written.
    outputs.flush();
    write_journal(deck_journal(output_folder()), files, outputs.renames());
    outputs.have_own_names();  // from here on, any process that reads the folder or runs in it completes the renaming
    complete_replacement(deck_journal(output_folder()));
}

void DeckRun::do_step(DeckOutputs& outputs) {
    const bool check_due = due(world_.stepping.steps, health_interval);
    if (!check_due && !rows_due()) {
        step(world_);
    } else {
        compute_forces(world_);
        if (check_due) check_health(world_);
        if (first_part() || world_.stepping.steps > first_step_)
            write_rows(outputs);  // the previous part has written the row of its last step
        advance(world_);
    }
    write_breaks(outputs);
}

Scene DeckRun::present_scene() const {
    Scene scene = base_.scene;
    // The automatic step in use is written, since computing it again from this state might give a different value.
    scene.time_step = world_.stepping.time_step;
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        Body& body = scene.bodies[k];
        const BodyState& state = world_.bodies.state[order_[k]];
        body.velocity = {state.vx, state.vy};
        body.spin = state.omega;
        const std::vector<Vec2> positions = element_positions(world_, order_[k]);
        const double turn = body.circle_count > 0 ? state.angle - scene.circles[body.first_circle].angle : 0.0;
        for (std::uint32_t e = 0; e < body.circle_count; ++e) {
            CircleElement& circle = scene.circles[body.first_circle + e];
            circle.centre = positions[e];
            circle.angle = e == 0 ? state.angle : circle.angle + turn;
        }
        for (std::uint32_t v = 0; v < body.vertex_count; ++v) scene.vertices[body.first_vertex + v] = positions[v];
    }
    return scene;
}

BoundaryConditions DeckRun::boundary_for_next() const {
    const bool over = finished();
    const std::int64_t left =
        over ? boundary_.steps : boundary_.steps - (world_.stepping.steps - boundary_.steps_before);
    BoundaryConditions next = boundary_;
    next.start = DeckStart::continued;
    next.steps_before = world_.stepping.steps;
    next.steps = left;
    for (BodyControl& control : next.controls) {
        for (DofControl* dof : {&control.x, &control.y, &control.rotation}) {
            if (dof->drive != Drive::displacement) continue;
            dof->value = over ? 0.0 : dof->value * static_cast<double>(left) / static_cast<double>(boundary_.steps);
        }
    }
    return next;
}

FileSet DeckRun::files_for_next() const {
    const BoundaryConditions next = boundary_for_next();
    const DeckTexts texts{
        text_of([&](std::ostream& out) { write_geometry(out, present_scene(), base_.large_segments); }),
        text_of([&](std::ostream& out) { write_boundary(out, next); }),
        text_of([&](std::ostream& out) { write_contacts(out, base_.scene, world_); }),
        text_of([&](std::ostream& out) { write_back_tensions(out, base_.scene, world_); }),
    };
    DeckState state;
    state.world = world_;
    state.base_geometry = text_of([&](std::ostream& out) { write_geometry(out, base_.scene, base_.large_segments); });
    state.base_boundary = text_of([&](std::ostream& out) { write_boundary(out, finished() ? next : boundary_); });
    FileSet files;
    for (std::size_t k = 0; k < texts.size(); ++k)
        files.emplace_back(std::string("new_") + deck_text_names[k], texts[k]);
    files.emplace_back(state_name, save_deck_state(state, texts));
    return files;
}

}  // namespace crackle
