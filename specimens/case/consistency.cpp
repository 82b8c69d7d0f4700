// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/consistency.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "solver/scene/bond_strength.hpp"
#include "specimens/case/joint_checks.hpp"
#include "specimens/case/mineral_checks.hpp"
#include "specimens/case/parameters.hpp"

namespace crackle {
namespace {

class ConsistencyCheck {
  public:
    explicit ConsistencyCheck(const TestCase& test) : test_(test) {}

    void run() const {
        specimen();
        if (test_.has_table("packing")) packing();
        material();
        bond();
        check_minerals(test_);
        check_joints(test_);
        mesh();
        check_jointed_specimen(test_);
        loading();
        if (test_.output.frames.value_or(0) > test_.output.curve_rows) {
            refuse("output.frames", fmt::format("{}", *test_.output.frames),
                   fmt::format("at most output.curve_rows = {}", test_.output.curve_rows),
                   "frames are taken at rows of the curve");
        }
    }

  private:
    [[noreturn]] void refuse(const std::string& key, const std::string& found, const std::string& expected,
                             const std::string& remedy) const {
        throw InputError(fmt::format("{}: found {}, expected {}; {}", test_.at(key), found, expected, remedy));
    }
    bool written(const std::string& key) const { return test_.position.contains(key); }

    void need(const std::string& key, const std::string& because) const {
        if (written(key)) return;
        const std::string table = key.substr(0, key.find('.'));
        const Parameter* p = find_parameter(table, key.substr(table.size() + 1));
        refuse(key, "nothing", p->expected(), because);
    }
    void exclude(const std::string& key, const std::string& because) const {
        if (written(key)) throw key_without_room(test_, key, because);
    }
    /// A key of use only with something that the case does not have.
    void expect_beside(const std::string& key, const std::string& what) const {
        if (written(key)) throw key_needs(test_, key, what);
    }
    /// A key of [material], wherever one may stand.
    void exclude_of_materials(const char* key, const std::string& because) const {
        for (const std::string& table : material_tables(test_)) exclude(fmt::format("{}.{}", table, key), because);
    }
    void expect_materials_beside(const char* key, const std::string& what) const {
        for (const std::string& table : material_tables(test_)) expect_beside(fmt::format("{}.{}", table, key), what);
    }

    void specimen() const {
        const bool file = test_.has_table("particles");
        const bool pack = test_.has_table("packing");
        if (file && pack) refuse("packing", "[particles] beside it", "one of them", "remove one");
        if (!file && !pack)
            refuse("particles", "neither [particles] nor [packing]", "one of them",
                   "state where the specimen comes from");
    }

    void packing() const {
        const auto& p = test_.packing;
        if (p.count) {
            exclude("packing.width", "count and height_to_width give the box its size");
            exclude("packing.height", "count and height_to_width give the box its size");
        } else {
            need("packing.width", "or write count");
            need("packing.height", "or write count");
            exclude("packing.height_to_width", "width and height give the box its shape");
        }
        if (p.mean_overlap && p.void_ratio) exclude("packing.void_ratio", "mean_overlap is the packing's target");
        if (!p.mean_overlap && !p.void_ratio) need("packing.mean_overlap", "or write void_ratio");
        if (p.cell_diameter || p.cell_spread) {
            cells();
            return;
        }
        if (p.sizes == "sieve") {
            need("packing.sieve", "sizes = \"sieve\" needs a curve");
            for (const char* key : {"radius_min", "radius_max", "radius_median", "radius_log_deviation"}) {
                exclude(std::string("packing.") + key, "the sieve curve gives the sizes");
            }
            return;
        }
        expect_beside("packing.sieve", "sizes = \"sieve\"");
        if (p.sizes == "uniform") {
            need("packing.radius_min", "sizes = \"uniform\" needs both ends");
            need("packing.radius_max", "sizes = \"uniform\" needs both ends");
            expect_beside("packing.radius_median", "sizes = \"lognormal\"");
            expect_beside("packing.radius_log_deviation", "sizes = \"lognormal\"");
        } else {
            need("packing.radius_median", "sizes = \"lognormal\" needs it");
            need("packing.radius_log_deviation", "sizes = \"lognormal\" needs it");
        }
        if (p.radius_min && p.radius_max && *p.radius_min > *p.radius_max) {
            refuse("packing.radius_min", fmt::format("{} m", *p.radius_min),
                   fmt::format("at most radius_max = {} m", *p.radius_max), "exchange them");
        }
    }

