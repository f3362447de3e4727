#pragma once

#include <optional>
#include <span>
#include <string>

#include "sim/statics/load_step.hpp"
#include "sim/statics/soft_motion.hpp"

namespace articular::sim {

/// Why no equilibrium was found, for the user.
struct EquilibriumDiagnosis {
  std::string cause = {};  // for the first line, "; body `a` can shift along (...) against ..."
  bool is_nearly_free = false;  // the cause is a motion that next to nothing resists
  std::string details = {};     // lines that follow it, each after a line feed
};

/// @param now     where the last try ended
/// @param softest motion there, if one was found
/// @param tries   all iterations towards the load step that failed
EquilibriumDiagnosis diagnose_equilibrium(const Moment& now,
                                          const std::optional<SoftMotion>& softest,
                                          std::span<const ConvergenceRow> tries);

}  // namespace articular::sim
