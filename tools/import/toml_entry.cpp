#include "tools/import/toml_entry.hpp"

#include <fmt/format.h>

namespace articular::tools {

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += fmt::format("\\{}", c);
    else if ((c >= 0 && c < ' ') || c == '\x7f')
      quoted += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      quoted += c;
  }
  return quoted + "\"";
}

std::string toml_quantity(double value, std::string_view unit) {
  return fmt::format("\"{} {}\"", value, unit);
}

std::string toml_vector(const Eigen::Vector3d& value, std::string_view unit) {
  const Eigen::Vector3d v = value.array() + 0.0;  // no -0
  return fmt::format("\"{} {} {} {}\"", v.x(), v.y(), v.z(), unit);
}

TomlEntry& TomlEntry::add(std::string_view key, std::string_view value) {
  text_ += fmt::format("{} = {}\n", key, value);
  return *this;
}

}  // namespace articular::tools
