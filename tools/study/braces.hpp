#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

/// Parameters in texts: {NAME}, {NAME * 2}, {NAME + 2}, {NAME * -8 - 2.5}. Other braces, as of a
/// TOML table or of ${VARIABLE}, are left alone.
namespace articular::tools {

/// The names in braces, in their order.
std::vector<std::string> names_in_braces(std::string_view text);

/// The text with numbers for names in braces. A brace that is all that stands in double quotes is a
/// number, without them.
/// @param names   all that are in braces, and maybe more
/// @param values  one a name
std::string with_numbers(const std::string& text, const std::vector<std::string>& names,
                         const Eigen::VectorXd& values);

/// Says so where a name in braces stands as it is before another unit than its own, of the same
/// kind: {E} MPa, where E is in kPa. "" where none does. Numbers change nothing: {E * 0.001} MPa.
/// @param names  all that are in braces, and maybe more
/// @param units  one a name; "" has none
std::string wrong_unit(std::string_view text, const std::vector<std::string>& names,
                       const std::vector<std::string>& units);

/// Letters, digits and _, and a letter first.
bool is_parameter_name(const std::string& text);

}  // namespace articular::tools
