#pragma once

namespace articular::fem {

/// One term of a Prony series, see Relaxation.
struct PronyTerm {
  double weight;  // g [-], > 0
  double time;    // τ [s], > 0
};

}  // namespace articular::fem
