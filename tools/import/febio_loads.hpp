#pragma once

#include "tools/import/scenario_draft.hpp"

namespace articular::tools {

/// Gravity, forces on nodes, pressures and tractions on surfaces.
void add_loads(ScenarioDraft& draft);

}  // namespace articular::tools
