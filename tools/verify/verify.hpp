#pragma once

#include "tools/verify/problem.hpp"

namespace articular::tools {

/// How one problem went.
struct Outcome {
  std::string problem;
  std::vector<Finding> findings;
  std::string error;   // why there are none; "": there are
  double seconds = 0;  // wall time

  /// Not where nothing was found.
  bool passed() const;
};

struct VerifyWatch {
  std::function<void(const std::string& problem, std::size_t number)> before;  // from 0
  std::function<void(const Outcome&)> after;
  std::function<bool()> is_to_stop = [] { return false; };
};

/// Solves problems one after the other, each in a temporary folder of its own, which is gone after
/// it. A problem that can't be solved is an outcome that has not passed.
/// @throws sim::Interruption  when is_to_stop() says so
/// @throws sim::SystemError   when the folder can't be written
std::vector<Outcome> verify(const std::vector<Problem>& problems, const VerifyWatch& watch);

}  // namespace articular::tools
