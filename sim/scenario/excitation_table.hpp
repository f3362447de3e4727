#pragma once

#include <vector>

#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {

/// Gives muscles the excitations of a table, as `articular track` writes it, in place of their own:
/// comma separated values, a column `time [s]` with increasing times, and one column a muscle,
/// called as the muscle is, with numbers from 0 to 1: linear between the times, constant outside.
/// @param node  [excitations], or nullptr: nothing changes
/// @throws InputError with file:line
void replace_excitations(const Node* node, const Context& context, std::vector<Muscle>& muscles);

}  // namespace articular::sim
