// SPDX-License-Identifier: GPL-3.0-or-later
// The world: the flat arrays that a step touches. Built once from a Scene; nothing in it is allocated during a step.
//
// A body's step state fills one cache line; contact points are compact records grouped by kind; the forces of a body's
// points are added up in a fixed order, so that the bytes of the result do not depend on the number of threads. Bodies
// are numbered in rows (build_world.cpp); `body_id` leads back to the input's numbers.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "solver/scene/scene.hpp"
#include "solver/world/speeds.hpp"
#include "solver/world/profile.hpp"

namespace crackle {

using BodyIndex = std::uint32_t;   // into World::bodies (internal numbering)
using PointIndex = std::uint32_t;  // into World::points
inline constexpr BodyIndex no_body = 0xffffffff;

/// What a step reads and writes of one body.
struct alignas(64) BodyState {
    double x, y;    // centroid, m
    double vx, vy;  // m/s, half a step behind x between steps (leapfrog)
    double omega;   // rad/s
    double
        shape[2];  // single circle: radius, 0; clump or chain: cos and sin of the turn since the body frame was taken
    double angle;  // rad, accumulated
};
static_assert(sizeof(BodyState) == 64);

/// Per degree of freedom, so that a driven one (inverse 0) needs no branch.
struct BodyInertia {
    double inverse_mass_x, inverse_mass_y, inverse_moment;
    double mass;
};
static_assert(sizeof(BodyInertia) == 32);

/// Sum of a body's contact forces (without gravity and applied loads), N and N m about its centroid.
struct alignas(32) BodyForce {
    double fx, fy, torque;
    double unused = 0.0;  // a point's record is added as a whole
};

/// What cannot change during a run, or is read only by observers.
struct BodyInfo {
    int id;
    std::uint16_t material;
    bool single_circle;
    bool closed;
    double moment;  // kg m2
    double reach;   // m, bounding radius of the elements about the centroid (circle radius included, thick not)
    std::uint32_t first_element, element_count;  // into World::elements (vertices or circles)
    std::uint32_t first_piece, piece_count;      // into World::pieces; 0 pieces: circles
};
static_assert(sizeof(BodyInfo) == 40);

/// A circle or a vertex of a clump or chain, or the one circle of a single-circle body, in the body frame.
struct Element {
    double x, y;          // m, from the centroid
    double radius;        // surface radius towards an outline or circle: circle r; vertex thick/2
    double target_reach;  // what an outline adds on its side: for a circle thick, for a vertex thick/2
};

/// A convex closed outline, or one open segment, in the body frame.
struct Piece {
    std::uint32_t first_edge, edge_count;  // into World::edges
    bool closed;
};

/// One edge in the body frame: start, unit direction (outward normal = direction turned by -90 degrees), length.
struct Edge {
    double x, y;
    double tx, ty;
    double length;
    /// What the corners at its start and its end are closest to: points `across` >= 0 in front of the edge's line and
    /// `over` beyond that end (negative at the start) with across + over·cone >= 0. cot θ and -cot θ, θ the angle by
    /// which the outline turns there; closed pieces only.
    double cone[2] = {0.0, 0.0};
    BodyIndex outline_of = no_body;  // the body whose outline is the one convex piece that this edge is of
};
static_assert(sizeof(Edge) == 64);

/// How a point's two sides look; points of one kind lie together and have a kernel of their own.
enum class PointKind : std::uint8_t {
    circle_circle = 0,    // two single circles
    element_element = 1,  // circles of which at least one belongs to a clump
    element_outline = 2,  // circle or vertex of body_i against the outline of body_j
    // The guide's law only (segment_contact.hpp); a segment goes by the element it begins at.
    disc_segment = 3,     // circle of body_i against segment feature_j of body_j
    segment_segment = 4,  // segments element_i of body_i and feature_j of body_j
    element_wall = 5,  // circle or vertex of body_i against a domain wall (body_j = Wall); feature_j = 1: a bare vertex
};
inline constexpr int point_kinds = 6;

/// Points whose force does not derive from a potential of the overlap.
constexpr bool by_guide(PointKind kind) {
    return kind == PointKind::disc_segment || kind == PointKind::segment_segment;
}

enum PointFlag : std::uint16_t {
    point_touching = 1,  // overlap > 0 or bonded, in the last force pass
    point_bonded = 2,
    point_sliding = 4,       // at the Coulomb limit in the last force pass
    point_slid = 8,          // has been at the limit since bonding (or since contact began)
    point_just_broken = 16,  // bond lost in the last force pass; cleared when its event is recorded
    point_counted = 32       // counts in World::step_bound
};

/// What meets at one contact point.
struct ContactPoint {
    BodyIndex body_i;
    BodyIndex body_j;         // Wall number for element_wall
    std::uint32_t element_i;  // into World::elements
    std::uint32_t
        feature_j;  // circle and segment kinds: element of j; outline: edge last faced (a hint, never physics)
};
static_assert(sizeof(ContactPoint) == 16);

/// Whether two points that are not with walls are between the same bodies.
inline bool same_pair(const ContactPoint& p, const ContactPoint& q) {
    return (p.body_i == q.body_i && p.body_j == q.body_j) || (p.body_i == q.body_j && p.body_j == q.body_i);
}

struct PointState {
    std::uint16_t law;    // into World::laws
    std::uint16_t flags;  // PointFlag
};
static_assert(sizeof(PointState) == 4);

/// Force of a point on body_i (body_j gets the opposite) and its moments about both centroids.
struct PointForce {
    double fx, fy;
    double torque_i, torque_j;
};
static_assert(sizeof(PointForce) == 32);

/// What the normal spring of a point under the guide's law has taken up. Its force is k_n(δ - δ0) at the resultant's
/// place, but δ does not change by the way of that place alone: there is no potential, so the work itself is added up,
/// by the trapezoidal rule over the drifts, which is leapfrog's own account of it.
struct SpringWork {
    PointForce last;  // N, N m, of the spring at the last force pass
    double stored;    // J
};

/// What an unbonded point remembers under the consistent integrator (contact_opening.hpp).
struct OpeningMemory {
    double defect = 0.0;       // J: stored beyond ½kδ(n)δ(n+1)
    double extra_force = 0.0;  // N, beyond kδ in the last force pass
    double overlap = unset;    // m, in the last force pass; unset in a new point
    double force = 0.0;        // N, spring and dashpot in the last force pass
};

/// What a pair of materials does at a contact point; the one place where joints or weak interfaces would come in.
struct ContactLaw {
    double normal_stiffness, shear_stiffness;  // N/m
    double normal_damping, shear_damping;      // N s/m, plus the ratio terms times sqrt(m_eff)
    double normal_damping_ratio_term;          // 2h sqrt(k_n), sqrt(N/m)
    double shear_damping_ratio_term;           // 2h sqrt(k_s)
    double friction;                           // μ = tan φ; infinite when sliding is switched off
    double break_overlap;  // m; a bond is lost at or below: 0, or -infinity when breaking is switched off
};

/// One broken bond.
struct BreakEvent {
    std::int64_t step;
    double time;          // s
    int body_i, body_j;   // input ids
    Vec2 position;        // m
    double orientation;   // rad, direction of the contact normal, in (-π/2, π/2]
    double energy;        // J: taken by the break, breaks.cpp
    double strength;      // N: k_n δ0
    double normal_force;  // N, of World::strong_normal
    double shear_force;   // N
    bool slid;
    bool shear_mode;         // slid and |f_t| > |f_n|; else tension
    bool last_of_interface;  // no bonded point is left between the two bodies
    PointKind kind;          // of the point
    ContactPoint point;      // by internal numbers, for readers that keep books by points
};

/// Energies at x_n, and what has gone since the start. All in J; signs as in DEMseg's energy.dat.
struct Ledger {
    double potential = 0.0;      // enrg: -Σ m g·x
    double kinetic = 0.0;        // enva: with the mean of v at n ± ½
    double strain = 0.0;         // enka: bonded points count from their bonded state
    double dashpot_loss = 0.0;   // enca
    double friction_loss = 0.0;  // enfr
    double fracture_loss = 0.0;  // ours; 0 in unbonded scenes
    double law_loss = 0.0;  // ours; left in springs of the guide's law when contacts ended; < 0: the law made energy
    double displacement_work = 0.0;  // enxd: done on the system by displacement- and velocity-driven bodies
    double force_work = 0.0;         // enxf
    /// (potential + kinetic + strain + losses - works) - the same at the start.
    double closing_error = 0.0;
};

/// One driven body with what it needs to account for its work.
struct ControlState {
    BodyIndex body;
    DofControl dof[3];        // x, y, rotation
    double start[3];          // position at the first step of the ramp
    std::int64_t first_step;  // step at which the ramp began
    std::int64_t ramp_steps;
    double last_force[3];  // driving force (N, N m) at the last force pass: the reaction, or the force applied
    double last_move[3];   // m, rad in the last step
};

/// Where a body was when the neighbour list was built.
struct ListReference {
    double x, y, angle;
};

/// Share of the stable bound that a derived step takes in a world without bonds, where contacts open and close.
/// Leapfrog has this happen at the end of a step and errs in energy by what grows with its square: the guide's circle,
/// bouncing 20 times without losses, has a largest closing error of 9.3 % of the energy of the fall at 0.2, 1.7 % at
/// 0.1 and 0.45 % at 0.05, and flies off at 0.8. Asked for: 2 %.
inline constexpr double loose_step_share = 0.1;

/// Points a force pass hands to one thread at a time; fixed, so that sums over blocks do not depend on the threads.
inline constexpr PointIndex block_points = 256;

/// In which order a step on World::threads threads goes through points and bodies (solver/stepping/sweep.cpp).
struct Sweep {
    bool valid = false;
    std::size_t largest_kind = 0;

