// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/consistency.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

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
    /// Rejects a key that requires something that is missing from the case.
    void expect_beside(const std::string& key, const std::string& what) const {
        if (written(key)) throw key_needs(test_, key, what);
    }
    /// Rejects a key of [material] in every table that may contain it.
    void exclude_of_materials(const char* key, const std::string& because) const {
        for (const std::string& table : material_tables(test_)) exclude(fmt::format("{}.{}", table, key), because);
    }
    void expect_materials_beside(const char* key, const std::string& what) const {
        for (const std::string& table : material_tables(test_)) expect_beside(fmt::format("{}.{}", table, key), what);
    }

    void specimen() const {
        const bool file = test_.has_table("particles");
        const bool pack = test_.has_table("packing");
        if (file && pack) refuse("packing", "both [particles] and [packing]", "one of them", "remove one");
        if (!file && !pack)
            refuse("particles", "neither [particles] nor [packing]", "one of them",
                   "add the table that describes the specimen's origin");
    }

    void packing() const {
        const auto& p = test_.packing;
        if (p.count) {
            exclude("packing.width", "count and height_to_width determine the size of the box");
            exclude("packing.height", "count and height_to_width determine the size of the box");
        } else {
            need("packing.width", "or write count");
            need("packing.height", "or write count");
            exclude("packing.height_to_width", "width and height determine the shape of the box");
        }
        if (p.mean_overlap && p.void_ratio)
            exclude("packing.void_ratio", "mean_overlap already determines how far the packing is compressed");
        if (!p.mean_overlap && !p.void_ratio) need("packing.mean_overlap", "or write void_ratio");
        if (p.cell_diameter || p.cell_spread) {
            cells();
            return;
        }
        if (p.sizes == RadiusLaw::sieve) {
            need("packing.sieve", "sizes = \"sieve\" needs a curve");
            for (const char* key : {"radius_min", "radius_max", "radius_median", "radius_log_deviation"}) {
                exclude(std::string("packing.") + key, "the sieve curve determines the sizes");
            }
            return;
        }
        expect_beside("packing.sieve", "sizes = \"sieve\"");
        if (p.sizes == RadiusLaw::uniform) {
            need("packing.radius_min", "sizes = \"uniform\" needs both radius_min and radius_max");
            need("packing.radius_max", "sizes = \"uniform\" needs both radius_min and radius_max");
            expect_beside("packing.radius_median", "sizes = \"lognormal\"");
            expect_beside("packing.radius_log_deviation", "sizes = \"lognormal\"");
        } else {
            need("packing.radius_median", "sizes = \"lognormal\" needs this key");
            need("packing.radius_log_deviation", "sizes = \"lognormal\" needs this key");
        }
        if (p.radius_min && p.radius_max && *p.radius_min > *p.radius_max) {
            refuse("packing.radius_min", fmt::format("{} m", *p.radius_min),
                   fmt::format("at most radius_max = {} m", *p.radius_max), "exchange them");
        }
    }

    /// Checks that circle sizes are not given together with cell sizes, which replace them.
    void cells() const {
        constexpr const char* because = "cell_diameter and cell_spread determine the sizes";
        for (const char* key : {"radius_min", "radius_max", "radius_median", "radius_log_deviation", "sieve"})
            exclude(std::string("packing.") + key, because);
        if (!test_.has_table("mesh"))
            refuse(test_.packing.cell_diameter ? "packing.cell_diameter" : "packing.cell_spread", "no [mesh] table",
                   "one", "only a mesh has cells, so add [mesh], or give the radii of the circles");
        if (test_.packing.sizes == RadiusLaw::sieve)
            refuse("packing.sizes", "\"sieve\"", "\"uniform\" or \"lognormal\"", because);
        need("packing.cell_diameter", "cell_spread needs the mean diameter");
        need("packing.cell_spread", "cell_diameter needs a coefficient of variation");
    }

    void material() const {
        const auto& m = test_.material;
        if (m.damping_ratio && (m.normal_damping || m.shear_damping)) {
            refuse("material.damping_ratio", "a damping ratio and dashpots", "only one kind of damping",
                   "remove damping_ratio or the dashpots");
        }
        const bool area = test_.area_units();
        if (area) {
            for (const char* key : {"normal_stiffness", "shear_stiffness"})
                exclude_of_materials(key, "units = \"area\" uses contact_modulus and stiffness_ratio");
            for (const char* key : {"normal_damping", "shear_damping"})
                exclude_of_materials(key, "units = \"area\" uses damping_ratio");
            if (!test_.bond_facts().by_faces)
                for (const char* key : {"contact_modulus", "stiffness_ratio"})
                    need(std::string("material.") + key, "units = \"area\" needs this key");
            if (test_.numerics.contact_law != SegmentLaw::rounded)
                refuse(
                    "material.units", "\"area\"", "\"point\" with the contact law of DEMseg's guide",
                    "that law does not use the area of faces, so use contact_law = \"rounded\" with units = \"area\"");
        } else {
            for (const char* key : {"contact_modulus", "stiffness_ratio"})
                expect_materials_beside(key, "units = \"area\"");
        }
        faces();
        numbers("material", m);
        for (std::size_t k = 0; k < test_.mineral.size(); ++k)
            numbers(fmt::format("mineral[{}]", k + 1), mineral_material(test_, k));
        for (std::size_t k = 0; k < test_.mineral_pair.size(); ++k)
            numbers(fmt::format("mineral_pair[{}]", k + 1), pair_material(test_, k));
        if (!test_.has_table("packing")) return;
        need("material.density", "this key is required, since no particle file provides its value");
        need("material.friction_angle", "this key is required, since no particle file provides its value");
        if (!area) {
            need("material.normal_stiffness", "this key is required, since no particle file provides its value");
            need("material.shear_stiffness", "this key is required, since no particle file provides its value");
        }
        if (!m.normal_damping && !m.shear_damping) return;  // a damping ratio is used, either given or the default
        need("material.normal_damping", "normal_damping and shear_damping must be given together");
        need("material.shear_damping", "normal_damping and shear_damping must be given together");
    }

    /// Checks the keys that bonds of whole faces (bond.law = "face") require, and the keys that only such bonds use.
    void faces() const {
        if (!test_.bond_facts().by_faces) {
            for (const FaceConstant& constant : face_constants)
                expect_materials_beside(constant.key, fmt::format("bond.law = {}", laws_with(&BondLawFacts::by_faces)));
            return;
        }
        if (!test_.area_units())
            refuse("material.units", fmt::format("\"{}\"", name_of(test_.material.units)), "\"area\" with faces",
                   "the stiffness and strengths of a face are per unit area");
        for (const char* key : {"youngs_modulus", "poissons_ratio"})
            need(std::string("material.") + key, "bond.law = \"face\" needs this key");
        exclude_of_materials("contact_modulus", "it follows from youngs_modulus and poissons_ratio");
        for (const char* key : {"bond.gap", "bond.thick"}) exclude(key, "faces bond where cells share an edge");
        if (test_.has_table("packing") && !test_.has_table("mesh"))
            refuse("bond.law", "\"face\" without [mesh]", "a mesh",
                   "only polygons have faces; add [mesh], or use law = \"coulomb\"");
        if (test_.numerics.integrator != Integrator::leapfrog)
            refuse("numerics.integrator", fmt::format("\"{}\"", name_of(test_.numerics.integrator)),
                   "\"leapfrog\" with faces", "leave the key out");
        const TestCase::MaterialKeys& m = test_.material;
        const char* const knee = "friction_knee";
        const char* const beyond = "friction_angle_beyond";
        for (const std::string& table : material_tables(test_)) {
            const std::string at_knee = fmt::format("{}.{}", table, knee), angle = fmt::format("{}.{}", table, beyond);
            if (table != "material" && m.friction_knee) break;
            if (written(at_knee) && !written(angle)) throw key_needs(test_, at_knee, beyond);
            if (written(angle) && !written(at_knee)) throw key_needs(test_, angle, knee);
        }
    }

    /// Checks the stiffnesses and the strength law of faces with the material values of a table.
    template <class Key>
    void face_numbers(const TestCase::MaterialKeys& m, const Key& key) const {
        try {
            // The values must be possible with and without the correction c_κ, which was measured only for meshes of
            // packed circles. Values that are possible only with it give a shear stiffness k_t close to 0.
            for (const double correction : {0.0, test_.face_correction()}) {
                parts::MaterialValues rock = m;
                rock.mesh_correction = correction;
                static_cast<void>(rock.face_moduli());
            }
        } catch (const InputError& error) {
            throw InputError(fmt::format(
                "{}: {}", test_.at(key(m.stiffness_ratio ? "stiffness_ratio" : "poissons_ratio")), error.what()));
        }
        if (!m.tensile_strength || !m.cohesion || !m.friction_angle) return;
        try {
            check_face_law(m.face_law());
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", test_.at(key("tensile_strength")), error.what()));
        }
    }

    /// Checks the material values of a table; some of them may come from another table.
    void numbers(const std::string& table, const TestCase::MaterialKeys& m) const {
        const auto key = [&](const char* name) {
            std::string own = fmt::format("{}.{}", table, name);
            if (written(own)) return own;
            // Errors for a pair refer only to the pair's own keys, since the minerals have been checked separately.
            return table.starts_with("mineral_pair") ? table + ".between" : std::string("material.") + name;
        };
        if (m.residual_friction_angle && m.friction_angle && *m.residual_friction_angle > *m.friction_angle)
            refuse(key("residual_friction_angle"), fmt::format("{} deg", *m.residual_friction_angle),
                   fmt::format("at most the friction_angle of {}, {} deg", table, *m.friction_angle),
                   "the friction angle of a broken bond must not exceed that of an intact bond");
        const BondLawFacts& bonds = test_.bond_facts();
        if (bonds.sticks && m.shear_stiffness == 0.0)
            refuse(key("shear_stiffness"), "0 N/m", fmt::format("a number > 0 with {} bonds", name_of(test_.bond.law)),
                   "these bonds resist shear through their shear stiffness");
        if (bonds.by_faces && m.youngs_modulus && m.poissons_ratio) face_numbers(m, key);
        if (!bonds.strengths_are_given || !m.tensile_strength || !m.cohesion || !m.friction_angle) return;
        const double friction = friction_coefficient(*m.friction_angle);
        if (!beyond_apex(friction, *m.tensile_strength, *m.cohesion)) return;
        const std::string unit = test_.area_units() ? "Pa" : "N";
        refuse(
            key("tensile_strength"), fmt::format("{} {}", *m.tensile_strength, unit),
            fmt::format("at most cohesion/tan(friction_angle) of {}, {:.6g} {}", table, *m.cohesion / friction, unit),
            "a larger value would lie beyond the apex of the bond's strength envelope; raise the cohesion or lower the "
            "tensile strength");
    }

    /// Checks the keys that a bond law allows and requires.
    void bond() const {
        const auto& b = test_.bond;
        const BondLawFacts& facts = test_.bond_facts();
        const std::string law = fmt::format("bond.law = {} (with back_tension, the overlap determines the strength)",
                                            laws_with(&BondLawFacts::strengths_are_given));
        for (const BondConstant& constant : all_bond_constants())
            if (facts.constant(constant.key) == nullptr) expect_materials_beside(constant.key, law);
        if (!facts.strengths_are_given) {
            for (const char* key :
                 {"bond.gap", "bond.tensile_factor", "bond.cohesion_factor", "bond.strength_cv", "bond.strength_seed"})
                expect_beside(key, law);
            if (b.range > 0.0) expect_beside("bond.range", law);
            if (b.strength_distribution != StrengthDistribution::none) expect_beside("bond.strength_distribution", law);
            return;
        }
        if (test_.numerics.contact_law != SegmentLaw::rounded && !facts.with_guide_segments)
            refuse("bond.law", fmt::format("\"{}\"", name_of(b.law)),
                   laws_with(&BondLawFacts::with_guide_segments) + " with the guide's contact law",
                   "alternatively, use contact_law = \"rounded\"");
        strength("tensile");
        strength("cohesion");
        const bool random = b.strength_distribution != StrengthDistribution::none;
        for (const char* key : {"bond.strength_cv", "bond.strength_seed"}) {
            if (random)
                need(key, fmt::format("strength_distribution = \"{}\" needs it", name_of(b.strength_distribution)));
            else
                expect_beside(key, "a strength_distribution other than \"none\"");
        }
        if (b.strength_distribution == StrengthDistribution::normal && *b.strength_cv > largest_normal_cv)
            refuse("bond.strength_cv", fmt::format("{}", *b.strength_cv), fmt::format("at most {}", largest_normal_cv),
                   "a normal distribution truncated at 0 cannot have a larger coefficient of variation; use weibull or "
                   "lognormal");
        if (test_.has_table("mesh") && b.range > 0.0)
            exclude("bond.range", "polygons bond only with neighbours that they touch; range is for circles");
    }

    /// Checks that a strength is given either by a value or by a factor.
    void strength(const std::string& which) const {
        const std::string number = "material." + (which == "tensile" ? std::string("tensile_strength") : which);
        const std::string factor = "bond." + which + "_factor";
        if (written(number) && written(factor)) exclude(factor, number + " gives the strength");
        if (!written(number) && !written(factor))
            need(number, fmt::format("bond.law = \"{}\" needs this key, or {}", name_of(test_.bond.law), factor));
        if (!written(factor)) return;
        exclude_of_materials(which == "tensile" ? "tensile_strength" : "cohesion",
                             factor + " determines this strength for all bonds");
        if (test_.has_table("mesh"))
            exclude(
                factor,
                "these polygons bond without overlap, so the factor has no back-tension to multiply; give " + number);
        if (test_.area_units()) exclude(factor, "with units = \"area\", strengths are in Pa; give " + number);
    }

    void mesh() const {
        if (!test_.has_table("mesh")) return;
        if (test_.mesh.kind == MeshKind::voronoi && test_.mesh.boundary == Boundary::centres) {
            refuse("mesh.boundary", "\"seeds\"", "\"domain\" with kind = \"voronoi\"",
                   "Voronoi cells always fill the domain");
        }
        const bool across_gaps = test_.bond_facts().bonds_across_gaps;
        if (across_gaps && !test_.mesh.thick && !test_.mesh.inset) {
            exclude("bond.thick", "mesh.thick is not given and is therefore derived; give both keys or neither");
            return;
        }
        if (!across_gaps)
            need("mesh.thick",
                 "with back_tension, the amount by which bond.thick exceeds mesh.thick determines the strength");
        const double gap = test_.mesh.inset ? 2.0 * *test_.mesh.inset : *test_.mesh.thick;
        if (across_gaps) {
            if (test_.bond.thick && *test_.bond.thick < gap)
                refuse("bond.thick", fmt::format("{} m", *test_.bond.thick), fmt::format("at least {} m", gap),
                       "faces at that distance would not bond; leave the key out");
            return;
        }
        need("bond.thick", "polygons bond only if bond.thick exceeds the gap between them");
        if (*test_.bond.thick <= gap) {
            refuse("bond.thick", fmt::format("{} m", *test_.bond.thick),
                   fmt::format("more than {} = {} m", test_.mesh.inset ? "twice mesh.inset" : "mesh.thick", gap),
                   "the difference is the overlap with which the polygons bond");
        }
    }

    void loading() const {
        if (test_.loading.axial_strain_rate && test_.loading.rate_tolerance) {
            refuse("loading.rate_tolerance", "a tolerance in addition to axial_strain_rate", "one of them",
                   "remove rate_tolerance, or remove axial_strain_rate to let the tolerance control the rate");
        }
        if (test_.loading.platens == PlatenKind::frictional) {
            if (kind_.bonded_because != nullptr)
                refuse("loading.platens", "\"frictional\"", "\"glued\" or \"bonded\" " + with_kind(),
                       kind_.bonded_because);
            need("loading.platen_friction_angle", "frictional platens need this key");
            if (test_.numerics.intact)
                refuse("numerics.intact", "true", "false with frictional platens",
                       "such platens act through contacts that form during the test, which intact = true prevents");
        } else {
            expect_beside("loading.platen_friction_angle",
                          "platens = \"frictional\" (bonded and glued platens have the specimen's friction angle)");
        }
        keys_of_kinds();
        turning_round();
        if (test_.confinement.by_walls() && test_.numerics.intact)
            refuse("numerics.intact", "true", "false with confinement.side = \"walls\"",
                   "walls act through unbonded contacts, which intact = true prevents");
        if (test_.loading.platens != PlatenKind::glued) expect_beside("loading.grip", "platens = \"glued\"");
    }

    /// Checks loading in which the platen reverses: unloading cycles at increasing strains or stresses, or lateral
    /// control.
    void turning_round() const {
        const TestCase::Loading& loading = test_.loading;
        if (loading.by_lateral_strain()) {
            if (!kind_.presses())
                refuse("loading.control", "\"lateral\"", "\"axial\" " + with_kind(),
                       "only a specimen that is compressed between platens widens");
            if (loading.unloads())
                refuse("loading.control", "\"lateral\"", "\"axial\" with unloading",
                       "this control already moves the platen back");
            if (loading.axial_strain_rate)
                refuse("loading.control", "\"lateral\" together with axial_strain_rate",
                       "a loading rate controlled by rate_tolerance",
                       "the platen's speed follows from the lateral strain; give rate_tolerance in place of the rate");
        }
        if (!loading.unloads()) {
            expect_beside("loading.unload_to", "loading.unload_at_strain or unload_at_stress");
            return;
        }
        const bool by_strain = loading.unload_at_strain.has_value();
        const std::string key = by_strain ? "loading.unload_at_strain" : "loading.unload_at_stress";
        if (by_strain && loading.unload_at_stress)
            refuse("loading.unload_at_stress", "stresses in addition to unload_at_strain", "one of them",
                   "remove the other");
        if (loading.axial_strain_rate)
            refuse(key, "unloading together with axial_strain_rate", "a loading rate controlled by rate_tolerance",
                   "a sudden reversal of the platen causes a shock wave; give rate_tolerance instead of the rate");
        const std::vector<double>& at = by_strain ? *loading.unload_at_strain : *loading.unload_at_stress;
        if (!std::ranges::is_sorted(at))
            refuse(key, fmt::format("[{}]", fmt::join(at, ", ")), "numbers in ascending order", "sort them");
        if (by_strain && at.back() >= loading.max_axial_strain)
            refuse(key, fmt::format("{}", at.back()),
                   fmt::format("strains below max_axial_strain = {}", loading.max_axial_strain),
                   "the test ends at max_axial_strain");
    }

    /// Checks the keys that belong to certain kinds of test, and the other keys that a kind requires.
    void keys_of_kinds() const {
        for (const std::string& other : names_of<LoadingKind>())
            for (const KindKey& one : test_kind(*from_name<LoadingKind>(other)).keys)
                if (!kind_.has(one.key))
                    expect_beside(one.key, "loading.kind = " +
                                               kinds_with([&](const TestKind& kind) { return kind.has(one.key); }));
        for (const KindKey& one : kind_.keys)
            if (one.needed != nullptr) need(one.key, one.needed);
        if (kind_.uniaxial) return;
        const bool frictional = test_.loading.platens == PlatenKind::frictional;
        if (!frictional && test_.loading.jaws.value_or(JawShape::arc) != JawShape::arc)
            refuse("loading.jaws", fmt::format("\"{}\"", name_of(*test_.loading.jaws)),
                   fmt::format("\"arc\" with platens = \"{}\"", name_of(test_.loading.platens)),
                   "a bonded jaw follows the outline of the disc; use platens = \"frictional\"");
        if (test_.loading.grip.value_or(0.0) > 0.0)
            refuse("loading.grip", fmt::format("{}", *test_.loading.grip), "0 or no value " + with_kind(),
                   "such a specimen has no ends that could be gripped");
        if (test_.has_table("mesh") && test_.mesh.boundary == Boundary::centres)
            refuse("mesh.boundary", "\"seeds\"", "\"domain\" " + with_kind(), "pads and jaws need flat faces");
        if (test_.shape.notch || kind_.notched) {
            if (test_.has_table("mesh") && !test_.bond_facts().bonds_across_gaps)
                refuse("bond.law", fmt::format("\"{}\"", name_of(test_.bond.law)),
                       laws_with(&BondLawFacts::bonds_across_gaps) + " with a notch in polygons",
                       "polygons on the two sides of the notch overlap without bonds, which would push them apart");
        }
    }

    std::string with_kind() const { return fmt::format("with kind = \"{}\"", name_of(test_.loading.kind)); }

    const TestCase& test_;
    const TestKind& kind_ = test_kind(test_.loading.kind);
};

}  // namespace

void check_consistency(const TestCase& test) { ConsistencyCheck(test).run(); }

}  // namespace crackle
