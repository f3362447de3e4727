#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "collision/mesh/surface.hpp"
#include "fem/element/dashpots.hpp"
#include "fem/element/fibre_drag.hpp"
#include "fem/element/fibre_sheet.hpp"
#include "fem/element/relaxation.hpp"
#include "fem/solver/solver_choice.hpp"
#include "parallel/thread_pool.hpp"
#include "sim/base/pose.hpp"
#include "sim/gap/contact_patch.hpp"
#include "sim/model/contact_pairs.hpp"
#include "sim/model/joint_coordinates.hpp"
#include "sim/model/mass_properties.hpp"
#include "sim/model/tissue_elements.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/wrap/wrapped_path.hpp"

/// The scene made ready to compute: immutable, holding only what the scene requires. How it is
/// moved on is said by StepSettings, what is written of it by the scenario.
///
/// Unknown velocities come in blocks of three: one block a free tissue node, then two a rigid body
/// (velocity of its centre of mass, angular velocity). Rigid bodies that are fixed or driven have
/// two blocks too, after all unknown ones: forces on them are reactions.
namespace articular::sim {

/// A point of a body by what moves it: a free tissue node's block, or a rigid body's two blocks and
/// the point's place in the rigid body's frame.
struct NodeRef {
  int block = 0;              // first block
  int rigid = -1;             // index into Model::rigid_bodies, or -1 for a free node
  Vec3 local = Vec3::Zero();  // in the rigid body's frame [m]
};

struct RigidBody {
  int body = 0;          // index into Model::bodies
  int block = 0;         // translation; rotation is the next
  bool unknown = false;  // rigid: its motion is solved for
  // p: centre of mass (rigid), the held point, or the middle of the mesh's box (fixed); R = I.
  Pose rest;
  RigidVelocity start;  // at t = 0
  /// With the tissue that it carries, of a fixed one that tissue alone; centre at the start, world.
  MassProperties mass;
  std::optional<Hold> hold;
  std::optional<Motion>
      motion;  // driven: wholly, or of a held one what is held, see constrained_rigid_body.hpp
};

/// Three velocities of a block that are free along some directions only: rigid bodies with `hold`
/// (two blocks each), supported nodes of tissue.
struct HeldBlock {
  int block = 0;
  Mat3 free = Mat3::Identity();  // orthogonal projection onto these directions
};

/// Nodes of a tissue that slide along a plane or a line, or are held wholly. These stand, or are
/// driven: see driven_supports.hpp.
struct SupportModel {
  struct Node {
    int node = 0;  // of the tissue
    int held = 0;  // index into Model::held_blocks
    /// Of the force on all that supports the node, what this one takes.
    Mat3 share = Mat3::Zero();
  };
  std::string name;  // may be empty
  int tissue = 0;    // index into Model::tissues
  std::vector<Node> nodes;
  Vec3 center = Vec3::Zero();         // the middle of the nodes' box at the start, world [m]
  std::optional<Motion> motion = {};  // of translations alone, along what it holds, world
};

/// What of a body can touch: tetrahedra with their surface. Tissue: its own mesh. RigidBody: its
/// mesh, or a shell of tetrahedra under its surfaces.
struct Collider {
  Positions X;  // at the start, world [m]
  Tetrahedra tets;
  collision::Surface surface;             // of a shell: without its inner and lateral faces
  std::vector<NodeRef> nodes;             // what moves each node
  std::vector<double> face_area;          // at the start [m²]
  Eigen::Matrix3Xi groups;                // of the corners of each face, and
  std::vector<int> group_node;            // the node of each: see smoothing_groups.hpp
  Eigen::VectorXd group_area;             // around each, at the start [m²]
  std::vector<unsigned> rims;             // of each face, FlatTriangle::rims
  Positions rim_height;                   // of each face, FlatTriangle::rim_height
  Eigen::Matrix3Xi across;                // of each face, see faces_across_edges()
  std::vector<int> nearby_begin, nearby;  // per tetrahedron: faces around it
  std::vector<char> is_inner;             // per tetrahedron: no node of it is on the surface
  Eigen::VectorXd compliance;             // of an element at the surface, h/M, at each node [m/Pa]
  double mean_compliance = 0;             // the same of the whole surface [m/Pa]
  double layer_compliance = 0;            // of the layer on it [m/Pa]
  double layer_thickness = 0;             // [m]; 0: there is none
  bool layer_stiffens = false;            // by the logarithmic law, see layer_law.hpp
  double reach = 0;                       // [m] depth up to which a crossed face is found
  double open_depth = 0;   // [m] how far in front of a face this side's surface counts
  double size = 0;         // [m] mean height of the elements at the surface
  Eigen::VectorXd height;  // [m] the same around each node of the surface
};

struct SheetModel {
  std::string name;
  fem::FibreSheet fibres;
};

struct Tissue {
  int body = 0;
  TissueElements elements;
  std::optional<fem::Dashpots> dashpots;
  std::optional<fem::FibreDrag> fibre_drag;
  std::optional<fem::Relaxation> relaxation;
  std::vector<SheetModel> sheets;
  int first_internal_variable = 0;  // of the relaxation, among Layout::internal variables()
  Eigen::VectorXd lumped_mass;      // [kg], one a node
  double mass_damping = 0;          // α [1/s]: a force −α m v on each node that is not tied
  std::vector<NodeRef> nodes;       // what moves each node
  Positions X;                      // at the start, world [m]
  FibreDirections fibres;           // one an element, or none
  int muscle = -1;                  // index into Model::muscles: what activates the fibres
  double bulk_modulus = 0, shear_modulus = 0;  // at small strain [Pa]
  double active_stress = 0;                    // the largest that its fibres pull with [Pa]
  std::string_view law_ends = {};              // where its law has an end, in words; mostly nowhere
  bool bears_turning = true;                   // or its law takes a rotation for a strain
  Vec3 start_velocity = Vec3::Zero();          // [m/s]
};

struct BodyModel {
  std::string name;
  Body::Kind kind = Body::Kind::Fixed;
  int tissue = -1;  // index into Model::tissues
  int rigid = -1;   // index into Model::rigid_bodies
  Positions X;      // rigid bodies: what is drawn, in the rigid body's frame [m]
  Triangles triangles;
  bool touches_as_drawn = true;  // a rigid body: not by surfaces of their own
  std::optional<Collider> collider;
};

/// A point of a line or a load: a rigid body's point, or a mean over tissue nodes.
struct WeightedPoint {
  std::vector<NodeRef> nodes;
  std::vector<double> weights;  // sum 1
};

/// The surface of a rigid body that lines wrap around.
struct WrapBody {
  int rigid = 0;  // index into Model::rigid_bodies
  Positions X;    // in the rigid body's frame [m]
  WrapSurface surface;
  TriangleTree tree;
  double size = 0;  // [m]

