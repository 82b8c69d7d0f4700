// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/load_specimen.hpp"
#include "specimens/measures/trace_motion.hpp"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <span>

#include "solver/base/errors.hpp"
#include "solver/measure/health.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/emission/acoustic_event.hpp"
#include "specimens/loading/expected_run.hpp"
#include "specimens/observers/events.hpp"
#include "specimens/results/files.hpp"
#include "specimens/setup/lateral_control.hpp"
#include "specimens/setup/unloading.hpp"

namespace crackle {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t steps_between_health_checks = 100;
// Largest number of steps between checks of the clock and for interrupts. Small specimens are checked rarely, so the
// cost is negligible; specimens of a million bodies are checked after every step.
constexpr std::int64_t most_steps_between_clock_checks = 64, bodies_between_clock_checks = 1'000'000;
constexpr double seconds_between_progress = 0.2;
// Smallest number of rows from which peak, failure and moduli are determined. It applies even if fewer rows are
// written, because results must not depend on the number of written rows.
constexpr std::int64_t min_judged_rows = 2000;

std::int64_t judged_per_written(const VirtualTest& test) {
    return (min_judged_rows - 1) / test.description.output.curve_rows + 1;
}

class LoadingLoop {
  public:
    LoadingLoop(VirtualTest& test, const TestHooks& hooks, TestFiles* files)
        : test_(test),
          world_(test.world),
          setup_(test.setup),
          state_(test.state),
          listener_(test.world, test.setup, test.state.emission),
          hooks_(hooks),
          files_(files),
          max_strain_(test.description.loading.max_axial_strain),
          stress_unit_(test.description.stress_unit()),
          judged_per_written_(judged_per_written(test)),
          unload_rule_(
              unload_rule_of(test.description.loading.unloading, test.setup.rate_rule, test.state.youngs_modulus)),
          lateral_rule_(lateral_rule_of(test.description.loading, test.description.places, test.setup.rate_rule,
                                        test.state.poissons_ratio)),
          whole_travel_(max_strain_ + unload_rule_.added_travel(max_strain_)),
          row_spacing_(max_strain_ / static_cast<double>(test.description.output.curve_rows * judged_per_written_)),
          frame_spacing_(max_strain_ / static_cast<double>(test.description.output.frames.value())),
          checkpoint_interval_(test.description.output.checkpoint_interval),
          begun_(Clock::now()),
          last_checkpoint_(begun_),
          last_progress_(begun_),
          steps_between_clock_checks_(
              std::clamp(bodies_between_clock_checks / static_cast<std::int64_t>(test.world.bodies.size() + 1),
                         std::int64_t{1}, most_steps_between_clock_checks)),
          first_step_(test.world.stepping.steps),
          step_seconds_before_(test.state.step_seconds) {}

    void run() {
        try {
            load();
        } catch (const UnstableRun&) {
            record_events();  // records events of the failed step too
            write_emission(listener_.end_all());
            state_.step_seconds = step_seconds();
            throw;
        }
        if (!state_.ended_by.empty()) write_emission(listener_.end_all());
        state_.step_seconds = step_seconds();
    }

  private:
    void load() {
        if (files_ != nullptr && state_.rows.empty()) files_->write_checkpoint(setup_, state_, world_);
        while (true) {
            if (stop_asked_ || (world_.stepping.steps % steps_between_clock_checks_ == 0 && check_clock())) break;
            // The strain depends only on the current positions, so forces need not have been computed for them.
            strain_ = setup_.apparatus.axial_strain(world_);
            const double travel = state_.path.travel(strain_);
            const bool at_end = (lateral_rule_.on() ? travel : strain_) >= max_strain_;
            const bool row_due = at_end || travel >= row_spacing_ * static_cast<double>(state_.rows.size());
            const bool check_due = world_.stepping.steps % steps_between_health_checks == 0;
            const bool by_tolerance = setup_.rate_rule.tolerance > 0.0;
            const bool rate_due = by_tolerance && world_.stepping.time >= state_.rate.next_check;
            const bool look_due =
                hooks_.look && (hooks_.look_every > 0 ? world_.stepping.steps % hooks_.look_every == 0 : row_due);
            if (!row_due && !check_due && !rate_due && !look_due) {
                const double drift = world_.stepping.drift;
                step(world_);
                if (by_tolerance) watch_platens(drift);
                record_events();
                continue;
            }
            compute_forces(world_);
            record_events();
            if (row_due) record_row(at_end);
            if (look_due && state_.ended_by.empty()) look(row_due);
            const bool ended = !state_.ended_by.empty();
            // Stability is checked before the end is accepted: an unstable run must not count as finished.
            if (ended || check_due) check();
            if (ended) break;
            // The callback may have set the platen speed; the tolerance then no longer controls the loading rate.
            if (setup_.rate_rule.tolerance > 0.0) {
                watch_platens(world_.stepping.drift);
                if (rate_due) set_rate();
            }
            advance(world_);
        }
    }

    double step_seconds() const { return step_seconds_before_ + seconds(begun_, Clock::now()); }
    static double seconds(Clock::time_point from, Clock::time_point to) {
        return std::chrono::duration<double>(to - from).count();
    }

