#pragma once

#include <algorithm>
#include <cmath>

namespace articular::fem {

/// What an old preconditioner costs. It is replaced when the iterations more than it took when it
/// was new have added up to the price of a new one: at most twice what the best choice of these
/// moments would have cost (the ski rental problem). Counts iterations, not time, so that every run
/// does the same.
class PreconditionerReuse {
 public:
  void restart() { *this = {}; }
  bool is_new() const { return per_decade_ == 0; }
  bool is_too_old() const { return excess_ > kPriceOfBuilding; }
  /// After `iterations` have divided the residual by `fall`.
  void add(int iterations, double fall) {
    const double decades = std::max(kFewestDecades, std::log10(fall));
    if (is_new()) {
      per_decade_ = std::max(1, iterations) / decades;
    } else {
      excess_ += std::max(0.0, iterations - per_decade_ * decades - 1);
    }
  }
  /// Iterations after which a solve that shall divide the residual by `fall` has used up the rest.
  int patience(double fall) const {
    const double decades = std::max(kFewestDecades, std::log10(fall));
    return static_cast<int>(per_decade_ * decades + 1 + kPriceOfBuilding - excess_) + 1;
  }

 private:
  // What it costs to build the preconditioner anew on the same pattern, in iterations.
  static constexpr double kPriceOfBuilding = 10;
  // Relative residuals do not tell much over less than this part of a decade.
  static constexpr double kFewestDecades = 0.5;

  double per_decade_ = 0, excess_ = 0;  // iterations
};

}  // namespace articular::fem
