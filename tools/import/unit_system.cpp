#include "tools/import/unit_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"

namespace articular::tools {
namespace {

constexpr UnitSystem kSystems[] = {{"SI", "m", "kg", "N", "Pa"},
                                   {"mm-N-s", "mm", "t", "N", "MPa"},
                                   {"mm-kg-s", "mm", "kg", "mN", "kPa"},
                                   {"um-nN-s", "um", "g", "g um/s^2", "kPa"},
                                   {"CGS", "cm", "g", "g cm/s^2", "g/(cm s^2)"},
                                   {"mm-g-s", "mm", "g", "g mm/s^2", "Pa"},
                                   {"mm-mg-s", "mm", "mg", "mg mm/s^2", "mg/(mm s^2)"}};

}  // namespace

std::string UnitSystem::density() const { return fmt::format("{}/{}^3", mass, length); }
std::string UnitSystem::acceleration() const { return fmt::format("{}/s^2", length); }

const UnitSystem& unit_system(std::string_view name) {
  const auto* const found =
      std::find_if(std::begin(kSystems), std::end(kSystems),
                   [&](const UnitSystem& system) { return system.name == name; });
  if (found == std::end(kSystems))
    throw sim::InputError(fmt::format("unknown system of units {}; expected one of {}",
                                      sim::in_ticks(name), unit_system_names()));
  return *found;
}

std::string unit_system_names() {
  std::string names;
  for (const UnitSystem& system : kSystems)
    names += (names.empty() ? "" : ", ") + std::string(system.name);
  return names;
}

}  // namespace articular::tools
