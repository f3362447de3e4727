#include "tools/render/look.hpp"

#include <fmt/format.h>

#include "sim/base/error.hpp"
#include "tools/render/nearest.hpp"

namespace articular::tools {

void check_opacity(const std::map<std::string, double>& opacity,
                   const std::set<std::string>& bodies) {
  for (const auto& [body, value] : opacity) {
    if (!bodies.contains(body))
      throw sim::InputError("--opacity: " + unknown_name("body", body, bodies));
    if (!(value > 0 && value <= 1))
      throw sim::InputError(fmt::format(
          "--opacity {}={:g}: expected more than 0 and at most 1; --hide {} leaves it out", body,
          value, body));
  }
}

}  // namespace articular::tools
