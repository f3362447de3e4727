#pragma once

#include <cstdint>
#include <vector>

#include "sim/contact/contact_response.hpp"
#include "sim/lines/line_force.hpp"
#include "sim/lines/line_path.hpp"
#include "sim/model/constrained_rigid_body.hpp"

namespace articular::sim {

/// A tissue at one moment.
struct TissueMoment {
  Positions x;                                 // its nodes [m]
  Positions velocity;                          // of them, where something drags [m/s]
  Eigen::VectorXd pressure;                    // of smoothed elements [Pa]
  Eigen::VectorXd stress, internal_variables;  // of relaxing tissue, see fem::Relaxation [Pa];
                                               // empty where it does not relax
  Positions force;                             // needed to hold the shape, of each node [N]
};

/// The whole scene at one moment, with all forces: what Dynamics::evaluate() finds, until the next
/// one. Energies, reactions and Newton's matrix are of such a moment.
struct Moment {
  Moment(const Model& given, const ContactResponse& response) : model(given), contact(response) {}

  const Model& model;
  const ContactResponse& contact;
  Configuration configuration;
  std::vector<TissueMoment> tissues;
  std::vector<LineState> lines;
  std::vector<LinePath> paths;  // of lines that wrap; those of others are empty
  /// Block forces [N]: 3 entries a block, those on fixed and driven bodies included, without the
  /// inertia of what they carry; of held bodies the part along their free freedoms.
  Eigen::VectorXd forces;
  Positions held_forces;  // of each of Model::held_blocks: what acts on what holds it [N, N m]
  std::vector<Vec6> rigid_forces;  // on each rigid body that moves, held freedoms too
  /// The largest force on one node, body or line [N]: what a residual is small against. Infinite
  /// where one is not a finite number.
  double largest_force = 0;
  /// A step begins here: accelerations that jump are those after it, elsewhere those before it.
  bool begins_step = false;
  double step_start = 0;    // of the step that it is in [s]
  std::int64_t number = 0;  // of the evaluation that found it: there is one more each time
};

/// The points of a line now.
inline std::span<const WeightedPoint> path_of(const Moment& now, std::size_t line) {
  return now.paths[line].strings.empty() ? now.model.lines[line].path : now.paths[line].points;
}

/// Of a tissue's fibres, in [0, 1]; 0 where no muscle activates them.
double activation_of(const Tissue& tissue, const Configuration& now);

/// Per element of a tissue, with what is left of relaxation: 6 x M (xx yy zz xy yz xz) [Pa].
Eigen::MatrixXd cauchy_stress(const Tissue& tissue, const TissueMoment& moment,
                              const Configuration& now);

/// Displacements of a tissue's nodes by small ones of the blocks.
void displacements_of(const Moment& now, std::size_t tissue, const Eigen::VectorXd& dx,
                      Positions& u);

/// All tissue nodes but those whose mass a rigid body has taken over.
inline bool carries_own_weight(const Model& model, const NodeRef& node) {
  return node.rigid < 0 || node.rigid >= model.layout.num_rigid;
}

}  // namespace articular::sim
