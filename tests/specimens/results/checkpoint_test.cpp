// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a checkpoint with correct hashes but invalid numbers: every index must be checked before it is used.

#include "specimens/results/checkpoint.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <limits>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::ScratchFolder;
using testing::SmallCase;
using testing::write_small_case;

/// Sets one integer or enumerator to a value far out of range. In a vector, it can be the first or the last element.
class FarNumber {
  public:
    /// @param which index of the item to change, in the order of visiting, from 0
    explicit FarNumber(int which) : left_(which) {}

    /// Name of the changed item, such as "bonds.pairs[].body_i"; empty if there are not that many items.
    const std::string& changed() const { return changed_; }

    template <class T>
    void walk(T& value, const std::string& name) {
        if constexpr (HasFields<T>) {
            T::fields(value, [&](const char* field, auto& member, const auto&... /*more*/) {
                walk(member, name.empty() ? field : name + "." + field);
            });
        } else if constexpr (std::is_enum_v<T>) {
            if (chosen(name)) value = static_cast<T>(std::numeric_limits<std::underlying_type_t<T>>::max());
        } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
            if (chosen(name)) value = std::numeric_limits<T>::max() - 2;  // the two largest values may mean «none»
        }
    }
    template <class T, class Room>
    void walk(std::vector<T, Room>& values, const std::string& name) {
        if (!values.empty()) walk(values.front(), name + "[]");
        if (values.size() > 1) walk(values.back(), name + "[]");
    }
    template <class T, std::size_t N>
    void walk(std::array<T, N>& values, const std::string& name) {
        for (T& value : values) walk(value, name + "[]");
    }
    template <class T, std::size_t N>
    void walk(T (&values)[N], const std::string& name) {
        for (T& value : values) walk(value, name + "[]");
    }
    template <class T>
    void walk(std::optional<T>& value, const std::string& name) {
        if (value) walk(*value, name);
    }
    template <class A, class B>
    void walk(std::pair<A, B>& both, const std::string& name) {
        walk(both.first, name + ".first");
        walk(both.second, name + ".second");
    }
    void walk(std::string& /*text*/, const std::string& /*name*/) {}

  private:
    bool chosen(const std::string& name) {
        if (left_-- != 0) return false;
        changed_ = name;
        return true;
    }

    int left_;
    std::string changed_;
};

/// Integers that are counts, ids or codes, not indices; also `left_end` of an absent membrane.
const std::set<std::string> no_index{"account.blocks[].broken",
                                     "account.blocks[].gained",
                                     "bodies.controls[].first_step",
                                     "bodies.controls[].ramp_steps",
                                     "bodies.names[].id",
                                     "bonds.broken",
                                     "bonds.broken_after_sliding",
                                     "bonds.held",
                                     "bonds.initial",
                                     "bonds.interfaces_initial",
                                     "bonds.interfaces_lost",
                                     "list.builds",
                                     "list.built_at",
                                     "membrane.left_end",
                                     "membrane.list_builds",
                                     "membrane.open",
                                     "membrane.wrapped",
                                     "points.state[].flags",
                                     "setup.apparatus.bottom_id",
                                     "setup.origin.centres",
                                     "setup.bonds.contacts_initial",
                                     "setup.origin.segments",
                                     "setup.apparatus.top_id",
                                     "setup.bonds.trace_faces[].bonds",
                                     "state.breaks_after_sliding",
                                     "state.breaks_in_shear",
                                     "state.breaks_in_shear_to_peak",
                                     "state.breaks_in_tension",
                                     "state.breaks_in_tension_to_peak",
                                     "state.emission.events[].breaks",
                                     "state.emission.events[].breaks_in_shear",
                                     "state.emission.open[].event.breaks",
                                     "state.emission.open[].event.breaks_in_shear",
                                     "state.next_frame",
                                     "state.path.unloaded",
                                     "state.rows[].bonds_broken",
                                     "state.rows[].bonds_slid",
                                     "state.rows[].contacts_gained",
                                     "state.rows[].interfaces_lost",
                                     "state.rows[].points_sliding",
                                     "state.rows[].step",
                                     "state.tables[].bytes",
                                     "state.tables[].hash",
                                     "stepping.weighed_points"};