    /// The size of the cells in place of that of the circles.
    void cells() const {
        constexpr const char* because = "cell_diameter and cell_spread give the sizes";
        for (const char* key : {"radius_min", "radius_max", "radius_median", "radius_log_deviation", "sieve"})
            exclude(std::string("packing.") + key, because);
        if (!test_.has_table("mesh"))
            refuse(test_.packing.cell_diameter ? "packing.cell_diameter" : "packing.cell_spread", "no [mesh] beside it",
                   "one", "circles have radii; cells are a mesh's");
        if (test_.packing.sizes == "sieve")
            refuse("packing.sizes", "\"sieve\"", "\"uniform\" or \"lognormal\"", because);
        need("packing.cell_diameter", "cell_spread is of diameters with a mean");
        need("packing.cell_spread", "cell_diameter needs their coefficient of variation beside it");
    }

    void material() const {
        const auto& m = test_.material;
        if (m.damping_ratio && (m.normal_damping || m.shear_damping)) {
            refuse("material.damping_ratio", "a ratio and dashpots", "one way of damping",
                   "remove damping_ratio or the dashpots");
        }
        const bool area = test_.area_units();
        if (area) {
            for (const char* key : {"normal_stiffness", "shear_stiffness"})
                exclude_of_materials(key, "units = \"area\" has contact_modulus and stiffness_ratio");
            for (const char* key : {"normal_damping", "shear_damping"})
                exclude_of_materials(key, "units = \"area\" has damping_ratio");
            for (const char* key : {"contact_modulus", "stiffness_ratio"})
                need(std::string("material.") + key, "units = \"area\" needs it");
            if (test_.numerics.contact_law != "rounded")
                refuse("material.units", "\"area\"", "\"point\" with the guide's contact law",
                       "that law knows of no faces; use contact_law = \"rounded\"");
        } else {
            for (const char* key : {"contact_modulus", "stiffness_ratio"})
                expect_materials_beside(key, "units = \"area\"");
        }
        numbers("material", m);
        for (std::size_t k = 0; k < test_.mineral.size(); ++k)
            numbers(fmt::format("mineral[{}]", k + 1), mineral_material(test_, k));
        for (std::size_t k = 0; k < test_.mineral_pair.size(); ++k)
            numbers(fmt::format("mineral_pair[{}]", k + 1), pair_material(test_, k));
        if (!test_.has_table("packing")) return;
        need("material.density", "a packing has no file to take it from");
        need("material.friction_angle", "a packing has no file to take it from");
        if (!area) {
            need("material.normal_stiffness", "a packing has no file to take it from");
            need("material.shear_stiffness", "a packing has no file to take it from");
        }
        if (!m.normal_damping && !m.shear_damping) return;  // a ratio, or the default one
        need("material.normal_damping", "dashpots come in pairs");
        need("material.shear_damping", "dashpots come in pairs");
    }

    /// Of the table's material, whose numbers may be another's.
    void numbers(const std::string& table, const TestCase::MaterialKeys& m) const {
        const auto key = [&](const char* name) {
            std::string own = fmt::format("{}.{}", table, name);
            if (written(own)) return own;
            // A pair is at fault by what it gives itself: each mineral by itself has been looked at.
            return table.starts_with("mineral_pair") ? table + ".between" : std::string("material.") + name;
        };
        if (m.residual_friction_angle && m.friction_angle && *m.residual_friction_angle > *m.friction_angle)
            refuse(key("residual_friction_angle"), fmt::format("{} deg", *m.residual_friction_angle),
                   fmt::format("at most the friction_angle of {}, {} deg", table, *m.friction_angle),
                   "a broken bond is no rougher");
        if (!test_.coulomb_bonds()) return;
        if (m.shear_stiffness == 0.0)
            refuse(key("shear_stiffness"), "0 N/m", "a number > 0 with coulomb bonds", "they hold in shear");
        if (!m.tensile_strength || !m.cohesion || !m.friction_angle) return;
        // Beyond cohesion over friction a tensile strength would never be reached.
        const double friction = correctly_rounded::tan(*m.friction_angle * std::numbers::pi / 180.0);
        if (!(friction * *m.tensile_strength > *m.cohesion * (1.0 + 1e-12))) return;
        const std::string unit = test_.area_units() ? "Pa" : "N";
        refuse(key("tensile_strength"), fmt::format("{} {}", *m.tensile_strength, unit),
               fmt::format("at most cohesion over tan(friction_angle) of {}, {:.6g} {}", table, *m.cohesion / friction,
                           unit),
               "the apex of the bond's envelope would cut it off; give more cohesion or less tensile strength");
    }

