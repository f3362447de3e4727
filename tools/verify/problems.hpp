#pragma once

#include "tools/verify/problem.hpp"

namespace articular::tools {

/// All that `articular verify` solves, in this order.
std::vector<Problem> all_problems();

/// Those whose names a pattern meets: a part of the name, with *, ? and [..] as in a shell. "":
/// all.
/// @param quick  only those that take a second or two
/// @throws sim::InputError  where none is left: names all
std::vector<Problem> chosen(const std::vector<Problem>& problems, const std::string& pattern,
                            bool quick);

}  // namespace articular::tools
