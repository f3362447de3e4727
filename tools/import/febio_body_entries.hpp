#pragma once

#include "tools/import/scenario_draft.hpp"

namespace articular::tools {

/// The bodies of the model with what moves rigid ones, and muscles of tissue. Puts those that can
/// be taken over into `draft.bodies`.
void add_bodies(ScenarioDraft& draft);

/// Nodes that a tissue shares with a rigid body, and those that are said to go with it.
void add_attachments(ScenarioDraft& draft);

}  // namespace articular::tools