  PlacedSurface at(const Pose& pose) const { return {&surface, &tree, &X, pose, size}; }
};

/// What a line wraps around, and how at the start: a taut string between each two points of its
/// path, whose places are those of the points.
struct LineWrap {
  std::vector<int> bodies;  // indices into Model::wrap_bodies: the strings' surfaces
  std::vector<WrappedString> strings;
};

struct Line {
  std::string name;
  std::vector<WeightedPoint> path;
  double start_length = 0;  // [m]
  int muscle = -1;          // index into Model::muscles
  int ligament = -1;        // index into Model::ligaments
  int bolus = -1;           // index into Model::boluses
  LineWrap wrap = {};       // empty: straight from point to point
};

struct MuscleModel {
  Muscle given;
  double optimal_length = 0;  // [m], of a line
  int line = -1;              // -1: the muscle is made of a tissue's fibres
};

struct LigamentModel {
  Ligament given;
  double slack_length = 0;  // [m]
  int line = 0;
};

struct BolusModel {
  Bolus given;
  int line = 0;
};

struct ForceModel {
  WeightedPoint point;
  Vec3 force = Vec3::Zero();
  Curve profile;
};

struct MomentModel {
  int rigid = 0;  // index into Model::rigid_bodies
  Vec3 moment = Vec3::Zero();
  Curve profile;
};

struct SurfaceLoadModel {
  std::variant<double, Vec3> stress;  // [Pa]: pressure, or traction by the area at the start
  Curve profile;                      // factor over time
  int tissue = 0;                     // index into Model::tissues
  std::vector<std::array<NodeRef, 3>> faces;  // their corners, counterclockwise from outside
  std::vector<double> area;                   // of each at the start [m²]
};

struct GravityModel {
  Vec3 acceleration = Vec3::Zero();  // [m/s²]
  Curve profile;                     // factor over time; empty: always 1
};

/// A place as a fixed or rigid body sees it.
struct PointInFrame {
  WeightedPoint point;
  int frame = -1;  // index into Model::rigid_bodies; -1: the world
};

struct ObservedPoint {
  PointInFrame place;
};

/// Its length so far is a part of the state.
struct ObservedWay {
  PointInFrame place;
  int way = 0;  // index into State::ways
};

struct ObservedHelicalAxis {
  int rigid = 0;              // index into Model::rigid_bodies
  int frame = -1;             // the same; -1: the world
  Vec3 point = Vec3::Zero();  // world at the start [m]: the axis is shown near it
};

struct ObservedAngle {
  int rigid = 0;              // index into Model::rigid_bodies
  Vec3 axis = Vec3::UnitX();  // unit vector
};

struct ObservedContact {
  ContactId contact = -1;
  int body = 0;             // index into Model::bodies: the one that it acts on
  std::vector<char> faces;  // of that body's collider: those that count; empty: all
  PressureSensor sensor;
};

struct ObservedContacts {
  std::vector<ObservedContact> of;
  PressureSensor sensor;  // under all of them together
};

/// Goes with a fixed or rigid body.
struct BodyAxis {
  int rigid = 0;                   // index into Model::rigid_bodies
  Vec3 point = Vec3::Zero();       // in the rigid body's frame [m]
  Vec3 direction = Vec3::UnitX();  // unit vector, in that frame
};

struct ObservedMuscle {
  int line = 0;    // index into Model::lines
  int muscle = 0;  // index into Model::muscles
};

/// A muscle made of a tissue's fibres.
struct ObservedFibres {
  int tissue = 0;  // index into Model::tissues
  int muscle = 0;  // index into Model::muscles
};

struct ObservedLigament {
  int line = 0;      // index into Model::lines
  int ligament = 0;  // index into Model::ligaments
};

struct ObservedBolus {
  int line = 0;   // index into Model::lines
  int bolus = 0;  // index into Model::boluses
};

struct ObservedMomentArm {
  int line = 0;  // index into Model::lines
  BodyAxis axis;
};

struct ObservedMuscleMoment {
  std::vector<int> lines;  // indices into Model::lines
  BodyAxis axis;
};

struct ObservedWrap {
  int line = 0;  // index into Model::lines
};

struct ObservedEnergy {};

struct ObservedReaction {
  int rigid = 0;  // index into Model::rigid_bodies
};

struct ObservedSupport {
  int support = 0;  // index into Model::supports
};

struct ObservedAttachment {
  int tissue = 0;  // index into Model::tissues
  int rigid = 0;   // index into Model::rigid_bodies
};

struct ObservedStretch {
  int tissue = 0;  // index into Model::tissues; it has fibres
};

struct ObservedVolume {
  int tissue = 0;  // index into Model::tissues
};

struct ObservedSheet {
  int tissue = 0;  // index into Model::tissues
  int sheet = 0;   // index into its sheets
};

struct ObservedStress {
  int tissue = 0;             // index into Model::tissues
  std::vector<int> elements;  // of it
};

struct ObservedExtent {
  int tissue = 0;  // index into Model::tissues
  BodyAxis axis;
};

struct ObservedShare {
  std::vector<int> part, whole;   // indices into Model::probes
  Vec3 direction = Vec3::Zero();  // unit vector
};

struct ObservedJoint {
  JointFrame proximal, distal;
  bool is_right = true;
};

using Observed =
    std::variant<ObservedPoint, ObservedWay, ObservedAngle, ObservedHelicalAxis, ObservedContact,
                 ObservedContacts, ObservedMuscle, ObservedFibres, ObservedLigament, ObservedBolus,
                 ObservedMomentArm, ObservedMuscleMoment, ObservedWrap, ObservedEnergy,
                 ObservedReaction, ObservedSupport, ObservedAttachment, ObservedStretch,
                 ObservedVolume, ObservedSheet, ObservedStress, ObservedExtent, ObservedShare,
                 ObservedJoint>;

struct ProbeModel {
  std::string name;
  Observed what;
};

/// Where everything stands in the state vector y:
/// [free tissue x | per rigid body: p, quaternion (w x y z) | free tissue v | per rigid body: v, ω
/// | activations | internal variables of relaxing tissues]
struct Layout {
  int num_free_nodes = 0, num_rigid = 0, num_muscles = 0, num_internal_variables = 0;

