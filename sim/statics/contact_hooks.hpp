#pragma once

#include "sim/contact/contact_search.hpp"
#include "sim/statics/load_step.hpp"

namespace articular::sim {

/// The next detection's margin [m], after one where something strayed this far from where it was
/// looked for: the model's, doubled until it covers four times that. (In steps of two, so that what
/// stands still need not be mapped again for every new margin.)
double margin_for(const Model& model, double stray);

/// Contact search for load steps. All of what is named must outlive the hooks.
/// @param margin    [m] of the next detection, kept up to date
/// @param rejected  counts where something left what a detection covers
ContactHooks contact_hooks(const Model& model, ContactSearch& search, Dynamics& dynamics,
                           double& margin, std::int64_t& rejected);

}  // namespace articular::sim
