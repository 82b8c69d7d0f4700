// SPDX-License-Identifier: GPL-3.0-or-later
// Where the time of a run goes, by phase of a step. A world without a profile pays one test of a pointer a phase.
// Tested by tests/tools/commands/test_test.cpp.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace crackle {

enum class Phase : std::uint8_t {
    broad_phase,   // pairs of bodies that come near each other
    listing,       // their contact points, with what the old list remembers of them
    step_bound,    // bound on the stable step, when the list is rebuilt or points come to carry load
    force,         // contact points: geometry (the narrow phase) and force; a call is a block of points
    gather,        // forces of a block's points added to their bodies
    bookkeeping,   // breaks, losses, driven bodies
    integrate,     // kick and drift
    observe,       // curve rows, breaks, peak
    write,         // files: rows, checkpoints, waiting for frames that another thread draws
    check,         // health of the run
    set_the_rate,  // loading by tolerance
};
inline constexpr std::size_t phase_count = 11;

struct Profile {
    using Clock = std::chrono::steady_clock;
    struct Spent {
        double seconds = 0.0;  // wall clock, without the phases inside
        std::int64_t calls = 0;
    };
    std::array<Spent, phase_count> phases{};
    /// Geometry of all points alone, timed in one force pass of geometry_interval: the narrow phase's part of `force`.
    Spent geometry_sampled;
    std::int64_t force_passes = 0;
    std::int64_t point_steps = 0;  // points looked at by all of them

    Spent& of(Phase phase) { return phases[static_cast<std::size_t>(phase)]; }
    const Spent& of(Phase phase) const { return phases[static_cast<std::size_t>(phase)]; }

    Spent* running = nullptr;  // innermost phase
    Clock::time_point since;   // of its last start
};
inline constexpr std::int64_t geometry_interval = 64;

/// Counts the time of its scope, less that of timers within; none where there is no profile.
class PhaseTimer {
  public:
    PhaseTimer(Profile* profile, Phase phase)
        : PhaseTimer(profile, profile == nullptr ? nullptr : &profile->of(phase)) {}
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
