#pragma once

#include <set>
#include <string>

#include "sim/base/message_text.hpp"

namespace articular::tools {

/// "unknown field `von_mies`, did you mean `von_mises`? There are: displacement, von_mises"
inline std::string unknown_name(const std::string& kind, const std::string& name,
                                const std::set<std::string>& known) {
  std::string text = "unknown " + kind + " `" + name + "`";
  if (known.empty()) return text + "; there is none";
  const std::string nearest = sim::nearest_name(name, {known.begin(), known.end()});
  text += nearest.empty() ? "; there are: " : ", did you mean `" + nearest + "`? There are: ";
  for (const std::string& one : known) text += (one == *known.begin() ? "" : ", ") + one;
  return text;
}

}  // namespace articular::tools
