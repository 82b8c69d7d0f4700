// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/joint_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/case/joint_keys.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/statistics/spoken.hpp"

namespace crackle {
namespace {

/// The keys that one choice of a distribution law requires, and further keys that it allows.
template <class Choice>
struct LawKeys {
    Choice choice;
    std::vector<const char*> needed, allowed;
};

const std::vector<LawKeys<JointOrientation>>& orientation_laws() {
    using enum JointOrientation;
    static const std::vector<LawKeys<JointOrientation>> all{{fixed, {"angle"}, {}},
                                                            {uniform, {"angle", "angle_deviation"}, {}},
                                                            {von_mises, {"angle", "kappa"}, {}},
                                                            {fisher, {"dip", "dip_direction", "fisher_k"}, {}}};
    return all;
}
const std::vector<LawKeys<JointLength>>& length_laws() {
    using enum JointLength;
    static const std::vector<LawKeys<JointLength>> all{
        {persistent, {}, {}},
        {gaps, {"length_mean", "gap_mean"}, {"length_deviation", "gap_deviation"}},
        {fixed, {"length_mean"}, {}},
        {uniform, {"length_mean", "length_deviation"}, {}},
        {lognormal, {"length_mean", "length_deviation"}, {}},
        {exponential, {"length_mean"}, {}},
        {power_law, {"length_min", "length_max", "length_exponent"}, {}}};
    return all;
}
const std::vector<LawKeys<JointSpacing>>& spacing_laws() {
    using enum JointSpacing;
    static const std::vector<LawKeys<JointSpacing>> all{{fixed, {}, {}},
                                                        {uniform, {"spacing_deviation"}, {}},
                                                        {exponential, {}, {}},
                                                        {lognormal, {"spacing_deviation"}, {}}};
    return all;
}

constexpr std::initializer_list<const char*> amounts{"number", "p10", "p20", "p21", "spacing"};

class JointCheck {
  public:
    explicit JointCheck(const TestCase& test) : test_(test) {}

    void run() const {
        if (test_.has_table("joints") && !test_.jointed())
            refuse("joints", "no [[joint_set]] or [[trace]]", "at least one", "add one, or remove this table");
        names();
        bool fisher = false;
        for (std::size_t k = 0; k < test_.joint_set.size(); ++k) {
            set(k);
            fisher = fisher || test_.joint_set[k].orientation == JointOrientation::fisher;
        }
        if (fisher && !written("joints.section_trend"))
            refuse("joints.section_trend", "nothing", find_parameter("joints", "section_trend")->expected(),
                   "the direction of the section must be known to find where planes intersect it");
        if (!fisher && written("joints.section_trend"))
            throw key_needs(test_, "joints.section_trend", "a set with orientation = \"fisher\"");
        for (std::size_t k = 0; k < test_.trace.size(); ++k) trace(k);
        for (const JointTable& table : joint_tables(test_)) mechanics(table);
    }

  private:
    [[noreturn]] void refuse(const std::string& key, const std::string& found, const std::string& expected,
                             const std::string& remedy) const {
        throw InputError(fmt::format("{}: found {}, expected {}; {}", test_.at(key), found, expected, remedy));
    }
    bool written(const std::string& key) const { return test_.position.contains(key); }
    static std::string of_set(std::size_t k, const char* key) { return fmt::format("joint_set[{}].{}", k + 1, key); }
    static std::string of_trace(std::size_t k, const char* key) { return fmt::format("trace[{}].{}", k + 1, key); }

    void need(const std::string& label, const char* table, const char* key, const std::string& because) const {
        if (!written(label)) refuse(label, "nothing", find_parameter(table, key)->expected(), because);
    }
    void exclude(const std::string& label, const std::string& because) const {
        if (written(label)) throw key_without_room(test_, label, because);
    }
    void expect_beside(const std::string& label, const std::string& what) const {
        if (written(label)) throw key_needs(test_, label, what);
    }