    /// What a bond law has, and needs.
    void bond() const {
        const auto& b = test_.bond;
        if (!test_.coulomb_bonds()) {
            constexpr const char* law = "bond.law = \"coulomb\" (by back-tension the overlap is the strength)";
            for (const char* key : {"tensile_strength", "cohesion", "residual_friction_angle"})
                expect_materials_beside(key, law);
            for (const char* key :
                 {"bond.gap", "bond.tensile_factor", "bond.cohesion_factor", "bond.strength_cv", "bond.strength_seed"})
                expect_beside(key, law);
            if (b.range > 0.0) expect_beside("bond.range", law);
            if (b.strength_distribution != "none") expect_beside("bond.strength_distribution", law);
            return;
        }
        if (test_.numerics.contact_law != "rounded")
            refuse("bond.law", "\"coulomb\"", "\"back_tension\" with the guide's contact law",
                   "or use contact_law = \"rounded\"");
        strength("tensile");
        strength("cohesion");
        const bool random = b.strength_distribution != "none";
        for (const char* key : {"bond.strength_cv", "bond.strength_seed"}) {
            if (random)
                need(key, "strength_distribution = \"" + b.strength_distribution + "\" needs it");
            else
                expect_beside(key, "a strength_distribution other than \"none\"");
        }
        if (b.strength_distribution == "normal" && *b.strength_cv > largest_normal_cv)
            refuse("bond.strength_cv", fmt::format("{}", *b.strength_cv), fmt::format("at most {}", largest_normal_cv),
                   "a normal distribution truncated at 0 has no more; take weibull or lognormal");
        if (test_.has_table("mesh") && b.range > 0.0)
            exclude("bond.range", "polygons do not reach beyond their neighbours, circles do");
    }

    /// A strength is a number or a factor.
    void strength(const std::string& which) const {
        const std::string number = "material." + (which == "tensile" ? std::string("tensile_strength") : which);
        const std::string factor = "bond." + which + "_factor";
        if (written(number) && written(factor)) exclude(factor, number + " gives the strength");
        if (!written(number) && !written(factor)) need(number, "bond.law = \"coulomb\" needs it, or " + factor);
        if (!written(factor)) return;
        exclude_of_materials(which == "tensile" ? "tensile_strength" : "cohesion", factor + " gives it to all bonds");
        if (test_.has_table("mesh"))
            exclude(factor, "polygons with coulomb bonds have no overlap to take a factor of: give " + number);
        if (test_.area_units()) exclude(factor, "with units = \"area\" strengths are in Pa: give " + number);
    }

    void mesh() const {
        if (!test_.has_table("mesh")) return;
        if (*test_.mesh.kind == "voronoi" && test_.mesh.boundary == "seeds") {
            refuse("mesh.boundary", "\"seeds\"", "\"domain\" with kind = \"voronoi\"", "Voronoi cells always fill it");
        }
        if (test_.coulomb_bonds() && !test_.mesh.thick && !test_.mesh.inset) {
            exclude("bond.thick", "mesh.thick is derived: both are given, or neither");
            return;
        }
        if (!test_.coulomb_bonds())
            need("mesh.thick", "by back-tension the excess of bond.thick over it is the strength");
        const double gap = test_.mesh.inset ? 2.0 * *test_.mesh.inset : *test_.mesh.thick;
        if (test_.coulomb_bonds()) {
            if (test_.bond.thick && *test_.bond.thick < gap)
                refuse("bond.thick", fmt::format("{} m", *test_.bond.thick), fmt::format("at least {} m", gap),
                       "faces that far apart would not bond; leave it out");
            return;
        }
        need("bond.thick", "polygons bond at the excess of bond.thick over mesh.thick");
        if (*test_.bond.thick <= gap) {
            refuse("bond.thick", fmt::format("{} m", *test_.bond.thick),
                   fmt::format("more than {} = {} m", test_.mesh.inset ? "twice mesh.inset" : "mesh.thick", gap),
                   "the excess is the overlap that bonds the polygons");
        }
    }

    void loading() const {
        if (test_.loading.axial_strain_rate && test_.loading.rate_tolerance) {
            refuse("loading.rate_tolerance", "a tolerance besides axial_strain_rate", "one of them",
                   "remove axial_strain_rate to have the rate chosen, or rate_tolerance");
        }
        if (test_.loading.platens == "frictional") {
            if (test_.loading.kind == "tension") {
                refuse("loading.platens", "\"frictional\"", "\"bonded\" in tension",
                       "a platen that is not bonded cannot pull");
            }
            need("loading.platen_friction_angle", "frictional platens need it");
            if (test_.numerics.intact)
                refuse("numerics.intact", "true", "false with frictional platens",
                       "they touch only what comes into contact later");
        } else {
            expect_beside("loading.platen_friction_angle",
                          "platens = \"frictional\" (bonded and glued platens take the specimen's)");
        }
        keys_of_kinds();
        turning_round();
        if (test_.confined()) need("confinement.pressure", "kind = \"biaxial\" needs it");
        if (test_.confinement.by_walls() && test_.numerics.intact)
            refuse("numerics.intact", "true", "false with confinement.side = \"walls\"",
                   "they press by contacts that no bond has made");
        if (test_.loading.platens != "glued") expect_beside("loading.grip", "platens = \"glued\"");
    }