    void check() {
        const PhaseTimer timer(world_.workers.profile, Phase::check);
        check_health(world_);
    }

    /// Updates the inertia error from the last force computation.
    /// @param drift  time step that led to the current positions, s
    void watch_platens(double drift) {
        const PhaseTimer timer(world_.workers.profile, Phase::set_the_rate);
        const PartForces forces = forces_on_parts(world_, setup_.apparatus);
        watch_balance(state_.rate, setup_.rate_rule, forces.driver / setup_.apparatus.section,
                      -forces.supports / setup_.apparatus.section, drift);
    }

    /// Sets the speed of the platen according to the inertia error.
    void set_rate() {
        const PhaseTimer timer(world_.workers.profile, Phase::set_the_rate);
        const Ledger ledger = measure_ledger(world_);
        const double time = world_.stepping.time;
        LoadingPath& path = state_.path;
        choose_rate(state_.rate, setup_.rate_rule, path.speed, ledger.kinetic, ledger.strain, time);
        const double allowed = state_.rate.rate, since = time - path.chosen_at;
        path.chosen_at = time;
        if (unload_rule_.on())
            turn_by_list(path, unload_rule_, allowed, strain_, axial_stress(world_, setup_.apparatus), since);
        else if (lateral_rule_.on())
            follow_lateral(path, lateral_rule_, allowed, strain_,
                           setup_.gauges.median_lateral_strain(world_, setup_.bonds.start), since);
        else
            path.speed = allowed;
        const double speed = path.speed * setup_.apparatus.length;
        change_velocity(world_, setup_.apparatus.top, setup_.apparatus.axis,
                        setup_.apparatus.compression ? -speed : speed);
    }

    void record_events() {
        record_breaks();
        if (world_.bonds.slips.empty()) return;
        const PhaseTimer timer(world_.workers.profile, Phase::observe);
        if (files_ != nullptr)
            for (const SlipEvent& event : world_.bonds.slips)
                files_->add(ResultTable::slips, slip_line(event, strain_));
        world_.bonds.slips.clear();
    }

    void record_breaks() {
        const bool broke = world_.bonds.events.size() != events_counted_;
        if (listener_.must_listen(broke)) listen();
        if (!broke) return;
        const PhaseTimer timer(world_.workers.profile, Phase::observe);
        for (std::size_t k = events_counted_; k < world_.bonds.events.size(); ++k) {
            const BreakEvent& event = world_.bonds.events[k];
            ++(event.shear_mode ? state_.breaks_in_shear : state_.breaks_in_tension);
            state_.breaks_after_sliding += event.slid ? 1 : 0;
            note_break(setup_.bonds, event, state_.history);
            if (files_ != nullptr)
                files_->add_event(event, strain_, setup_.bonds.trace_of(state_.history.cracks.back().bond));
        }
        if (files_ != nullptr) {
            if (hooks_.look) unseen_.insert(unseen_.end(), world_.bonds.events.begin(), world_.bonds.events.end());
            world_.bonds.events.clear();
        }
        events_counted_ = world_.bonds.events.size();
    }

    void listen() {
        const PhaseTimer timer(world_.workers.profile, Phase::observe);
        write_emission(listener_.listen(std::span(world_.bonds.events).subspan(events_counted_), strain_));
    }

    /// Writes the acoustic events that have just ended. @param count  their number; they are the last events in the
    /// list
    void write_emission(std::size_t count) {
        if (files_ == nullptr) return;
        const std::vector<AcousticEvent>& events = state_.emission.events;
        for (std::size_t k = events.size() - count; k < events.size(); ++k)
            files_->add(ResultTable::ae, acoustic_line(events[k], state_.emission.rule.thickness));
    }

    void record_row(bool at_end) {
        const PhaseTimer timer(world_.workers.profile, Phase::observe);
        const auto index = static_cast<std::int64_t>(state_.rows.size());
        const CurveRow row = observe_row(world_, setup_);
        state_.rows.push_back(row);
        const double travel = state_.path.travel(row.axial_strain);
        // Rows at strains that were already reached before an unloading do not count for peak and failure.
        const bool farther = row.axial_strain > state_.path.farthest;
        if (farther) state_.path.farthest = row.axial_strain;
        const bool new_peak = (farther || lateral_rule_.on()) &&
                              state_.failure.update(index, row.axial_strain,
                                                    lateral_rule_.on() ? travel : row.axial_strain, row.axial_stress);
        if (new_peak) {
            state_.breaks_in_shear_to_peak = state_.breaks_in_shear;
            state_.breaks_in_tension_to_peak = state_.breaks_in_tension;
            if (!setup_.bonds.trace_faces.empty()) state_.faces_at_peak = places_of_faces(world_, setup_.bonds);
        }
        if (state_.failure.collapsed) {
            state_.ended_by = ended_by_failure;
        } else if (at_end) {
            state_.ended_by = ended_by_strain;
        }
        const bool loose = row.contacts_gained > 0 || !state_.history.loose.contacts.empty();
        if (loose) look_at_contacts(world_, state_.history);
        if (files_ == nullptr) return;
        const PhaseTimer writing(world_.workers.profile, Phase::write);
        if (index % judged_per_written_ == 0 || !state_.ended_by.empty()) files_->add_row(row);
        const bool frame_due = travel >= frame_spacing_ * static_cast<double>(state_.next_frame);
        // Skips frames whose strain has already been passed. The quotient is rounded, so the last frames are compared
        // exactly.
        const auto passed = static_cast<std::int64_t>(travel / frame_spacing_);
        state_.next_frame = std::max(state_.next_frame, passed - 1);
        while (travel >= frame_spacing_ * static_cast<double>(state_.next_frame)) ++state_.next_frame;
        if (new_peak) files_->keep_peak(row, index, setup_, state_, world_);
        if (frame_due || !state_.ended_by.empty()) files_->add_frame(row, index, setup_, state_, world_);
    }