    void names() const {
        std::set<std::string> taken;
        const auto take = [&](const std::string& key, const std::string& name) {
            if (name.empty()) refuse(key, "an empty text", "a name", "give one");
            if (!taken.insert(name).second)
                refuse(key, fmt::format("\"{:.40}\" a second time", name), "a unique name", "rename one");
        };
        for (std::size_t k = 0; k < test_.joint_set.size(); ++k) take(of_set(k, "name"), test_.joint_set[k].name);
        for (std::size_t k = 0; k < test_.trace.size(); ++k)
            if (test_.trace[k].name) take(of_trace(k, "name"), *test_.trace[k].name);
    }

    /// Checks that the keys required by the chosen law are present and those of other laws are absent.
    template <class Choice>
    void law(std::size_t k, const char* key, Choice choice, const std::vector<LawKeys<Choice>>& laws) const {
        const auto chosen =
            std::find_if(laws.begin(), laws.end(), [&](const auto& one) { return choice == one.choice; });
        const std::string because = fmt::format("{} = \"{}\"", key, name_of(choice));
        for (const char* needed : chosen->needed)
            need(of_set(k, needed), "joint_set", needed, because + " needs this key");
        const auto has = [](const std::vector<const char*>& keys, const std::string& one) {
            return std::find(keys.begin(), keys.end(), one) != keys.end();
        };
        for (const LawKeys<Choice>& other : laws) {
            for (const auto* keys : {&other.needed, &other.allowed}) {
                for (const char* one : *keys) {
                    if (!has(chosen->needed, one) && !has(chosen->allowed, one))
                        exclude(of_set(k, one), because + " does not use it");
                }
            }
        }
    }

    void below(std::size_t k, const char* key, const std::optional<double>& value, const char* bound_key,
               const std::optional<double>& bound) const {
        if (value && bound && *value >= *bound)
            refuse(of_set(k, key), fmt::format("{} m", *value), fmt::format("less than {} = {} m", bound_key, *bound),
                   "all lengths must be > 0");
    }

    void set(std::size_t k) const {
        const TestCase::JointSet& s = test_.joint_set[k];
        law(k, "orientation", s.orientation, orientation_laws());
        law(k, "length", s.length, length_laws());
        if (s.length != JointLength::lognormal)
            below(k, "length_deviation", s.length_deviation, "length_mean", s.length_mean);
        below(k, "gap_deviation", s.gap_deviation, "gap_mean", s.gap_mean);
        below(k, "length_min", s.length_min, "length_max", s.length_max);
        amount(k);
    }

    void amount(std::size_t k) const {
        const TestCase::JointSet& s = test_.joint_set[k];
        std::vector<const char*> given;
        for (const char* one : amounts)
            if (written(of_set(k, one))) given.push_back(one);
        if (given.size() != 1) {
            refuse(fmt::format("joint_set[{}]", k + 1),
                   given.empty() ? std::string("no amount") : fmt::format("{}", fmt::join(given, " and ")),
                   fmt::format("one of {}", fmt::join(amounts, ", ")), given.empty() ? "add one" : "remove others");
        }
        const bool lines = s.length == JointLength::persistent || s.length == JointLength::gaps;
        if (s.spacing) {
            if (!lines)
                refuse(of_set(k, "spacing"), fmt::format("length = \"{}\"", name_of(s.length)),
                       "\"persistent\" or \"gaps\"",
                       "such traces have midpoints, but no spacing; give p10, p20, p21 or number");
            law(k, "spacing_law", s.spacing_law.value_or(JointSpacing::fixed), spacing_laws());
            if (s.spacing_law == JointSpacing::uniform)
                below(k, "spacing_deviation", s.spacing_deviation, "spacing", s.spacing);
        } else {
            for (const char* key : {"spacing_law", "spacing_deviation", "through"})
                expect_beside(of_set(k, key), "spacing as the amount");
        }
        if (s.p20 && lines)
            refuse(of_set(k, "p20"), fmt::format("length = \"{}\"", name_of(s.length)), "traces with midpoints",
                   "such lines have no midpoints; give spacing, p10, p21 or number");
        if (s.through && s.through->size() != 2)
            refuse(of_set(k, "through"), counted(s.through->size(), "number"), "two, x and y", "correct it");
        if (!s.p10) expect_beside(of_set(k, "scan_line"), "p10 as the amount");
    }

