#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "fem/material/prony_term.hpp"
#include "sim/base/error.hpp"
#include "sim/base/length_unit.hpp"

namespace articular::fem {
struct AnyMaterial;
}

/// A scenario as the user wrote it, in SI units: plain data, no meshes loaded, nothing looked up.
/// The TOML form of every field is documented in scenarios/README.md.
namespace articular::sim {

using Vec3 = Eigen::Vector3d;

/// A value over time: piecewise linear, constant before the first and after the last time.
/// Empty = the constant 1.
struct Curve {
  std::vector<double> time;   // [s], strictly increasing
  std::vector<double> value;  // as many
};

/// A path over time of a driven body, or of a rigid one's held freedoms: along and about the axes
/// of its hold.
struct Motion {
  /// Between two times: smoothstep, which rests at each of them; linear; a cubic spline through
  /// all, with continuous accelerations.
  enum class Interpolation { Smooth, Linear, Spline };
  /// A spline at its first and last time: comes to rest, or has no acceleration and goes on beyond
  /// at the velocity that it has there.
  enum class Ends { Rest, Moving };
  std::vector<double> time;       // [s], strictly increasing
  std::vector<Vec3> translation;  // [m], from the reference pose; empty = none
  std::vector<Vec3> rotation;     // rotation vector [rad], about `about`; empty = none
  Vec3 about = Vec3::Zero();      // [m], world
  Interpolation interpolation = Interpolation::Smooth;
  Ends ends = Ends::Rest;
  // Of a spline: second derivatives at the times, see fit_spline().
  std::vector<Vec3> translation_bend = {}, rotation_bend = {};
};

/// A part of a mesh's nodes: those inside every condition given. No condition = every node.
struct Region {
  std::optional<std::pair<Vec3, Vec3>> box;       // min, max corner [m]
  std::optional<std::pair<Vec3, double>> sphere;  // centre, radius [m]
  std::optional<std::pair<std::string, double>>
      near_body;                   // within a distance [m] of a body's surface
  std::optional<std::string> set;  // of the mesh of the body that the region is of
  bool surface_only = false;
  Location where;
};

/// An axis-aligned block of tetrahedra (six a cell).
struct BoxGeometry {
  Vec3 size = Vec3::Zero();  // [m]
  Eigen::Vector3i cells = Eigen::Vector3i::Ones();
  Vec3 center = Vec3::Zero();  // [m]
};

/// A block of tetrahedra (six a cell) with any eight corners, trilinear between them.
struct HexahedronGeometry {
  Eigen::Matrix<double, 3, 8> corners;  // [m], ordered as VTK's hexahedron
  Eigen::Vector3i cells = Eigen::Vector3i::Ones();
};

/// A solid ball of tetrahedra.
struct SphereGeometry {
  double radius = 0;           // [m]
  double element_size = 0;     // [m]
  Vec3 center = Vec3::Zero();  // [m]
};

/// The article's V-shape: two square legs that meet at the origin and open along +z in the x-z
/// plane.
struct VShapeGeometry {
  double leg_length = 0;                            // [m], from the tip
  double width = 0;                                 // [m], the side of the square section
  double angle = 0;                                 // [rad], between the legs
  Eigen::Vector2i cells = Eigen::Vector2i::Ones();  // along a leg, across it
};

/// Fibres as a cell array of the mesh with three components has them.
struct FibreArray {
  std::string name;
};

/// Fibres along the gradient of the harmonic field between two regions.
struct FibresBetween {
  Region from, to;
};

/// A tissue's fibres at the start. A vector: the same direction everywhere, of length 1.
struct Fibres {
  std::variant<Vec3, FibreArray, FibresBetween> along;
  /// How many there are in an area: the same everywhere, or the same ones from end to end, as the
  /// lengths of an array's vectors and the flux of a harmonic field say.
  enum class Density { Even, Conserved } density = Density::Even;
  Location where = {};
};

struct TissueMaterial {
  std::shared_ptr<const fem::AnyMaterial> law;
  std::optional<Fibres> fibres;  // where the law has them
  /// Plain linear tetrahedra, or smoothed ones that do not lock.
  enum class Element { Plain, Smoothed } element = Element::Smoothed;
  double mass_damping = 0;       // α [1/s] of Rayleigh damping
  double stiffness_damping = 0;  // β [s]
  std::vector<fem::PronyTerm> relaxation;
  Location where;
};

/// A compliant layer on a rigid surface (cartilage, periodontal ligament): an elastic foundation of
/// stiffness (1-nu)E / ((1+nu)(1-2nu)h) per area, in series with the contact stiffness [EFM]. Or,
/// Logarithmic, one that begins so and stiffens as it is pressed flat, see layer_law.hpp.
struct Layer {
  enum class Law { Linear, Logarithmic };
  double thickness = 0;      // [m]
  double young_modulus = 0;  // [Pa]
  double poisson_ratio = 0;
  Law law = Law::Linear;
};

/// A rigid change of frame of everything a body reads from files: x -> scale * R (x - about) +
/// about + translation.
struct Placement {
  Vec3 rotation = Vec3::Zero();     // rotation vector [rad]
  Vec3 about = Vec3::Zero();        // [m]
  Vec3 translation = Vec3::Zero();  // [m]
  double scale = 1;
};

/// How a contact surface goes on where it was cut off, see mesh_continue.hpp.
struct Continuation {
  Vec3 at = Vec3::Zero();          // [m], a point of the plane of the cut, in the placed frame
  Vec3 direction = Vec3::UnitX();  // unit vector, across that plane
  double length = 0;               // [m]
  double easing = 0;               // [m], over which the slope at the cut fades out
};

/// A mesh file of a body. For contact of rigid bodies: only faces whose normal is within 80 degrees
/// of `facing` (if given) take part.
struct MeshFile {
  std::filesystem::path path;      // as resolved against the scenario's folder, variables replaced
  double unit = 1e-3;              // [m] per unit of the file
  std::vector<std::string> parts;  // only the elements of these sets; empty: all
  Placement placement;
  std::optional<Vec3> facing;                // contact: unit vector, in the placed frame
  std::optional<std::pair<Vec3, Vec3>> box;  // contact: min, max corner [m], in the placed frame
  std::optional<int> faces;  // contact: simplify to about this many triangles, of what is kept
  std::optional<Continuation> continued;  // contact: after `faces`
  std::string made_by;                    // what makes the file: told when it is missing
  Location where;
};

/// Freedoms of a rigid body that are held: of the motion of its point `at`, along axes that stand
/// in space.
struct Hold {
  std::array<bool, 6> held{};  // translation along each axis, rotation about each
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns
  std::optional<Vec3> at;  // [m], world at the start; default: the centre of mass
};

struct Body {
  enum class Kind { Fixed, Rigid, Tissue };
  std::string name;
  Kind kind = Kind::Tissue;
  /// None: a fixed body that only carries points.
  std::variant<std::monostate, MeshFile, BoxGeometry, HexahedronGeometry, SphereGeometry,
               VShapeGeometry>
      geometry;
  Placement placement;  // of a built-in geometry

