#pragma once

#include <string>
#include <string_view>

namespace articular::tools {

/// Units that belong together, as scenarios write them: FEBio's numbers have none.
struct UnitSystem {
  std::string_view name;  // as FEBio calls it
  std::string_view length, mass, force, stress;

  std::string density() const;       // "t/mm^3"
  std::string acceleration() const;  // "mm/s^2"
};

/// @throws sim::InputError with the names that are known
const UnitSystem& unit_system(std::string_view name);

/// "SI, mm-N-s, ..."
std::string unit_system_names();

}  // namespace articular::tools