    void trace(std::size_t k) const {
        const TestCase::Trace& t = test_.trace[k];
        if (t.points.has_value() == t.file.has_value()) {
            refuse(fmt::format("trace[{}]", k + 1), t.points ? "points and a file" : "neither points nor a file",
                   "one of them", t.points ? "remove one" : "add one");
        }
        if (t.points) {
            for (const char* key : {"scale", "offset", "layer"}) expect_beside(of_trace(k, key), "a file");
            if (t.points->size() < 4 || t.points->size() % 2 != 0)
                refuse(of_trace(k, "points"), counted(t.points->size(), "number"), "x and y of at least two points",
                       "correct it");
            const std::vector<double>& p = *t.points;
            bool apart = false;
            for (std::size_t n = 2; n < p.size(); n += 2) apart = apart || p[n] != p[0] || p[n + 1] != p[1];
            if (!apart)
                refuse(of_trace(k, "points"), "points that coincide", "at least two different points", "correct it");
        }
        if (t.offset && t.offset->size() != 2)
            refuse(of_trace(k, "offset"), counted(t.offset->size(), "number"), "two, x and y", "correct it");
    }

    /// Checks that the mechanical properties given for a joint can be combined.
    void mechanics(const JointTable& table) const {
        const TestCase::JointKeys& own = *table.keys;
        const auto key = [&](const char* name) { return table.label + "." + name; };
        if (own.open()) {
            for (const char* name : {"strength_factor", "tensile_strength", "cohesion", "residual_friction_angle"})
                exclude(key(name), "an open joint has no bonds; friction_angle applies to its faces");
        } else if (own.aperture) {
            refuse(key("aperture"), fmt::format("{} m", *own.aperture), "no aperture for a bonded joint",
                   "write bonded = false, or remove the aperture");
        }
        if (own.tensile_strength && own.cohesion)
            exclude(key("strength_factor"), "tensile_strength and cohesion already replace it");
        if (own.friction_angle && own.residual_friction_angle && *own.residual_friction_angle > *own.friction_angle)
            refuse(key("residual_friction_angle"), fmt::format("{} deg", *own.residual_friction_angle),
                   fmt::format("at most friction_angle, {} deg", *own.friction_angle),
                   "the friction angle of a broken bond must not exceed that of an intact bond");
        if (own.dilation_slip && own.dilation_angle.value_or(0.0) == 0.0)
            throw key_needs(test_, key("dilation_slip"), "a dilation_angle > 0");
    }

    const TestCase& test_;
};

/// Checks the mechanical properties of a joint against the rock's.
class JointAgainstRock {
  public:
    JointAgainstRock(const TestCase& test, const JointTable& table) : test_(test), table_(table), own_(*table.keys) {}

    void run() const {
        laws();
        std::vector<TestCase::MaterialKeys> rocks;
        for (std::size_t k = 0; k < test_.mineral.size(); ++k) rocks.push_back(mineral_material(test_, k));
        if (rocks.empty()) rocks.push_back(test_.material);
        for (const TestCase::MaterialKeys& rock : rocks) {
            friction(rock);
            if (!own_.open()) strengths(rock);
        }
    }

  private:
    [[noreturn]] void refuse(const char* name, const std::string& found, const std::string& expected,
                             const std::string& remedy) const {
        throw InputError(
            fmt::format("{}: found {}, expected {}; {}", test_.at(table_.label + "." + name), found, expected, remedy));
    }

    /// Checks that the bond law supports the joint's properties, and that stiffnesses are given per area
    /// (material.units = "area").
    void laws() const {
        const bool across_joints = test_.bond_facts().across_joints, by_faces = test_.bond_facts().by_faces;
        for (const char* key : {"residual_cohesion", "softening_slip"})
            if (!by_faces && test_.position.contains(table_.label + "." + key))
                throw key_needs(test_, table_.label + "." + key,
                                fmt::format("bond.law = {}", laws_with(&BondLawFacts::by_faces)));
        if (by_faces && own_.dilation_angle)
            refuse("dilation_angle", fmt::format("{} deg", *own_.dilation_angle),
                   "no dilation angle with bond.law = \"face\"",
                   "faces do not dilate; use coulomb bonds, or remove the key");
        if (across_joints && test_.area_units()) return;
        for (const Parameter& p : joint_mechanics_keys()) {
            if (!test_.position.contains(table_.label + "." + p.key)) continue;
            refuse(p.key.c_str(),
                   across_joints ? fmt::format("a value with units = \"{}\"", name_of(test_.material.units))
                                 : fmt::format("a value with bond.law = \"{}\"", name_of(test_.bond.law)),
                   fmt::format("bond.law = {} and material.units = \"area\"", laws_with(&BondLawFacts::across_joints)),
                   "change these, or remove the key");
        }
    }