class Checkpoints : public ::testing::Test {
  protected:
    /// A test that was interrupted after its first breaks.
    std::string checkpoint_of(const SmallCase& wanted) const {
        TestOptions options;
        options.folder = scratch_ / "out";
        TestHooks hooks;
        hooks.look = [](const VirtualTest& test) {
            return test.world.bonds.broken > 5 ? AfterLook::interrupt : AfterLook::go_on;
        };
        EXPECT_TRUE(run_test(read_case(write_small_case(scratch_ / "", wanted)), options, hooks).interrupted);
        std::ifstream in(scratch_ / "out" / "checkpoint", std::ios::binary);
        std::ostringstream bytes;
        bytes << in.rdbuf();
        return std::move(bytes).str();
    }

    static TestCheckpoint read(const std::string& bytes) {
        std::istringstream in(bytes);
        return load_test(in, "checkpoint");
    }
    static std::string written(const TestCheckpoint& whole) {
        std::ostringstream out;
        save_test(out, whole.case_hash, whole.setup, whole.state, whole.world);
        return std::move(out).str();
    }

    void expect_far_numbers_refused(const SmallCase& wanted) const {
        const std::string bytes = checkpoint_of(wanted);
        ASSERT_EQ(written(read(bytes)), bytes);
        std::set<std::string> refused, read_all_the_same;
        for (int which = 0;; ++which) {
            TestCheckpoint changed = read(bytes);
            FarNumber far(which);
            far.walk(changed.setup, "setup");
            far.walk(changed.state, "state");
            World::groups(changed.world, [&](const std::string& name, auto& group) { far.walk(group, name); });
            if (far.changed().empty()) break;
            try {
                read(written(changed));
                read_all_the_same.insert(far.changed());
            } catch (const InputError& error) {
                EXPECT_NE(std::string(error.what()).find("found parts that do not belong together"), std::string::npos)
                    << error.what();
                refused.insert(far.changed());
            }
        }
        fmt::print("  {} fields, {} refused\n", refused.size() + read_all_the_same.size(), refused.size());
        for (const std::string& name : read_all_the_same)
            EXPECT_TRUE(no_index.contains(name)) << name << " is believed";
    }

    ScratchFolder scratch_;
};

TEST_F(Checkpoints, NoNumberBeyondItsArrayIsBelieved) {
    SmallCase circles;
    circles.output += "\nslips = true\nemission = true";
    expect_far_numbers_refused(circles);
}

TEST_F(Checkpoints, BondsOfTheWorldAreThoseOfTheStart) {
    TestCheckpoint changed = read(checkpoint_of({}));
    std::swap(changed.setup.bonds.points.pairs[0], changed.setup.bonds.points.pairs[1]);
    EXPECT_THROW(read(written(changed)), InputError) << "their order is broken";
    std::swap(changed.setup.bonds.points.pairs[0], changed.setup.bonds.points.pairs[1]);
    changed.setup.bonds.points.pairs.erase(changed.setup.bonds.points.pairs.begin());
    changed.setup.bonds.overlaps.pop_back();
    for (PointIndex& begin : changed.setup.bonds.kind_begin) begin -= begin > 0 ? 1 : 0;
    for (Crack& crack : changed.state.history.cracks) crack.bond = 0;
    changed.state.peak_frame = {};
    EXPECT_THROW(read(written(changed)), InputError) << "one is missing";
}

TEST_F(Checkpoints, NoNumberBeyondItsArrayIsBelievedOfCellsAlongATrace) {
    SmallCase cells;
    cells.kind = "compression";
    cells.mesh = "voronoi";
    cells.rate = 0.1;
    cells.max_strain = 0.015;
    cells.material =
        "units = \"area\"\ncontact_modulus = 1e7\nstiffness_ratio = 2.5\ntensile_strength = 1.5e4\ncohesion = 5e4\n"
        "residual_friction_angle = 20.0";
    cells.bond = "law = \"coulomb\"";
    cells.minerals = "[[trace]]\npoints = [0.0, 0.1, 0.2355, 0.32]\nfriction_angle = 20.0\ncohesion = 1e4\n";
    expect_far_numbers_refused(cells);
}

}  // namespace
}  // namespace crackle