    /// Some blocks of points of the largest kind, and the bodies that have no points beyond them.
    struct Chunk {
        PointIndex end_block;    // of that kind
        std::uint32_t end_body;  // into `order`
    };
    std::vector<Chunk> chunks;
    std::vector<std::uint32_t> thread_chunks;  // per thread: first of its chunks; one more at the end
    std::vector<BodyIndex> order;              // bodies of the chunks, late ones, driven ones
    std::uint32_t late_begin = 0;  // into `order`: bodies with points of the largest kind in chunks of several threads
    std::uint32_t driven_begin = 0;  // into `order`: bodies that a control drives

    // For several threads: what one cannot add to a body at once, because another's points come first.
    std::vector<std::uint16_t> owner;           // per body: thread that adds to it
    std::vector<std::uint8_t> defers;           // per block of the largest kind: has points for others' bodies
    std::vector<BodyForce> deferred;            // contributions of other threads
    std::vector<std::uint32_t> deferred_begin;  // per thread: its first in `deferred`
    std::vector<std::uint32_t> sources;         // into `deferred`, by body of `order` from late_begin on
    std::vector<std::uint32_t> sources_begin;
    std::vector<PointForce> smaller_kinds;  // forces of the points of all kinds but the largest

    /// What a thread has done of the present step.
    struct alignas(64) Share {
        Speeds speeds;
        std::uint32_t moved_end = 0;  // into `order`: bodies of its chunks moved so far end here
        bool broken = false;          // has met a broken bond
    };
    std::vector<Share> shares;
};

/// Widest common skin as a share of the median bounding radius: an intact specimen strains by less, and few idle points
/// are listed.
inline constexpr double skin_share = 0.1;

struct World {
    // ---- bodies
    std::vector<BodyState> bodies;
    std::vector<BodyInertia> inertia;
    /// Of the last force pass: after compute_forces() of all bodies, after step() of driven ones.
    std::vector<BodyForce> forces;
    bool forces_clear = false;           // those of all but driven bodies are 0
    std::vector<BodyForce> last_forces;  // of the pass before; consistent integrator only
    std::vector<BodyInfo> info;
    std::vector<Element> elements;
    std::vector<Piece> pieces;
    std::vector<Edge> edges;
    bool convex_outlines = true;  // every outline is one convex piece
    std::vector<Edge>
        segments;  // by element: the segment that begins there (length 0: none); empty without guide's law
    std::vector<ControlState> controls;
    std::vector<ContactLaw> laws;  // material pairs, row-major: law = a * materials + b; then materials against walls
    std::vector<Material> materials;

