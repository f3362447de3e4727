#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "fem/solver/linear_solver.hpp"
#include "sim/assembly/moment.hpp"
#include "sim/contact/contact_forecast.hpp"
#include "sim/contact/contact_stencils.hpp"
#include "sim/contact/contact_stiffness.hpp"
#include "sim/model/system_matrix.hpp"

namespace articular::sim {

/// What Newton's iteration solves: A with what pressures and friction add to it. Valid until the
/// next assembly.
struct NewtonEquations {
  const fem::BlockMatrix& A;   // over the unknown blocks
  fem::PressurePart pressure;  // of smoothed tissues, which couple all of their nodes
  const FrictionCoupling& friction;
};

/// The matrix of Newton's iteration over the unknown blocks: mass, damping and stiffness of
/// everything in the scene.
class NewtonMatrix {
 public:
  explicit NewtonMatrix(const Model& model);

  /// Candidates of the coming step: their couplings enter the pattern as soon as one is needed that
  /// is not in it, and stay in it. They are referred to.
  void set_candidates(std::span<const CandidateList> candidates) { candidates_ = candidates; }
  /// See fem::FibreDrag::add_tangent.
  void forget_fibre_rates();
  /// Drops the couplings of all candidates so far.
  void forget();
  std::uint64_t pattern_id() const { return A_.pattern_id(); }

  NewtonEquations assemble(const Moment& now, const SystemScale& scale, fem::Tangent tangent);
  /// The last equations. They refer to this object.
  NewtonEquations equations() const;
  /// The last matrix with these changes of contact.
  /// @return false where its pattern lacks a coupling, and nothing was added: assemble it anew
  [[nodiscard]] bool add(const GroupChanges& changes, double stiffness);
  /// Of stiffness and inertia.
  const EvaluationCounts& evaluations() const { return evaluations_; }
  /// Whether there are tissues with pressures.
  bool has_pressures() const { return smoothed_; }
  /// ∂b/∂xᵀ of a smoothed tissue, by its nodes, where the last matrix was taken.
  const fem::PressureGradient& pressure_gradient(std::size_t tissue) const {
    return tissues_[tissue].node_G;
  }

 private:
  /// A block of a tissue's matrix with a node that moves with an unknown rigid body.
  struct CarriedBlock {
    int slot = 0;  // in that matrix
    int i = 0, j = 0;
    NodePairSlots to;
  };
  /// A tissue's own matrix, and where its blocks go.
  struct TissueMatrix {
    fem::BlockMatrix K;
    std::vector<int> slot;  // of each block of K; -1: not of two free nodes
    std::vector<CarriedBlock> carried;
  };
  struct TissueWork {
    std::optional<fem::StiffnessSlots> direct;  // tissues that need no matrix of their own
    TissueMatrix own;                           // the others
    TissueMatrix plain;                         // smoothed: couplings of the elements alone
    fem::BlockMatrix beside;                    // smoothed, with sheets: the same couplings
    fem::PressureGradient node_G, G;            // smoothed: by nodes, and by blocks of unknowns
    fem::FibreDrag::Lines fibre_lines;          // of the last matrix
  };
  bool adds_directly(const Tissue& tissue) const;
  Stencils base_stencils(bool smoothing) const;
  void couple_contacts(const Moment& now);
  void build_pattern();
  void find_slots(const Tissue& tissue, const fem::BlockMatrix& A, TissueMatrix& matrix) const;
  void make_pressure_gradient(std::size_t t);
  void set_pressure_gradient(std::size_t t, const Moment& now);
  void find_stiffness(std::size_t t, const Moment& now, const SystemScale& scale,
                      fem::Tangent tangent);
  void find_smoothed_stiffness(std::size_t t, const Moment& now, const SystemScale& scale,
                               fem::Tangent tangent);
  void add_sheets(std::size_t t, const Moment& now, const SystemScale& scale, fem::BlockMatrix& K);
  void add_dashpots(std::size_t t, const Moment& now, const SystemScale& scale,
                    fem::Tangent tangent);
  void add_fibre_drag(std::size_t t, const Moment& now, const SystemScale& scale,
                      fem::Tangent tangent);
  void add_relaxation(std::size_t t, const Moment& now, const SystemScale& scale,
                      fem::Tangent tangent);
  void add_tissue(std::size_t t, const Moment& now, const SystemScale& scale, fem::Tangent tangent,
                  fem::BlockMatrix& A);
  void add_smoothed(const Moment& now, const SystemScale& scale);
  static void add_free(const fem::BlockMatrix& K, const TissueMatrix& places, fem::BlockMatrix& A);
  static void add_carried(const fem::BlockMatrix& K, const TissueMatrix& places,
                          const Tissue& tissue, const Configuration& now, fem::BlockMatrix& A);
  void add_masses(const Configuration& now, const SystemScale& scale, fem::BlockMatrix& A);
  void set_all_but_tissue(const Moment& now, const SystemScale& scale, fem::Tangent tangent,
                          fem::BlockMatrix& common);

  const Model& model_;
  bool smoothed_ = false;       // some tissue is
  bool for_multigrid_ = false;  // what the plain matrix is for
  std::vector<TissueWork> tissues_;
  ContactStiffness contact_;
  std::span<const CandidateList> candidates_;
  BlocksOfGroups blocks_of_groups_;
  Stencils base_, plain_base_, contacts_;
  fem::BlockMatrix A_;
  fem::BlockMatrix plain_;          // with smoothed tissues: couplings of the elements alone
  std::vector<int> slot_of_plain_;  // of each of its blocks in A_
  std::vector<fem::PressureTerm> pressure_terms_;
  FrictionCoupling friction_;
  EvaluationCounts evaluations_;
};

}  // namespace articular::sim
