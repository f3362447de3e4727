#pragma once

#include <string>

namespace articular::sim {

/// Memory that this process can still take: what is free on the machine, not more than the limits
/// of its control group and of the process. [bytes]; infinite where nothing tells.
double available_memory();
/// What of it is not swap.
double available_memory_without_swap();

/// "2.1 GB"
std::string size_text(double bytes);

}  // namespace articular::sim