    // ---- contact points
    // Each quantity of a point in an array of its own: the kernels take those of neighbouring points as they lie, and
    // what a step does not change is not written back.
    std::vector<ContactPoint> points;  // grouped by kind, ordered by (i, j, element) within (but for fours_end)
    std::vector<PointState> point_states;
    std::vector<double> shear_forces;   // elastic, N on body_i along the normal (i to j) turned by +90 degrees
    std::vector<double> bond_overlaps;  // δ0, m; back-tension f_b = -k_n δ0
    std::vector<double> root_masses;    // square root of the effective mass, sqrt(kg)
    std::array<PointIndex, point_kinds + 1> kind_begin{};
    /// Points of element_outline up to here lie in fours, each four between the same two bodies: the interfaces of a
    /// mesh. The others of that kind follow.
    PointIndex fours_end = 0;
    std::vector<PointForce> point_forces;  // of the last force pass; empty unless kept
    bool keep_point_forces = true;         // looked at when the list is rebuilt
    // Dashpot forces of the last force pass, N: their work is taken by the trapezoidal rule. Empty without the ledger.
    // Floats, like strong forces: they are reported, no motion follows from them, and they are much of what is moved.
    std::vector<float> normal_dashpot, shear_dashpot;
    std::vector<SpringWork> spring_work;  // empty without the ledger or the guide's law
    std::vector<OpeningMemory> openings;  // empty without the consistent integrator
    std::vector<double> owed;             // J per body: defects of points that have left the list; empty likewise
    // Elastic forces of a bonded point in the last step in which it carried at least half its strength, N: normal,
    // compression positive, and shear. Empty without bonds.
    std::vector<float> strong_normal, strong_shear;
    Sweep sweep;  // never saved

