#pragma once

#include <limits>
#include <optional>

#include "sim/assembly/newton_matrix.hpp"
#include "sim/contact/contact_summary.hpp"
#include "sim/model/constrained_rigid_body.hpp"

/// Forces, rates and the Newton matrix of the whole scene.
namespace articular::sim {

/// Wall time by phase [s].
struct DynamicsTimes {
  double elastic_force = 0, contact_force = 0, assembly = 0;
};

class Dynamics {
 public:
  explicit Dynamics(const Model& model);

  /// The candidates for the coming step; their couplings enter the pattern.
  void set_candidates(std::span<const CandidateList> candidates);
  /// Drops what depends on the past (couplings of earlier candidates), and what a solution that was
  /// left in the middle had set.
  void forget() {
    matrix_.forget();
    contact_.drop_multipliers();
    contact_.set_soft(false);
    contact_.drop_friction_duals();
    drop_prediction();
  }

  /// Reads y and computes all forces there. Block forces: 3 entries a block, reactions of fixed and
  /// driven bones included; of held bones the part along their free freedoms.
  void evaluate(const double* y, double t);
  /// The same, with driven bones elsewhere: `driven` holds their poses, by bone.
  void evaluate(const double* y, double t, const std::vector<Pose>& driven);
  /// A step begins at t: accelerations that jump there are those after it, and at the end of a step
  /// those before it.
  void set_step_start(double t) { step_start_ = t; }
  const Configuration& configuration() const { return configuration_; }
  const Eigen::VectorXd& forces() const { return f_; }
  /// Force [N] on a bone of the tissue that is tied to it, and its moment [N m] about the bone's
  /// reference point: elasticity, with its dampers, and what contact puts on the tied nodes.
  std::pair<Vec3, Vec3> attachment_force(int tissue, int rigid) const;
  /// Force [N] and moment [N m], about its reference point, that a fixed, driven or held bone puts
  /// on what holds it.
  Vec6 reaction(int rigid) const;
  const std::vector<LineState>& lines() const { return lines_; }
  /// Whether anything lies opposite anything.
  bool touches() const { return contact_.has_patches(); }
  /// From the next evaluate() on, see ContactResponse::set_soft().
  void set_soft_contact(bool soft) { contact_.set_soft(soft); }
  /// From the next evaluate() on, see ContactResponse::set_allowances().
  void set_allowances(std::vector<double> allowances) {
    contact_.set_allowances(std::move(allowances));
  }
  /// From the next evaluate() on, see ContactResponse::augment() and drop_multipliers().
  bool augment_contact() { return contact_.augment(); }
  void drop_multipliers() { contact_.drop_multipliers(); }
  /// From the next evaluate() on, see ContactResponse::update_friction_duals() and
  /// drop_friction_duals().
  void update_friction_duals(const Eigen::VectorXd& change) {
    contact_.update_friction_duals(configuration_, change);
  }
  void drop_friction_duals() { contact_.drop_friction_duals(); }
  /// From the next evaluate() on, without gravity, loads and lines.
  void set_unloaded(bool unloaded) { unloaded_ = unloaded; }
  const ContactResponse& contact() const { return contact_; }
  /// See contact_summaries().
  std::vector<ContactSummary> contacts() const {
    return contact_summaries(model_, contact_, configuration_);
  }
  /// See summary_through().
  ContactSummary contact_through(int contact, int body, const std::vector<char>& selected) const {
    return summary_through(model_, contact_, configuration_, contact, body, selected);
  }
  /// Of one contact of the model.
  ContactSummary contact_summary(int contact) const {
    return contact_through(contact, model_.contacts[static_cast<std::size_t>(contact)].a, {});
  }

  /// ẏ from the forces of the last evaluate().
  void rate(const double* y, double* y_dot) const;

  /// Mass, damping and stiffness at the last evaluate(), over the unknown blocks.
  const fem::BlockMatrix& matrix(const SystemScale& scale, fem::Tangent tangent);

  /// What friction adds to that matrix. Refers to this object.
  const FrictionCoupling& friction_coupling() const { return matrix_.friction_coupling(); }

  /// What smoothed tissues add to that matrix: pressures that couple all of their nodes. Refers to
  /// this object.
  fem::PressurePart pressure_part() const { return matrix_.pressure_part(); }

  /// f += scale D u for block velocities u, of the dampers in tissue and in contact.
  void add_damping_product(const Eigen::VectorXd& u, double scale, Eigen::VectorXd& f) const;

