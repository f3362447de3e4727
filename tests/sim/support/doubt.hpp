#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/build/build_model.hpp"

/// What a scene is warned of when it is built.
namespace articular::sim {

/// The only warning; "" without one.
inline std::string doubt(const Scenario& s) {
  const std::vector<std::string> warnings = build_model(s).warnings;
  EXPECT_LE(warnings.size(), 1U);
  return warnings.empty() ? "" : warnings.front();
}

inline testing::AssertionResult says(const std::string& doubt, const std::string& part) {
  if (doubt.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << doubt << "\" does not say " << part;
}

}  // namespace articular::sim