  std::vector<MeshFile> contact_meshes;  // rigid bodies: surfaces that touch, in place of the mesh
  bool collides = true;
  std::optional<TissueMaterial> material;  // tissue: needed
  std::optional<double> density;           // [kg/m^3]; tissue: needed; rigid: or mass
  std::optional<double> mass;              // [kg], rigid
  std::optional<Vec3> center_of_mass;      // [m], rigid, world at the start; default from the mesh
  std::optional<Eigen::Matrix3d>
      inertia;  // [kg m^2], rigid, about the centre of mass; default from the mesh
  std::optional<Layer> layer;
  Vec3 velocity = Vec3::Zero();          // [m/s] at the start
  Vec3 angular_velocity = Vec3::Zero();  // [rad/s] at the start, rigid
  std::optional<Hold> hold;              // rigid
  Location where;
};

/// Tissue nodes of a region move with a rigid body.
struct Attachment {
  std::string body;  // tissue
  std::string to;    // fixed or rigid
  Region region;
  Location where;
};

/// Tissue nodes of a region move along axes that stand in space as a MotionLoad says, or not at
/// all: a roller, a plane of symmetry, a grip.
struct Support {
  std::string name;  // may be empty
  std::string body;  // tissue
  Region region;
  Eigen::Matrix3Xd held;  // one to three of these axes: orthogonal unit vectors, world
  Location where;
  std::vector<int> freedoms = {};  // of each of them: which of x, y, z it was written as
};

/// A point of a line, a load or a probe, or with a radius > 0 the tissue's surface nodes within it:
/// see anchored_point().
struct Anchor {
  std::string body;
  Vec3 point = Vec3::Zero();  // [m], world at the start
  double radius = 0;          // [m]
  Location where;
  bool beyond_mesh = false;  // the rigid body goes on beyond its mesh, and the point lies there
};

struct Muscle {
  enum class ForceLengthCurve { Cosine, Parabola };  // see sim/lines/muscle_law.hpp
  std::string name;
  std::string tissue;             // whose fibres it activates; empty: a line, for which the rest is
  std::vector<Anchor> path;       // from origin to insertion, via points between; at least 2
  std::vector<std::string> wrap;  // fixed or rigid bodies that it wraps around
  Curve beyond;                   // [m], tendon past the end of the path; empty = none
  double max_force = 0;           // [N], isometric, at full activation
  std::optional<double> optimal_length;  // [m]; default: length of the path at the start
  double max_length_ratio =
      1.3;  // length at which the passive force reaches its maximum / optimal length
  double tendon_ratio = 0;          // tendon length / optimal length (Peck)
  double passive_fraction = 0.015;  // passive force at maximal length / max_force
  double max_velocity = 10;         // [optimal lengths of the fibres, without tendon / s]
  bool force_length = true;         // false: activation times max_force, at any length and speed
  ForceLengthCurve force_length_curve = ForceLengthCurve::Cosine;
  double activation_time = 0.015;    // [s]
  double deactivation_time = 0.050;  // [s]
  Curve excitation;                  // 0..1; empty = 0
  Location where;
};

struct Ligament {
  enum class Law { Linear, Blankevoort };
  std::string name;
  std::vector<Anchor> path;       // at least 2
  std::vector<std::string> wrap;  // fixed or rigid bodies that it wraps around
  Law law = Law::Linear;
  double stiffness = 0;      // Linear: [N/m]; Blankevoort: [N] per unit strain
  double toe_strain = 0.03;  // Blankevoort's eps_l
  double damping = 0;        // [N s/m], while stretching; at most the elastic tension
  // Slack length: the first one given of these, else the length at the start.
  std::optional<double> slack_length;      // [m]
  std::optional<double> slack_extension;   // [m], added to the length at the start
  std::optional<double> reference_strain;  // slack length = length at the start / (1 + strain)
  Location where;
};

/// Food between two points that pushes them apart as it is crushed: see sim/lines/bolus_law.hpp.
struct Bolus {
  std::string name;
  std::vector<Anchor> path;        // from the upper teeth to the lower ones; 2
  double from = 0;                 // [s] when it is put in
  std::optional<double> height;    // [m]; default: what is between the points then
  Curve force;                     // [N], over a depth [m] in place of a time, from 0 on
  double unloading_stiffness = 0;  // [N/m], no slope of `force` is larger
  double force_kept = 1;           // share of `force` that is left each time it was let go
  Location where;
};

struct GravityLoad {
  Vec3 acceleration = Vec3::Zero();  // [m/s^2]
  Location where;
  Curve profile = {};  // factor over time
};

struct TissueRegion {
  std::string tissue;
  Region region;
};

struct ForceLoad {
  std::variant<Anchor, TissueRegion> at;  // in a region: equal shares on its nodes
  Vec3 force = Vec3::Zero();              // [N], dead
  Curve profile;                          // factor over time
  Location where;
};

/// A moment on a rigid body.
struct MomentLoad {
  std::string body;
  Vec3 moment = Vec3::Zero();  // [N m]; its axis stays in space
  Curve profile;               // factor over time
  Location where;
};

/// A thin sheet of fibres on the faces of a tissue's surface whose middles lie in a region: an
/// aponeurosis, a fascia, a capsule. See fem::FibreSheet.
struct Sheet {
  std::string name;
  TissueRegion at;
  double thickness = 0;          // [m]
  double young_modulus = 0;      // [Pa], of straight fibres
  double toe_strain = 0.03;      // see fem::CrimpedFibre
  std::optional<Fibres> fibres;  // none: those of the tissue
  Location where;
};

/// Force on the faces of a tissue's surface whose middles lie in a region.
struct SurfaceLoad {
  TissueRegion at;
  /// [Pa]: a pressure, which stays normal to the surface and acts on the area that this has; or a
  /// traction, a force of constant direction by the area at the start.
  std::variant<double, Vec3> stress;
  Curve profile;  // factor over time
  Location where;
};

struct MotionLoad {
  std::string body;     // a fixed one, or a rigid one with hold; empty:
  std::string support;  // what it holds moves, by translations in the world's axes
  Motion motion;
  Location where;
};

using Load = std::variant<GravityLoad, ForceLoad, MomentLoad, SurfaceLoad, MotionLoad>;

/// Without any of these every pair of bodies can meet, and none meets itself.
struct ContactPair {
  /// Two bodies, a == b: the body with itself. Where one of the names or both are patterns
  /// (name_pattern.hpp): every pair of a body that fits a and another that fits b, but for two
  /// fixed ones. Of entries that fit a pair the one with fewer patterns holds, then the later one.
  std::string a, b;
  Location where;
  double friction = 0;                       // coefficient; dynamic analysis only
  std::optional<double> slip_velocity = {};  // [m/s] that friction takes for rest; default: chosen
  double damping = 0;                        // pressure per closing velocity [Pa s/m]
};

/// A body's axes at the start for joint coordinates, see joint_coordinates.hpp.
struct JointSide {
  std::string body;
  Vec3 origin = Vec3::Zero();   // [m], world
  Vec3 lateral = Vec3::Zero();  // unit vectors, world, not parallel
  Vec3 up = Vec3::Zero();
};

/// Position, of a bone's frame or the world's: where the place would be, had the bone not moved.
struct PointProbe {
  Anchor anchor;
  std::string frame = {};  // a fixed or rigid body; empty: the world
};

/// Velocity of a place, and how far it has come: in a frame, as above.
struct WayProbe {
  Anchor anchor;
  std::string frame = {};
};

/// The axis about which a fixed or rigid body has turned since the start, and turns now, in the
/// frame of another or the world's.
struct HelicalAxisProbe {
  std::string body;
  std::string frame = {};
  Vec3 point = Vec3::Zero();  // [m], of the body, world at the start: the axis is shown near it
};

/// Rotation of a rigid body about an axis.
struct AngleProbe {
  std::string body;
  Vec3 axis = Vec3::UnitX();  // unit vector
};

/// What a sensor or a pressure film between surfaces resolves; 0: not asked for.
struct PressureSensor {
  double spot = 0;       // diameter of a spot for its largest mean pressure [m]
  double threshold = 0;  // least pressure of the area that it shows [Pa]
};

/// What two bodies, or one with itself, put on each other: as it acts on the first.
struct ContactProbe {
  std::string first, second;
  std::optional<Region> region = {};  // only through this part of the first body's surface
  PressureSensor sensor = {};
};

/// Force and length of a muscle or ligament.
struct LineProbe {
  std::string line;
};

/// Moment arm of a muscle or ligament about an axis that goes with a fixed or rigid body.
struct MomentArmProbe {
  std::string line;
  std::string body;
  Vec3 point = Vec3::Zero();  // [m], of the axis, world at the start
  Vec3 axis = Vec3::UnitX();  // unit vector, world at the start
};

/// Moment of muscles on a fixed or rigid body about an axis that goes with it.
struct MuscleMomentProbe {
  std::vector<std::string> muscles;  // names of those that count
  std::string body;
  Vec3 point = Vec3::Zero();  // [m], of the axis, world at the start
  Vec3 axis = Vec3::UnitX();  // unit vector, world at the start
};

/// Where a muscle or ligament lies on the bodies that it wraps around.
struct WrapProbe {
  std::string line;
};

/// The energies of the whole scene.
struct EnergyProbe {};

/// What holds a fixed body, or a rigid one with hold.
struct ReactionProbe {
  std::string body;
};

/// What tissue puts on a support.
struct SupportProbe {
  std::string support;
};

/// What a tissue puts on a rigid body by the nodes attached to it.
struct AttachmentProbe {
  std::string tissue;
  std::string rigid;
};

/// How far the fibres of a tissue are drawn out.
struct FibresProbe {
  std::string tissue;
};

/// How large a tissue is, and how far its elements grow and shrink.
struct VolumeProbe {
  std::string tissue;
};

/// How far the fibres of a sheet are drawn out, and how they pull.
struct SheetProbe {
  std::string sheet;
};

/// How far a tissue reaches along an axis that goes with a fixed or rigid body.
struct ExtentProbe {
  std::string tissue;
  std::string frame;
  Vec3 point = Vec3::Zero();      // [m], where the axis begins, world at the start
  Vec3 direction = Vec3::Zero();  // unit vector, world at the start
};

/// The forces of some probes divided by those of others, both along a direction.
struct ShareProbe {
  std::vector<std::string> part, whole;  // names of probes with forces
  Vec3 direction = Vec3::Zero();         // unit vector
};

/// Several contact probes as one: sums of forces and areas, the largest of pressures.
struct ContactsProbe {
  std::vector<std::string> of;  // names of contact probes
  PressureSensor sensor = {};   // under all of them together
};

/// Stress in a tissue, or in a part of it.
struct StressProbe {
  std::string tissue;
  std::optional<Region> region = {};  // of elements whose middle lies there at the start
};

/// Joint coordinates of two bodies.
struct JointProbe {
  JointSide proximal, distal;
  bool is_right = true;  // of the right side of the body
};

struct Probe {
  std::string name;
  std::variant<PointProbe, WayProbe, AngleProbe, HelicalAxisProbe, ContactProbe, ContactsProbe,
               LineProbe, MomentArmProbe, MuscleMomentProbe, WrapProbe, EnergyProbe, ReactionProbe,
               SupportProbe, AttachmentProbe, FibresProbe, VolumeProbe, SheetProbe, StressProbe,
               ExtentProbe, ShareProbe, JointProbe>
      what;
  Location where = {};
};

struct Integrator {
  enum class Scheme { ImplicitEuler, TrBdf2, Dirk3, Explicit };
  enum class Solver { Auto, Cholesky, ConjugateGradients, Multigrid };
  Scheme scheme = Scheme::ImplicitEuler;
  Solver solver = Solver::Auto;
  double step = 1e-3;  // [s]
  /// [m], of the Newton iteration; default: `element_tolerance` of the elements' size.
  std::optional<double> position_tolerance;
  double element_tolerance = 5e-4;
  int max_iterations = 20;  // Newton iterations before the step is halved
};

struct Detection {
  /// The tree that penetrations are searched by: blocks that move with the tissue, or the article's
  /// buckets, which are filled anew. The pairs are the same.
  enum class Tree { Blocks, Buckets } tree = Tree::Blocks;
};

struct Output {
  double interval = 10e-3;  // [s] between frames; of a static analysis the load step unless given
  LengthUnit length_unit;
  std::optional<std::filesystem::path> directory;
  bool frames = true;             // else the tables and the summary alone
  bool contact_surfaces = false;  // a file of its own for the surface that each body touches with
  std::optional<double> checkpoint_interval;  // [s]; none: see run.cpp
  std::vector<std::string> directions;        // words for +x, +y, +z, for pictures; empty: none
};

struct Scenario {
  std::filesystem::path file;
  std::string title;
  std::string name;     // file name without ending: names the results
  double duration = 0;  // [s]
  enum class Analysis { Dynamic, Static } analysis = Analysis::Dynamic;
  enum class Accuracy { Fast, Balanced, Accurate } accuracy = Accuracy::Balanced;
  Integrator integrator;
  Detection detection;
  // Of the run, not of the file: results have the same bits with any number of threads, and with
  // arithmetic that all processors share on all of them (fem/solver/processor.hpp).
  int threads = 1;
  bool reproducible = false;
  std::vector<Body> bodies;
  std::vector<Attachment> attachments;
  std::vector<Support> supports;
  std::vector<Sheet> sheets;
  std::vector<Muscle> muscles;
  std::vector<Ligament> ligaments;
  std::vector<Bolus> boluses;
  std::vector<Load> loads;
  bool contact = true;  // `contact = false`: nothing touches
  /// Of a dynamic analysis: depths count point by point, or as averages at nodes, which is what a
  /// static one does.
  enum class Response { Pointwise, Averaged } contact_response = Response::Averaged;
  /// Of averaged depths in a dynamic analysis: contact is this many times as stiff as the elements
  /// at the surface; default: chosen by the scheme.
  std::optional<double> contact_stiffness_factor;
  std::vector<ContactPair> contacts;
  std::vector<Probe> probes;
  Output output;
  /// The words of [choice], by name: see scenario_choices.hpp.
  std::vector<std::pair<std::string, std::string>> choices;
  /// The settings after presets and overrides, as JSON text, for summary.json.
  std::string settings_json;
  /// All files that it names, and it itself.
  std::vector<std::filesystem::path> files;
  /// What the file says after overrides, without comments and layout: checkpoints belong to it.
  std::string content;
  /// What it says and hardly means, one line each, with the place: see curve_doubts.hpp.
  std::vector<std::string> doubts;
};

/// Index into its bodies. @throws InputError when there is none of that name
int body_index(const Scenario& scenario, const std::string& name);

/// Reads and checks a scenario file.
/// @param overrides  "path=value", e.g. "duration=0.1 s",
/// "body.disc_left.material.poisson_ratio=0.3",
///                   "integrator.step=0.5 ms"; entries of arrays of tables by their name or number
/// @throws InputError with file:line:column for anything that is not a valid scenario
Scenario read_scenario(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});

}  // namespace articular::sim
