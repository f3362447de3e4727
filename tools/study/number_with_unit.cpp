#include "tools/study/number_with_unit.hpp"

#include <charconv>
#include <stdexcept>

namespace articular::tools {
namespace {

sim::MeasuredUnit measured_unit(const sim::Node& node, const std::string& unit) {
  if (unit.empty()) return {};
  try {
    return sim::parse_any_unit(unit);
  } catch (const std::invalid_argument& error) {
    sim::fail(node, error.what());
  }
}

}  // namespace

NumberWithUnit read_with_unit(const sim::Node& node) {
  if (node.text() == nullptr) return {sim::read_number(node, sim::kAny), ""};
  const std::string& text = *node.text();
  NumberWithUnit result{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result.number);
  const std::size_t unit = text.find_first_not_of(' ', static_cast<std::size_t>(end - text.data()));
  if (error != std::errc() || unit == std::string::npos || end == text.data() + unit)
    sim::fail(node, "expected a number, or a number with a unit such as \"2 mm\", found " +
                        sim::found(node));
  result.unit = text.substr(unit);
  measured_unit(node, result.unit);
  return result;
}

double in_unit(const sim::Node& node, const std::string& unit, const char* as) {
  const NumberWithUnit value = read_with_unit(node);
  const sim::MeasuredUnit own = measured_unit(node, value.unit), wanted = measured_unit(node, unit);
  if (own.dimension != wanted.dimension || value.unit.empty() != unit.empty())
    sim::fail(node, unit.empty() ? fmt::format("expected a bare number, as `{}` is one", as)
                                 : fmt::format("expected a value in `{}`, as `{}`", unit, as));
  return value.unit == unit ? value.number : value.number * own.size / wanted.size;
}

sim::KeyType number_with_unit() {
  return {
      sim::form::Either{{{sim::form::Number{sim::kAny}}, {sim::form::Text{"number with a unit"}}}}};
}

}  // namespace articular::tools
