#pragma once

#include "tools/import/scenario_draft.hpp"

namespace articular::tools {

/// Ties, and contact with a probe of each pair.
/// @return whether anything slides on anything
bool add_contacts(ScenarioDraft& draft);

}  // namespace articular::tools