    // ---- neighbour list
    double skin = 0.0;         // m
    double widest_skin = 0.0;  // m; in a bonded world the skin follows the motion up to this; 0: it stays as given
    // m per body: how far its surface may move until the list is rebuilt; half the skin, or more for a fast body.
    std::vector<double> half_skins;
    std::vector<ListReference> list_reference;
    std::vector<double> turning_reach;     // m per body: how far turning moves its surface (0: single circles)
    bool some_turn = false;                // any of these is not 0
    std::vector<std::uint32_t> size_rank;  // bodies by bounding radius, largest 0; a pair is found by its larger body
    std::vector<double> largest_smaller;   // m per body: bounding radius of the next in that order
    double travelled = 0.0;                // m, bound on any surface point's way since ways were last looked at
    double free_way = 0.0;                 // m, that every surface point can go from there within its half skin
    double fastest = 0.0;                  // m/s, largest surface speed in the last step
    double fastest_allowed_move = 0.0;     // m a step: half the smallest body, beyond which contacts would be missed
    bool list_valid = false;
    std::int64_t list_step = 0;  // step at which the list was built
    std::int64_t list_builds = 0;

    // ---- scene-wide
    Domain domain;
    double thick = 0.0;
    SegmentLaw segment_law = SegmentLaw::rounded;
    Integrator integrator = Integrator::leapfrog;
    Vec2 gravity;
    double time_step = 0.0;       // s
    double drift = 0.0;           // s, length of the drift that led to the present positions (0 before the first)
    bool automatic_step = false;  // may be lowered when the list is rebuilt
    double step_scale = 1.0;      // of derived steps
    double safety_factor = 0.8;
    double step_bound = std::numeric_limits<double>::infinity();  // s, guaranteed stable below, of the counted points
    BodyIndex limiting_body = 0;                                  // sets step_bound
    std::vector<double> step_weights;                             // per body, see stable_step.cpp
    double weighed_bound = 0.0;                                   // s, step_bound when step_weights were found
    std::uint64_t weighed_points = 0;                             // listed then
    std::vector<std::uint8_t> marks;  // per body, 0 but within count_new_points(); never saved
    double exact_step = 0.0;          // s, exact stable step when bonds were made; 0: no bonds yet
    bool exact_step_proved = false;
    double step_goal = 0.0;  // s, what a derived step goes back to: safety_factor times the exact one; 0: none
    bool allow_unstable = false;
    bool has_bonds = false;
    bool ledger_on = true;
    IntactOptions intact;
    int threads = 1;

