#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "fem/material/any_material.hpp"

/// The laws of Young's modulus and Poisson's ratio, as values: what tests them compiles once.
namespace articular::fem {

struct BasicLaw {
  const char* name;
  AnyMaterial (*make)(double E, double nu);
};

inline void PrintTo(const BasicLaw& law, std::ostream* out) { *out << law.name; }

/// Those that rotations do not strain.
inline std::vector<BasicLaw> objective_laws() {
  return {{"Corotated", [](double E, double nu) -> AnyMaterial { return Corotated(E, nu); }},
          {"NeoHookean", [](double E, double nu) -> AnyMaterial { return NeoHookean(E, nu); }}};
}

inline std::vector<BasicLaw> basic_laws() {
  std::vector<BasicLaw> laws = objective_laws();
  laws.push_back({"Linear", [](double E, double nu) -> AnyMaterial { return Linear(E, nu); }});
  return laws;
}

inline std::string name_of_law(const testing::TestParamInfo<BasicLaw>& info) {
  return info.param.name;
}

}  // namespace articular::fem
