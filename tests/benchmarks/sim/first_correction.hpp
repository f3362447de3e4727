#pragma once

#include <Eigen/Core>
#include <optional>

#include "sim/assembly/dynamics.hpp"
#include "sim/contact/contact_search.hpp"
#include "sim/model/state.hpp"
#include "sim/model/step_settings.hpp"

namespace articular::sim {

/// Processor time of what leads to the equations [s].
struct CorrectionTimes {
  double search = 0, evaluation = 0;
  double first_assembly = 0, assembly = 0;  // with the pattern, and once that is known
};

/// The linear equations of the first correction of Newton's iteration from a state. In statics it
/// goes towards the loads of the next load step; in time it is that of implicit Euler, from where
/// everything will be at the step's end if it moves on as now.
class FirstCorrection {
 public:
  /// @param model  is referred to
  /// @throws std::runtime_error  where no tangent gives a matrix that is positive definite
  FirstCorrection(const Model& model, const StepSettings& settings, const State& state);

  NewtonEquations equations() const { return dynamics_.matrix().equations(); }
  const Eigen::VectorXd& right_side() const { return right_side_; }
  /// Where the free nodes are [m].
  const Positions& nodes() const { return dynamics_.now().configuration.x; }
  /// Six motions of everything as one rigid body, one a column, over the unknown blocks; what is
  /// held stays.
  Eigen::MatrixXd rigid_motions() const;
  const CorrectionTimes& times() const { return times_; }

 private:
  Eigen::VectorXd place_to_start(const State& state, double step) const;

  const Model& model_;
  std::optional<ContactSearch> search_;
  Dynamics dynamics_;
  Eigen::VectorXd right_side_;
  CorrectionTimes times_;
};

}  // namespace articular::sim
