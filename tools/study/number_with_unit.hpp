#pragma once

#include <string>

#include "sim/scenario/toml_reader.hpp"

/// Values of parameters, which may be of any dimension.
namespace articular::tools {

/// "2 mm" as 2 and "mm"; a bare number has no unit.
struct NumberWithUnit {
  double number;
  std::string unit;
};

/// @throws sim::InputError  also where the unit is none
NumberWithUnit read_with_unit(const sim::Node& node);

/// The number of a value in a unit. @param as  the key whose unit it is, for messages
double in_unit(const sim::Node& node, const std::string& unit, const char* as);

/// A bare number, or a text with a unit.
sim::KeyType number_with_unit();

}  // namespace articular::tools
