#pragma once

#include "tools/import/scenario_draft.hpp"

namespace articular::tools {

/// Nodes of tissue that the model holds or moves: grips where all three axes are moved alike,
/// driven supports where one is, supports where they are held.
void add_node_conditions(ScenarioDraft& draft);

}  // namespace articular::tools