  /// Newton's iteration with the pressures of smoothed tissues as unknowns of their own: those
  /// after a correction `dx` of the block positions, to first order, from where the last evaluate()
  /// and matrix() were.
  void predict_pressures(const Eigen::VectorXd& dx);
  /// From now on, evaluate() takes the pressures this part of the way there.
  void take_prediction(double part) { prediction_part_ = part; }
  /// From now on, evaluate() takes those of the positions.
  void drop_prediction() { prediction_part_.reset(); }
  /// The next matrix() takes the pressures this part of the way.
  void predict_for_matrix(double part);
  bool has_pressures() const { return matrix_.has_pressures(); }

  /// Newton's iteration for the internal variables of relaxing stress. Their rows (1 + γ/τ) δL =
  /// b_L + γ/τ δS0 leave known parts b_L/(1 + γ/τ), whose force is added:
  void add_internal_variable_force(const double* b, double gamma, Eigen::VectorXd& f) const;
  /// and with a correction γ w of the blocks' positions the rest of them follows, in x.
  void correct_internal_variables(const double* b, double gamma, const Eigen::VectorXd& w,
                                  double* x) const;
  /// The internal variables that entered the last evaluate(); empty where a tissue does not relax.
  const Eigen::VectorXd& internal_variables(int tissue) const {
    return tissues_[static_cast<std::size_t>(tissue)].internal_variables;
  }

  /// The largest force on one node, bone or line that entered the last evaluate() [N]: what a
  /// residual is small against.
  double largest_force() const { return largest_force_; }

  /// How far anything may move in one correction of Newton's iteration, or stray from its path in
  /// one step: the smallest mean element size. Beyond, neither linearisation nor contact search
  /// holds.
  double trusted_motion() const { return trusted_motion_; }  // [m]

  std::uint64_t pattern_id() const { return matrix_.pattern_id(); }

  /// Mass of a free node [kg].
  double mass_of(int block) const;
  /// r = M b for block velocities b.
  void multiply_mass(const Eigen::VectorXd& b, Eigen::VectorXd& r) const;

  /// Time constant of a muscle's activation now [s].
  double activation_time(const double* y, double t, int muscle) const;

  double kinetic_energy() const;  // at the last evaluate() [J]
  double elastic_energy() const;  // of the tissues [J]
  /// What the tissues' dampers lose there [W].
  double damping_power() const;
  /// What friction and damping in contact lose there [W].
  double contact_power() const { return contact_.damping_power(); }
  /// ∂W/∂a of a tissue's elastic energy there by its activation [J].
  double energy_per_activation(std::size_t tissue) const;
  double gravity_energy() const;  // [J], of all masses but fixed and driven bones' own
  DynamicsTimes& times() { return times_; }
  /// Since it was made.
  EvaluationCounts evaluations() const;

 private:
  /// Displacements of a tissue's nodes by small ones of the blocks.
  void displacements_of(std::size_t t, const Eigen::VectorXd& dx, Positions& u) const;
  Eigen::VectorXd predicted(std::size_t t, double part) const;
  void find_pressure(std::size_t t);
  /// All forces in the configuration; y only for internal variables.
  void find_forces(const double* y);
  void read_internal_variables(std::size_t t, const double* y);
  void add_loads(double t);
  void add_lines();
  double activation_of(std::size_t tissue) const;
  Instant instant() const { return {configuration_.t, configuration_.t == step_start_}; }
  /// All tissue nodes but those whose mass a rigid bone has taken over.
  bool carries_own_weight(const NodeRef& node) const;

  const Model& model_;
  std::span<const CandidateList> candidates_;
  Configuration configuration_;
  bool unloaded_ = false;
  double step_start_ = 0;  // [s]
  Eigen::VectorXd f_;
  std::vector<Vec6> all_force_;                           // of each rigid bone, held freedoms too
  mutable Positions v_, damping_;                         // at the nodes of a tissue
  mutable Eigen::VectorXd internal_part_, stress_there_;  // of a tissue
  double largest_force_ = 0;
  std::vector<LineState> lines_;
  std::vector<TissueMoment> tissues_;
  std::vector<Positions> tissue_force_;  // needed to hold the shape, of each node [N]
  struct PressurePrediction {
    Eigen::VectorXd before, after;  // of one tissue
  };
  std::vector<PressurePrediction> predicted_;
  std::optional<double> prediction_part_;        // way from `before` to `after`
  std::vector<std::pair<int, int>> mass_nodes_;  // tissue, node of each free block
  ContactResponse contact_;
  NewtonMatrix matrix_;
  double trusted_motion_ = std::numeric_limits<double>::infinity();
  DynamicsTimes times_;
  mutable EvaluationCounts evaluations_;  // but those of the matrix and of contact
};

}  // namespace articular::sim