  int num_unknown_blocks() const { return num_free_nodes + 2 * num_rigid; }
  int node_x(int block) const { return 3 * block; }
  int rigid_p(int r) const { return 3 * num_free_nodes + 7 * r; }
  int rigid_q(int r) const { return rigid_p(r) + 3; }
  int velocities() const {
    return 3 * num_free_nodes + 7 * num_rigid;
  }  // in the order of the blocks
  int activations() const { return velocities() + 3 * num_unknown_blocks(); }
  int internal_variables() const { return activations() + num_muscles; }
  int size() const { return internal_variables() + num_internal_variables; }
};

struct Model {
  bool is_static = false;  // equilibrium under loads over time; else motion in time
  std::vector<BodyModel> bodies;
  std::vector<Tissue> tissues;
  std::vector<RigidBody>
      rigid_bodies;  // rigid ones first: rigid body r < layout.num_rigid is unknown
  std::vector<WrapBody> wrap_bodies;
  std::vector<Line> lines;
  std::vector<MuscleModel> muscles;
  std::vector<LigamentModel> ligaments;
  std::vector<BolusModel> boluses;
  std::vector<ForceModel> forces;
  std::vector<MomentModel> moments;
  std::vector<SurfaceLoadModel> surface_loads;
  std::vector<GravityModel> gravity;
  std::vector<HeldBlock> held_blocks;
  std::vector<SupportModel> supports;
  ContactPairs contacts;
  std::vector<ProbeModel> probes;
  Layout layout;
  double position_tolerance = 0;  // [m], of the Newton iteration
  double detection_margin = 0;    // [m], least one
  /// [m] How far anything may move in one correction of Newton's iteration, or stray from its path
  /// in one step: the smallest mean element size. Beyond, neither linearisation nor contact search
  /// holds.
  double trusted_motion = std::numeric_limits<double>::infinity();
  Eigen::VectorXd node_mass;  // [kg] of each free tissue node, by block
  int num_blocks = 0;         // with the blocks of fixed and driven rigid bodies
  /// Of the whole run: elements, linear solver and contact search share it, one after the other.
  std::shared_ptr<ThreadPool> pool = std::make_shared<ThreadPool>(1);
  fem::SolverChoice linear_solver;
  std::vector<std::string> warnings;
};

/// y at t = 0.
Eigen::VectorXd initial_state(const Model& model);

/// Nodes of a body's mesh at the start, world [m]; none of a body that only carries points.
Positions start_positions(const Model& model, const BodyModel& body);

/// Whether any contact has friction.
bool has_friction(const Model& model);

/// A muscle's activation after a long time of the excitation that it has at t.
double steady_activation(const MuscleModel& muscle, double t);

}  // namespace articular::sim
