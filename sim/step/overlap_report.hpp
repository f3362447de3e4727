#pragma once

#include <string>
#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// Two bodies that overlap before anything has moved.
struct OverlapReport {
  ContactId contact = 0;
  bool is_set_apart = false;  // before the run
  bool is_deep = false;       // a quarter of an element and more
  std::string words;          // "`a` and `b` overlap at the start by 0.2 mm, ..."
};

/// All overlaps of a start, as they are drawn and as contact finds them: what `check` prints and
/// `run` tells. What is drawn shallower than 1/100 of an element, and not found by contact, is
/// facets of what lies close.
/// @throws SimulationError when contact can't tell the way out
std::vector<OverlapReport> overlap_reports(const Scenario& scenario, const Model& model,
                                           const Eigen::VectorXd& y);

/// Adds to the model's warnings what stays overlapping at the start, if contact can tell, and what
/// is deep: a run sets it apart, but that much is a mistake of the geometry, and enters the
/// results.
void warn_of_overlaps(const Scenario& scenario, Model& model);

}  // namespace articular::sim
