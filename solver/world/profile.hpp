// SPDX-License-Identifier: GPL-3.0-or-later
// Time spent in each phase of a step. Without a profile, the timing code only tests one pointer per phase.
// Tested by tests/tools/commands/test_test.cpp.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace crackle {

/// Phases of a step that are timed.
enum class Phase : std::uint8_t {
    broad_phase,   // finding pairs of bodies that are close to each other
    listing,       // listing contact points and carrying over values from the old list
    step_bound,    // bounding the stable step, when the list is rebuilt or new points carry load
    force,         // geometry (narrow phase) and forces of contact points; one call per block of points
    gather,        // adding the forces of a block's points to the forces on bodies
    bookkeeping,   // recording bond breakage, losses and the work of driven bodies
    integrate,     // kick and drift
    observe,       // recording curve rows, bond breakage and the peak
    write,         // writing files (rows, checkpoints) and waiting for frames drawn by another thread
    check,         // checking the validity of the run
    set_the_rate,  // adapting the loading rate to its error tolerance
};
inline constexpr std::size_t phase_count = 11;

/// Time spent in each phase, and number of calls.
struct Profile {
    using Clock = std::chrono::steady_clock;
    /// Time and number of calls of a phase.
    struct Spent {
        double seconds = 0.0;  // wall-clock time, excluding nested phases
        std::int64_t calls = 0;
    };
    std::array<Spent, phase_count> phases{};
    /// Time for the geometry (narrow phase) of all points, measured separately in one of every geometry_interval force
    /// passes. It serves to estimate how much of `force` the narrow phase takes.
    Spent geometry_sampled;
    std::int64_t force_passes = 0;
    std::int64_t point_steps = 0;  // number of points processed, summed over all steps

    /// Time and calls of a phase, to which more can be added.
    Spent& of(Phase phase) { return phases[static_cast<std::size_t>(phase)]; }
    /// Time and calls of a phase.
    const Spent& of(Phase phase) const { return phases[static_cast<std::size_t>(phase)]; }

    Spent* running = nullptr;  // innermost phase currently being timed
    Clock::time_point since;   // start of the current interval of `running`
};
inline constexpr std::int64_t geometry_interval = 64;

/// Adds the duration of its scope, without nested timers, to a phase. Does nothing without a profile.
class PhaseTimer {
  public:
    /// Times a phase until the end of the scope. @param profile the profile; if null, nothing is timed
    PhaseTimer(Profile* profile, Phase phase)
        : PhaseTimer(profile, profile == nullptr ? nullptr : &profile->of(phase)) {}
    /// Times a phase, but adds its duration to a separate record.
    PhaseTimer(Profile* profile, Profile::Spent* spent) : profile_(profile), spent_(spent) {
        if (profile_ == nullptr) return;
        outer_ = profile_->running;
        turn_to(spent_);
    }
    PhaseTimer(const PhaseTimer&) = delete;
    PhaseTimer& operator=(const PhaseTimer&) = delete;
    ~PhaseTimer() {
        if (profile_ == nullptr) return;
        turn_to(outer_);
        ++spent_->calls;
    }

  private:
    void turn_to(Profile::Spent* next) {
        const Profile::Clock::time_point now = Profile::Clock::now();
        if (profile_->running != nullptr)
            profile_->running->seconds += std::chrono::duration<double>(now - profile_->since).count();
        profile_->running = next;
        profile_->since = now;
    }

    Profile* profile_;
    Profile::Spent* spent_;
    Profile::Spent* outer_ = nullptr;
};

}  // namespace crackle
