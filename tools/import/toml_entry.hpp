#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace articular::tools {

/// A text in double quotes, as TOML has it.
std::string toml_text(std::string_view text);

/// "0.5 mm" and "0 0 1 mm", in quotes. All digits are kept.
std::string toml_quantity(double value, std::string_view unit);
std::string toml_vector(const Eigen::Vector3d& value, std::string_view unit);

/// An entry of a scenario file: its head and a line for each key.
class TomlEntry {
 public:
  /// @param head  "[[body]]"
  explicit TomlEntry(std::string_view head) : text_("\n" + std::string(head) + "\n") {}

  /// @param value  as TOML has it
  TomlEntry& add(std::string_view key, std::string_view value);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace articular::tools