    /// Calls the callback TestHooks::look. @param recorded  whether the last row already describes the current state
    void look(bool recorded) {
        if (files_ != nullptr) world_.bonds.events.swap(unseen_);  // the callback sees the events since its last call
        const AfterLook after = hooks_.look(test_);
        if (files_ != nullptr) {
            world_.bonds.events.clear();
            world_.bonds.events.swap(unseen_);
        }
        stop_asked_ = after == AfterLook::interrupt;
        if (after != AfterLook::end) return;
        state_.ended_by = ended_by_caller;
        if (!recorded) {
            record_row(false);
            return;
        }
        if (files_ == nullptr) return;
        const auto index = static_cast<std::int64_t>(state_.rows.size()) - 1;
        if (index % judged_per_written_ != 0) files_->add_row(state_.rows.back());
        files_->add_frame(state_.rows.back(), index, setup_, state_, world_);
    }

    /// Checks for an interrupt between steps, and reports progress and writes a checkpoint if they are due.
    /// @return whether the run is interrupted
    bool check_clock() {
        if (hooks_.interrupted && hooks_.interrupted()) return true;
        const Clock::time_point now = Clock::now();
        if (hooks_.progress && seconds(last_progress_, now) >= seconds_between_progress) {
            last_progress_ = now;
            report_progress(seconds(begun_, now));
        }
        if (files_ != nullptr && seconds(last_checkpoint_, now) >= checkpoint_interval_) {
            const PhaseTimer timer(world_.workers.profile, Phase::write);
            state_.step_seconds = step_seconds();
            files_->write_checkpoint(setup_, state_, world_);
            last_checkpoint_ = Clock::now();
        }
        return false;
    }

    void report_progress(double elapsed) const {
        TestProgress p;
        p.axial_strain = setup_.apparatus.axial_strain(world_);
        const double travel = state_.path.travel(p.axial_strain);
        p.share_done = travel / whole_travel_;
        p.axial_stress = state_.rows.empty() ? 0.0 : state_.rows.back().axial_stress;
        p.peak_stress = state_.failure.peak_stress;
        p.stress_unit = stress_unit_;
        p.bonds_broken = world_.bonds.broken;
        p.step = world_.stepping.steps;
        p.steps_per_second = static_cast<double>(world_.stepping.steps - first_step_) / elapsed;
        const double strain_per_step = travel / static_cast<double>(std::max<std::int64_t>(1, world_.stepping.steps));
        p.seconds_left = (whole_travel_ - travel) / (strain_per_step * p.steps_per_second);
        hooks_.progress(p);
    }

    VirtualTest& test_;
    World& world_;
    const TestSetup& setup_;
    TestState& state_;
    EmissionListener listener_;
    const TestHooks& hooks_;
    TestFiles* files_;
    double max_strain_;
    const char* stress_unit_;
    std::int64_t judged_per_written_;
    UnloadRule unload_rule_;
    LateralRule lateral_rule_;
    double whole_travel_;  // cumulative absolute strain of the whole test, including unloading
    double row_spacing_, frame_spacing_, checkpoint_interval_;
    Clock::time_point begun_, last_checkpoint_, last_progress_;
    std::int64_t steps_between_clock_checks_, first_step_;
    double step_seconds_before_;
    double strain_ = 0.0;  // axial strain at the last force computation
    std::size_t events_counted_ = 0;
    bool stop_asked_ = false;         // whether the callback has requested an interrupt
    std::vector<BreakEvent> unseen_;  // events not yet seen by the callback; used only if files are written
};

}  // namespace

void load_specimen(VirtualTest& test, const TestHooks& hooks, TestFiles* files) {
    if (test.state.rows.empty()) refuse_resting(test);
    // Returns to the operating system the memory that packing, meshing and bonding used: a third of all memory at
    // 200,000 discs.
    malloc_trim(0);
    LoadingLoop(test, hooks, files).run();
}

std::vector<CurveRow> written_rows(const VirtualTest& test) {
    const std::vector<CurveRow>& rows = test.state.rows;
    const auto every = static_cast<std::size_t>(judged_per_written(test));
    std::vector<CurveRow> written;
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (k % every == 0 || k + 1 == rows.size()) written.push_back(rows[k]);
    return written;
}

}  // namespace crackle