    // ---- progress
    std::int64_t step = 0;           // steps done
    double time = 0.0;               // s
    bool forces_current = false;     // the force pass at the present positions is done
    double kick_share = 0.5;         // share of a full kick in the next step: the first kick of leapfrog
    std::vector<BreakEvent> events;  // broken bonds; readers may clear it
    std::int64_t bonds_initial = 0, bonds_broken = 0;
    std::int64_t interfaces_initial = 0, interfaces_lost = 0;

    // ---- ledger accumulators, one a block of points, added up in block order
    struct LossBlock {
        double dashpot = 0.0, friction = 0.0, law = 0.0;
        std::uint32_t broken = 0;
        std::uint32_t gained = 0;  // points that carry load and are not counted in step_bound yet
    };
    bool points_gained = false;  // some block has: they are counted before the next force pass
    std::vector<LossBlock> loss_blocks;
    double dashpot_loss = 0.0, friction_loss = 0.0, fracture_loss = 0.0, law_loss = 0.0;
    double displacement_work = 0.0, force_work = 0.0;
    std::vector<std::int64_t> thread_blocks;  // blocks of points each thread has done (never saved)
    Profile* profile = nullptr;               // times the phases where set (never saved)
    double initial_energy = 0.0;
    bool initial_energy_taken = false;
    double largest_supply = 0.0;  // J, for the runaway check
};

/// Part of the coming kick that lies before time n, s: half of the drift that led here (of the coming one where a deck
/// starts with a full kick), nothing at a half-kick start. Kicks join the middles of drifts, whatever their lengths.
inline double kick_before(const World& world) {
    if (world.kick_share < 1.0) return 0.0;
    return 0.5 * (world.drift > 0.0 ? world.drift : world.time_step);
}

/// Everything about one contact point at the present positions, for outputs, solves and checks (never for the step).
struct PointView {
    PointKind kind;
    BodyIndex body_i, body_j;
    double overlap;       // δ, m
    Vec2 normal;          // unit, from i to j
    Vec2 position;        // m, midway between the two surfaces
    Vec2 arm_i, arm_j;    // m, from the centroids to the position (arm_j zero for walls)
    double normal_force;  // elastic: k_n(δ - δ0), N, compression positive (0 when not touching)
    double shear_force;   // elastic, N on i along the normal turned by +90 degrees
    double normal_stiffness, shear_stiffness, friction;
    double bond_overlap;
    /// Of δ by the motions of i (x, y in m, rotation in rad) and of j. Under the rounded law (n, arm × n) and its
    /// opposite, the directions in which the force works; under the guide's it differs from them.
    std::array<double, 6> overlap_gradient;
    bool bonded, touching, sliding, slid;
};

/// Of two bodies, into World::laws.
inline std::size_t law_between(const World& world, BodyIndex i, BodyIndex j) {
    return world.info[i].material * world.materials.size() + world.info[j].material;
}

/// Whether springs of the guide's law have their work added up.
inline bool keeps_spring_work(const World& world) {
    return world.ledger_on && world.segment_law != SegmentLaw::rounded;
}

// ---- building and stepping (solver/stepping/build_world.cpp, solver/stepping/step.cpp)

/// Validates the scene and lays it out. @throws InputError (a time step above the bound included, naming both).
World build_world(Scene scene);

/// Brings the neighbour list up to date and does the force pass at the present positions; idempotent until advance().
void compute_forces(World& world);
/// Kick and drift: controls, velocities, positions, time. Needs compute_forces().
void advance(World& world);
/// One step: compute_forces() and advance().
void step(World& world);

// ---- neighbours (solver/neighbours/neighbours.cpp)
/// Rebuilds the list if something has moved half the skin since it was built (always when list_valid is false).
/// @throws UnstableRun if the stable bound is below a time step that was given (not with allow_unstable).
void refresh_neighbours(World& world);

// ---- bonding (solver/stepping/bonding.cpp)
/// Back-tension bonding: every point of overlap δ > 0 between bodies gets δ0 = δ and loses its shear spring. Walls stay
/// unbonded. Sets the segment thickness first. @return points bonded.
std::int64_t bond_all(World& world, double thick);
/// After bonds have been entered in the points (flags, bond_overlap), by bond_all() or a reader of back-tensions:
/// counts them, clears what was remembered of the time before, and starts the account of energy anew.
void finish_bonding(World& world);
/// Changes the segment thickness and invalidates the list.
void set_thickness(World& world, double thick);

// ---- measuring (solver/measure/point_view.cpp, solver/measure/ledger.cpp)
/// Saves time and memory where nobody will ask for the forces of single points or those on walls.
void forget_point_forces(World& world);
/// Only the overlap of it, m.
double overlap_of(const World& world, PointIndex point);
PointView view_point(const World& world, PointIndex point);
/// First and behind the last of the points between the bodies of a point that is not with a wall: they lie together.
std::pair<PointIndex, PointIndex> points_between(const World& world, PointIndex point);
/// Number of the internal index of an input id; throws InputError if there is none.
BodyIndex body_of_id(const World& world, int id);
/// Strain energy of a point, J, from its bonded state: ½k_n(δ-δ0)² + ½f_t²/k_s, under the guide's law the work its
/// normal spring has taken up in place of the first (without the ledger that first term, an estimate there).
double stored_energy(const World& world, PointIndex point);
/// Energies at x_n; call between compute_forces() and advance().
Ledger measure_ledger(const World& world);
/// Force of the bodies on each wall at the last force pass, N. @throws std::logic_error where they are not kept
std::array<Vec2, 4> measure_wall_forces(const World& world);
/// World-frame corners of a chain body, or circle centres of a circle body, in input order.
std::vector<Vec2> element_positions(const World& world, BodyIndex body);
/// @throws UnstableRun on a value that is not a number, runaway energy, or a body that left the world.
void check_health(World& world);

// ---- stable step (solver/linear/stable_step.cpp; exact: solver/linear/critical_step.hpp)
/// Guaranteed bound on the stable step, s: 4M - 2Δt·C - Δt²·K stays positive definite below it, over all listed points
/// as if they carried load. Derivation: stable_step.cpp.
/// @param limiting receives the body that sets the bound; left as it is where none does.
double stable_step_bound(const World& world, BodyIndex* limiting = nullptr);
/// World::step_bound anew, of the points that carry load (without bonds: of all listed ones), and the step kept below.
/// @throws UnstableRun if a time step that was given lies above it (not with allow_unstable)
void evaluate_step_bound(World& world);
/// Lowers World::step_bound by the points that came to carry load in the last force pass, and the coming steps with it.
/// @throws UnstableRun as above
void count_new_points(World& world);
/// A derived step is lowered to what step_bound allows (up to step_goal again when it rises). @throws UnstableRun
void keep_step_below_bound(World& world);
/// Takes a given step in place of a derived one, up to the exact limit of the points that carry load now.
/// @throws UnstableRun if it lies above (not with allow_unstable)
void set_time_step(World& world, double time_step);
/// Share of the bound that a derived step takes: step_scale times safety_factor, without bonds at most
/// loose_step_share.
double derived_step_share(const World& world);

// ---- checkpoint (solver/world/checkpoint.cpp)
/// Complete state, versioned; straight and restarted runs agree byte for byte.
void save_world(const World& world, std::ostream& out);
std::string save_world(const World& world);
/// @throws InputError on a foreign, truncated or newer checkpoint; `name` is used in the message.
World load_world(const std::string& bytes, const std::string& name);
/// Number of threads of the coming steps; never changes a result. @throws InputError outside 1..1024
void set_threads(World& world, int threads);

}  // namespace crackle
