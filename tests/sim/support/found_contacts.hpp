#pragma once

#include "sim/assembly/dynamics.hpp"
#include "sim/contact/contact_search.hpp"

namespace articular::sim {

/// Looks for contacts where the state y is, and lets forces take them from there.
/// @param margin  [m]
inline void find_contacts(const Model& model, const Eigen::VectorXd& y, double margin,
                          ContactSearch& search, Dynamics& dynamics) {
  Configuration configuration;
  read_state(model, y.data(), 0, configuration);
  search.find(configuration, margin);
  dynamics.set_candidates(search.candidates());
}

}  // namespace articular::sim
