#pragma once

#include <string>
#include <vector>

#include "sim/model/ignored_overlaps.hpp"
#include "sim/step/stepper.hpp"

namespace articular::sim {

/// What whoever reads the results must know: elements turned inside out, contact deeper than it can
/// be followed, energy that the time integration took or made, bodies that nothing holds. A
/// sentence each.
std::vector<std::string> run_warnings(const Model& model, const State& state,
                                      const Stepper& stepper);

/// Bodies that went into each other, as no [[contact]] names both. A sentence each.
std::vector<std::string> overlap_warnings(const Model& model,
                                          const std::vector<IgnoredOverlap>& overlaps);

/// What a reader of the results may want to know, and what it leaves untouched: motion that the
/// time integration damped on its way to rest. A sentence each.
std::vector<std::string> run_notes(const Model& model, const State& state, const Stepper& stepper);

}  // namespace articular::sim
