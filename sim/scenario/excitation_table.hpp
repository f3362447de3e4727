#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {

/// Gives muscles the excitations of a table, as `articular track` writes it, in place of their own:
/// comma separated values, a column `time [s]` with increasing times, and one column a muscle,
/// called as the muscle is, with numbers from 0 to 1: linear between the times, constant outside.
/// @param node  [excitations], or nullptr: nothing changes
/// @return      the muscles that have others now
/// @throws InputError with file:line
std::vector<std::size_t> replace_excitations(const Node* node, const Context& context,
                                             std::vector<Muscle>& muscles);

/// What a table says after the end of the run [s] is not computed: of the first muscle that it is
/// so of, "" of none. @param replaced  from replace_excitations()
std::string late_excitation_doubt(const Node* node, const std::vector<Muscle>& muscles,
                                  const std::vector<std::size_t>& replaced, double duration);

}  // namespace articular::sim