    /// Friction angles from a particle file are not known here; they are checked when the scene is built.
    void friction(const TestCase::MaterialKeys& rock) const {
        const auto first = [](std::initializer_list<std::optional<double>> angles) {
            const auto given = std::ranges::find_if(angles, [](const auto& angle) { return angle.has_value(); });
            return given == angles.end() ? std::optional<double>() : *given;
        };
        const std::optional<double> peak = first({own_.friction_angle, rock.friction_angle});
        if (peak && own_.residual_friction_angle && *own_.residual_friction_angle > *peak)
            refuse("residual_friction_angle", fmt::format("{} deg", *own_.residual_friction_angle),
                   fmt::format("at most the rock's friction_angle, {} deg", *peak),
                   "give the friction_angle of the joint as well");
        const std::optional<double> slides_at = first(
            {own_.residual_friction_angle, own_.friction_angle, rock.residual_friction_angle, rock.friction_angle});
        if (slides_at && own_.dilation_angle.value_or(0.0) > *slides_at)
            refuse("dilation_angle", fmt::format("{} deg", *own_.dilation_angle),
                   fmt::format("at most the friction angle of the sliding joint, {} deg", *slides_at),
                   "a larger angle would create energy");
    }

    void strengths(const TestCase::MaterialKeys& rock) const {
        const std::optional<double> angle = own_.friction_angle ? own_.friction_angle : rock.friction_angle;
        if (!rock.tensile_strength || !rock.cohesion || !angle) return;
        const double factor = own_.strength_factor.value_or(1.0);
        const double tensile = own_.tensile_strength.value_or(factor * *rock.tensile_strength),
                     cohesion = own_.cohesion.value_or(factor * *rock.cohesion);
        const double friction = friction_coefficient(*angle);
        if (!beyond_apex(friction, tensile, cohesion)) return;
        refuse(own_.tensile_strength ? "tensile_strength"
               : own_.cohesion       ? "cohesion"
                                     : "friction_angle",
               fmt::format("a tensile strength of {:.6g} Pa", tensile),
               fmt::format("at most its cohesion/tan(friction_angle), {:.6g} Pa", cohesion / friction),
               "a larger value would lie beyond the apex of the strength envelope; lower tensile_strength or raise "
               "cohesion");
    }

    const TestCase& test_;
    const JointTable& table_;
    const TestCase::JointKeys& own_;
};

}  // namespace

void check_joints(const TestCase& test) { JointCheck(test).run(); }

void check_jointed_specimen(const TestCase& test) {
    if (!test.jointed()) return;
    const auto refuse = [&](const std::string& key, const std::string& found, const std::string& expected) {
        throw InputError(
            fmt::format("{}: found {} with joints, expected {}; change it, or remove [[joint_set]] and "
                        "[[trace]]",
                        test.at(key), found, expected));
    };
    if (test.has_table("mesh") && test.mesh.boundary != Boundary::domain)
        refuse("mesh.boundary", fmt::format("\"{}\"", name_of(test.mesh.boundary)), "\"domain\"");
    if (test.has_table("mesh") && test.mesh.merge_destroyed && test.mesh.kind == MeshKind::voronoi)
        refuse("mesh.merge_destroyed", "true", "false with kind = \"voronoi\"");
    const auto may_be_jointed = [](const TestKind& kind) { return kind.uniaxial || kind.shear_box; };
    if (!may_be_jointed(test_kind(test.loading.kind)))
        refuse("loading.kind", fmt::format("\"{}\"", name_of(test.loading.kind)), kinds_with(may_be_jointed));
    for (const JointTable& table : joint_tables(test))
        if (!table.keys->as_rock()) JointAgainstRock(test, table).run();
}

}  // namespace crackle
