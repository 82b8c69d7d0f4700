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
#include "specimens/loading/expected_run.hpp"
#include "specimens/results/files.hpp"
#include "specimens/setup/lateral_control.hpp"
#include "specimens/setup/unloading.hpp"

namespace crackle {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t steps_between_health_checks = 100;
constexpr std::int64_t steps_between_clock_checks =
    64;  // reading the clock and asking for interrupts stay off the profile
constexpr double seconds_between_progress = 0.2;
// Fewest rows that peak, failure and moduli are found from, however few of them are written: what is reported must
// not depend on how much of it is looked at.
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
          unload_rule_(unload_rule_of(test.description.loading, test.setup.rate_rule, test.state.youngs_modulus)),
          lateral_rule_(lateral_rule_of(test.description, test.setup.rate_rule, test.state.poissons_ratio)),
          whole_travel_(max_strain_ + unload_rule_.added_travel(max_strain_)),
          row_spacing_(max_strain_ / static_cast<double>(test.description.output.curve_rows * judged_per_written_)),
          frame_spacing_(max_strain_ / static_cast<double>(test.description.output.frames.value())),
          checkpoint_interval_(test.description.output.checkpoint_interval),
          begun_(Clock::now()),
          last_checkpoint_(begun_),
          last_progress_(begun_),
          first_step_(test.world.stepping.steps),
          step_seconds_before_(test.state.step_seconds) {}

    void run() {
        try {
            load();
        } catch (const UnstableRun&) {
            record_events();  // of the step that went wrong
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
            if (stop_asked_ || (world_.stepping.steps % steps_between_clock_checks == 0 && check_clock())) break;
            // Platens stand where the last step has put them, whether the forces are known or not.
            strain_ = setup_.axial_strain(world_);
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
            // An end that instability brought about is none.
            if (ended || check_due) check();
            if (ended) break;
            // A look may have ended loading by tolerance.
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

    /// The inertia error of the last force pass. @param drift s, that led to its positions
    void watch_platens(double drift) {
        const PhaseTimer timer(world_.workers.profile, Phase::set_the_rate);
        const PartForces forces = forces_on_parts(world_, setup_);
        watch_balance(state_.rate, setup_.rate_rule, forces.driver / setup_.section, -forces.supports / setup_.section,
                      drift);
    }

    /// The platen's speed by the inertia error.
    void set_rate() {
        const PhaseTimer timer(world_.workers.profile, Phase::set_the_rate);
        const Ledger ledger = measure_ledger(world_);
        const double time = world_.stepping.time;
        LoadingPath& path = state_.path;
        choose_rate(state_.rate, setup_.rate_rule, path.speed, ledger.kinetic, ledger.strain, time);
        const double allowed = state_.rate.rate, since = time - path.chosen_at;
        path.chosen_at = time;
        if (unload_rule_.on())
            turn_by_list(path, unload_rule_, allowed, strain_, axial_stress(world_, setup_), since);
        else if (lateral_rule_.on())
            follow_lateral(path, lateral_rule_, allowed, strain_, setup_.median_lateral_strain(world_), since);
        else
            path.speed = allowed;
        const double speed = path.speed * setup_.length;
        change_velocity(world_, setup_.top, setup_.axis, setup_.compression ? -speed : speed);
    }

    void record_events() {
        record_breaks();
        if (world_.bonds.slips.empty()) return;
        const PhaseTimer timer(world_.workers.profile, Phase::observe);
        if (files_ != nullptr)
            for (const SlipEvent& event : world_.bonds.slips) files_->add_slip(event, strain_);
        world_.bonds.slips.clear();
    }

    void record_breaks() {
        const bool broke = world_.bonds.events.size() != events_counted_;
        if (listener_.hears(broke)) listen();
        if (!broke) return;
        const PhaseTimer timer(world_.workers.profile, Phase::observe);
        for (std::size_t k = events_counted_; k < world_.bonds.events.size(); ++k) {
            const BreakEvent& event = world_.bonds.events[k];
            ++(event.shear_mode ? state_.breaks_in_shear : state_.breaks_in_tension);
            state_.breaks_after_sliding += event.slid ? 1 : 0;
            note_break(setup_, event, state_.history);
            if (files_ != nullptr)
                files_->add_event(event, strain_, setup_.trace_of(state_.history.cracks.back().bond));
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

    /// @param count of the last events that ended
    void write_emission(std::size_t count) {
        if (files_ == nullptr) return;
        const std::vector<AcousticEvent>& events = state_.emission.events;
        for (std::size_t k = events.size() - count; k < events.size(); ++k)
            files_->add_emission(events[k], state_.emission.rule.thickness);
    }

    void record_row(bool at_end) {
        const PhaseTimer timer(world_.workers.profile, Phase::observe);
        const auto index = static_cast<std::int64_t>(state_.rows.size());
        const CurveRow row = observe_row(world_, setup_);
        state_.rows.push_back(row);
        const double travel = state_.path.travel(row.axial_strain);
        // What is gone through once more, being unloaded and loaded again, says nothing of peak and failure.
        const bool farther = row.axial_strain > state_.path.farthest;
        if (farther) state_.path.farthest = row.axial_strain;
        const bool new_peak = (farther || lateral_rule_.on()) &&
                              state_.failure.update(index, row.axial_strain,
                                                    lateral_rule_.on() ? travel : row.axial_strain, row.axial_stress);
        if (new_peak) {
            state_.breaks_in_shear_to_peak = state_.breaks_in_shear;
            state_.breaks_in_tension_to_peak = state_.breaks_in_tension;
            if (!setup_.trace_faces.empty()) state_.faces_at_peak = places_of_faces(world_, setup_);
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
        // In one go over those that a step passes, and exactly over the last.
        const auto passed = static_cast<std::int64_t>(travel / frame_spacing_);
        state_.next_frame = std::max(state_.next_frame, passed - 1);
        while (travel >= frame_spacing_ * static_cast<double>(state_.next_frame)) ++state_.next_frame;
        if (new_peak) files_->keep_peak(row, index, setup_, state_, world_);
        if (frame_due || !state_.ended_by.empty()) files_->add_frame(row, index, setup_, state_, world_);
    }

    /// @param recorded whether the moment is the last row already
    void look(bool recorded) {
        if (files_ != nullptr) world_.bonds.events.swap(unseen_);  // those since the last look
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

    /// Between steps: progress, checkpoint, interrupt. @return whether to stop
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
        p.axial_strain = setup_.axial_strain(world_);
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
    double whole_travel_;  // strain
    double row_spacing_, frame_spacing_, checkpoint_interval_;
    Clock::time_point begun_, last_checkpoint_, last_progress_;
    std::int64_t first_step_;
    double step_seconds_before_;
    double strain_ = 0.0;  // axial, of the last force pass
    std::size_t events_counted_ = 0;
    bool stop_asked_ = false;         // by a look
    std::vector<BreakEvent> unseen_;  // by looks, of a test with files
};

}  // namespace

void load_specimen(VirtualTest& test, const TestHooks& hooks, TestFiles* files) {
    if (test.state.rows.empty()) refuse_resting(test);
    malloc_trim(0);  // what packing, meshing and bonding needed: a third of all there is at 200,000 discs
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