    /// A platen that goes back: by cycles, none of which begins nearer than the one before, or by lateral strain.
    void turning_round() const {
        const TestCase::Loading& loading = test_.loading;
        if (loading.by_lateral_strain()) {
            if (loading.kind != "compression" && loading.kind != "biaxial")
                refuse("loading.control", "\"lateral\"", "\"axial\" with kind = \"" + loading.kind + "\"",
                       "only a specimen that is compressed between platens widens");
            if (loading.unloads())
                refuse("loading.control", "\"lateral\"", "\"axial\" where the specimen is unloaded",
                       "the platen goes back by itself");
            if (loading.axial_strain_rate)
                refuse("loading.control", "\"lateral\" besides axial_strain_rate", "loading by tolerance",
                       "the platen's speed is what follows; give rate_tolerance in place of the rate");
        }
        if (!loading.unloads()) {
            expect_beside("loading.unload_to", "loading.unload_at_strain or unload_at_stress");
            return;
        }
        const bool by_strain = loading.unload_at_strain.has_value();
        const std::string key = by_strain ? "loading.unload_at_strain" : "loading.unload_at_stress";
        if (by_strain && loading.unload_at_stress)
            refuse("loading.unload_at_stress", "stresses besides unload_at_strain", "one of them", "remove the other");
        if (loading.axial_strain_rate)
            refuse(key, "unloading at an axial_strain_rate", "loading by tolerance",
                   "a platen that turns round at once sends a shock; give rate_tolerance in place of the rate");
        const std::vector<double>& at = by_strain ? *loading.unload_at_strain : *loading.unload_at_stress;
        if (!std::ranges::is_sorted(at))
            refuse(key, fmt::format("[{}]", fmt::join(at, ", ")), "numbers none of which is below the one before",
                   "sort them");
        if (by_strain && at.back() >= loading.max_axial_strain)
            refuse(key, fmt::format("{}", at.back()),
                   fmt::format("strains below max_axial_strain = {}", loading.max_axial_strain), "the test ends there");
    }

    /// Keys of some kinds of test, and what a kind asks of the rest.
    void keys_of_kinds() const {
        struct KindKey {
            const char* key;
            std::vector<std::string> kinds;
        };
        static const std::vector<KindKey> keys{
            {"confinement.pressure", {"biaxial"}},     {"shape.diameter", {"brazilian", "scb"}},
            {"shape.notch", {"bending", "scb"}},       {"loading.half_angle", {"brazilian"}},
            {"loading.jaws", {"brazilian"}},           {"loading.span", {"bending", "scb"}},
            {"loading.pad_width", {"bending", "scb"}}, {"loading.normal_stress", {"direct_shear"}},
            {"loading.box_gap", {"direct_shear"}},     {"loading.normal_stiffness", {"direct_shear"}},
            {"confinement.side", {"biaxial"}},
        };
        const std::string& kind = test_.loading.kind;
        for (const KindKey& one : keys) {
            if (std::find(one.kinds.begin(), one.kinds.end(), kind) != one.kinds.end()) continue;
            expect_beside(one.key, fmt::format("loading.kind = \"{}\"", fmt::join(one.kinds, "\" or \"")));
        }
        if (test_.uniaxial()) return;
        const bool frictional = test_.loading.platens == "frictional";
        if (frictional && kind != "brazilian")
            refuse("loading.platens", "\"frictional\"", "\"glued\" or \"bonded\" with kind = \"" + kind + "\"",
                   "pads and boxes hold what they press");
        if (!frictional && test_.loading.jaws.value_or("arc") != "arc")
            refuse("loading.jaws", "\"" + *test_.loading.jaws + "\"", "\"arc\" where jaws are " + test_.loading.platens,
                   "a bonded face lies against the disc; use platens = \"frictional\"");
        if (test_.loading.grip.value_or(0.0) > 0.0)
            refuse("loading.grip", fmt::format("{}", *test_.loading.grip), "none with kind = \"" + kind + "\"",
                   "it has no ends to be gripped");
        if (kind == "direct_shear") need("loading.normal_stress", "kind = \"direct_shear\" needs it, 0 for none");
        if (test_.has_table("mesh") && test_.mesh.boundary == "seeds")
            refuse("mesh.boundary", "\"seeds\"", "\"domain\" with kind = \"" + kind + "\"",
                   "pads and jaws need flat faces");
        if (test_.shape.notch || kind == "scb") {
            if (test_.has_table("mesh") && !test_.coulomb_bonds())
                refuse("bond.law", "\"back_tension\"", "\"coulomb\" with a notch in polygons",
                       "where they are not bonded they would press each other apart by their overlap");
        }
    }

    const TestCase& test_;
};

}  // namespace

void check_consistency(const TestCase& test) { ConsistencyCheck(test).run(); }

}  // namespace crackle
