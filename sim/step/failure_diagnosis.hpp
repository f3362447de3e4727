#pragma once

#include <string>
#include <vector>

#include "sim/contact/contact_summary.hpp"
#include "sim/model/configuration.hpp"

namespace articular::sim {

/// Where the trouble is when a step can't be made: the most squeezed element where it was tried,
/// and the node or rigid body that was fastest where it began. "; the most squeezed element is
/// ...".
std::string failure_diagnosis(const Model& model, const Configuration& start,
                              const Configuration& tried);

/// Where nothing resists a motion: what may have given way under a load, tissues whose law ends and
/// layers. "; or tissue `a` gives way: ...". Mostly empty.
std::string what_gives_way(const Model& model);

/// The two bodies whose contact has stored the most energy: "; contact of `a` and `b` holds 2 J,
/// 3 mm deep: ...". Empty where nothing touches.
std::string deepest_contact(const Model& model, const std::vector<ContactSummary>& contacts);

}  // namespace articular::sim
