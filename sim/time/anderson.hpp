#pragma once

#include <Eigen/Core>
#include <array>

namespace articular::sim {

/// Anderson acceleration [Walker, Ni 2011] of Newton's iteration where that is slow or goes round
/// in circles: because its matrix has been made positive definite, or contacts open and close by
/// turns. Of the last iterates it takes the combination whose correction would be least, and adds
/// that correction. Few bodies among many are stuck at a time, and so few iterates will do.
///
/// [Walker, Ni 2011] Walker, Ni. Anderson acceleration for fixed-point iterations. SIAM J. Numer.
/// Anal. 49:1715.
class Anderson {
 public:
  /// Another iteration begins.
  void restart() {
    num_seen_ = 0;
    is_slow_ = has_improved_ = false;
  }
  /// Starts afresh where the last correction was made better and the residual has grown: what the
  /// iterates were says nothing of where they go now. Without that, iterations that halved their
  /// residual ended in circles once a step was accelerated over a contact.
  /// @param w  Newton's correction of the present iterate
  /// @param weighted  M w; sizes are wᵀ M w, M positive definite
  /// @param has_grown  the residual that w corrects, since the correction before
  void see(const Eigen::VectorXd& w, const Eigen::VectorXd& weighted, bool has_grown);
  /// Corrections have hardly become smaller: improve() is worth it.
  bool is_slow() const { return is_slow_; }
  /// The correction seen last, made better.
  void improve(Eigen::VectorXd& w);
  /// What the iterate was changed by in the end: part * w.
  void took(double part, const Eigen::VectorXd& w) { taken_ = part * w; }

 private:
  static constexpr int kDepth = 6;  // iterates
  static constexpr int kBack = 3;   // iterations over which corrections are to become smaller

  int num_seen_ = 0;  // corrections of this iteration
  bool is_slow_ = false, has_improved_ = false;
  std::array<double, kBack> sizes_{};         // of the last corrections, in turns
  Eigen::VectorXd last_, last_weighted_;      // correction, as Newton had it
  Eigen::VectorXd taken_;                     // and as it was taken
  Eigen::MatrixXd change_, weighted_change_;  // of corrections, a column an iterate, in turns
  Eigen::MatrixXd way_;                       // of the iterates
};

}  // namespace articular::sim
