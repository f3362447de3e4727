#include "sim/scenario/quantity.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/base/message_text.hpp"

namespace articular::sim {
namespace {

/// What is wrong with a text, for the parentheses at the end of the message.
struct Reason : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Size in SI: factor * 10^decimal. The power of ten is kept apart so that it can be joined to the
/// digits of a number before they are rounded.
struct Unit {
  Dimension dimension;
  int decimal = 0;
  double factor = 1;
};

struct Symbol {
  std::string_view name;
  Unit unit;
};

constexpr Dimension kNewton{1, 1, -2, 0}, kPascal{1, -1, -2, 0}, kJoule{1, 2, -2, 0};
constexpr std::array kSymbols{
    Symbol{"m", {{0, 1, 0, 0}, 0}},
    Symbol{"cm", {{0, 1, 0, 0}, -2}},
    Symbol{"mm", {{0, 1, 0, 0}, -3}},
    Symbol{"um", {{0, 1, 0, 0}, -6}},
    Symbol{"km", {{0, 1, 0, 0}, 3}},
    Symbol{"s", {{0, 0, 1, 0}, 0}},
    Symbol{"ms", {{0, 0, 1, 0}, -3}},
    Symbol{"us", {{0, 0, 1, 0}, -6}},
    Symbol{"min", {{0, 0, 1, 0}, 0, 60}},
    Symbol{"kg", {{1, 0, 0, 0}, 0}},
    Symbol{"g", {{1, 0, 0, 0}, -3}},
    Symbol{"mg", {{1, 0, 0, 0}, -6}},
    Symbol{"t", {{1, 0, 0, 0}, 3}},
    Symbol{"N", {kNewton, 0}},
    Symbol{"mN", {kNewton, -3}},
    Symbol{"kN", {kNewton, 3}},
    Symbol{"Pa", {kPascal, 0}},
    Symbol{"kPa", {kPascal, 3}},
    Symbol{"MPa", {kPascal, 6}},
    Symbol{"GPa", {kPascal, 9}},
    Symbol{"J", {kJoule, 0}},
    Symbol{"mJ", {kJoule, -3}},
    Symbol{"W", {{1, 2, -3, 0}, 0}},
    Symbol{"Hz", {{0, 0, -1, 0}, 0}},
    Symbol{"rad", {{0, 0, 0, 1}, 0}},
    Symbol{"deg", {{0, 0, 0, 1}, 0, std::numbers::pi / 180}},
};

struct Noun {
  Dimension dimension;
  std::string_view name;
};

constexpr std::array kNouns{
    Noun{{}, "no unit"},
    Noun{{0, 2, 0, 0}, "an area"},
    Noun{{0, 3, 0, 0}, "a volume"},
    Noun{kJoule, "an energy"},
    Noun{{1, 2, -3, 0}, "a power"},
    Noun{kTime.dimension, kTime.noun},
    Noun{kLength.dimension, kLength.noun},
    Noun{kPerLength.dimension, kPerLength.noun},
    Noun{kMass.dimension, kMass.noun},
    Noun{kAngle.dimension, kAngle.noun},
    Noun{kRate.dimension, kRate.noun},
    Noun{kDensity.dimension, kDensity.noun},
    Noun{kStress.dimension, kStress.noun},
    Noun{kForce.dimension, kForce.noun},
    Noun{kStiffness.dimension, kStiffness.noun},
    Noun{kDamping.dimension, kDamping.noun},
    Noun{kContactDamping.dimension, kContactDamping.noun},
    Noun{kInertia.dimension, kInertia.noun},
    Noun{kVelocity.dimension, kVelocity.noun},
    Noun{kAngularVelocity.dimension, kAngularVelocity.noun},
    Noun{kAcceleration.dimension, kAcceleration.noun},
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool skip(std::string_view& rest, std::string_view start) {
  if (!rest.starts_with(start)) return false;
  rest.remove_prefix(start.size());
  return true;
}

void skip_spaces(std::string_view& rest) {
  while (skip(rest, " ") || skip(rest, "\t")) continue;
}

/// A decimal number before it is rounded: digits * 10^exponent.
struct Decimal {
  std::string digits;
  int exponent = 0;
};

std::size_t count_digits(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && is_digit(text[n])) ++n;
  return n;
}

/// The exponent after "e", or 0; takes it off `rest`. "5 e" and "5 eV" have none.
int take_exponent(std::string_view& rest) {
  if (!rest.starts_with('e') && !rest.starts_with('E')) return 0;
  std::string_view after = rest.substr(1);
  const bool negative = skip(after, "-");
  if (!negative) skip(after, "+");
  const std::size_t n = count_digits(after);
  if (n == 0) return 0;
  if (n > 4) throw Reason("out of range: an exponent has at most four digits");
  int exponent = 0;
  std::from_chars(after.data(), after.data() + n, exponent);
  rest = after.substr(n);
  return negative ? -exponent : exponent;
}

/// The number at the start of `rest`, taken off it, with the spaces around it.
std::optional<Decimal> take_number(std::string_view& rest) {
  skip_spaces(rest);
  std::string_view after = rest;
  Decimal number;
  if (skip(after, "-"))
    number.digits = "-";
  else
    skip(after, "+");
  const std::size_t whole = count_digits(after);
  const bool has_point = after.substr(whole).starts_with('.');
  const std::size_t fraction = has_point ? count_digits(after.substr(whole + 1)) : 0;
  if (whole + fraction == 0) {
    if (after.starts_with("inf") || after.starts_with("nan")) throw Reason("not finite");
    return std::nullopt;
  }
  const std::size_t length = whole + (has_point ? 1 + fraction : 0);
  number.digits += after.substr(0, length);
  after.remove_prefix(length);
  number.exponent = take_exponent(after);
  if (after.starts_with(','))
    throw Reason("decimals are written with a point, and lists without commas");
  skip_spaces(after);
  rest = after;
  return number;
}

double value(const Decimal& number, const Unit& unit) {
  const std::string text = fmt::format("{}e{}", number.digits, number.exponent + unit.decimal);
  double result = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
  result *= unit.factor;
  // Squares of what is measured must be numbers too.
  constexpr double kMost = 1e100;
  if (error != std::errc() || !(std::abs(result) <= kMost))
    throw Reason(fmt::format("out of range: at most {:g} in SI units", kMost));
  return result;
}

/// The message for a symbol that is no unit: "Nm" is a product without its space, "kpa" a slip.
std::string unknown_symbol(std::string_view name) {
  const auto is_symbol = [](std::string_view text) {
    for (const Symbol& symbol : kSymbols)
      if (symbol.name == text) return true;
    return false;
  };
  for (std::size_t i = 1; i < name.size(); ++i)
    if (is_symbol(name.substr(0, i)) && is_symbol(name.substr(i)))
      return fmt::format("unknown unit `{0}{1}`; a product is written `{0} {1}`", name.substr(0, i),
                         name.substr(i));
  std::vector<std::string> names;
  names.reserve(kSymbols.size());
  for (const Symbol& symbol : kSymbols) names.emplace_back(symbol.name);
  const std::string nearest = nearest_name(name, names);
  return fmt::format("unknown unit `{}`{}", name,
                     nearest.empty() ? "" : fmt::format("; did you mean `{}`?", nearest));
}

/// Recursive descent over   product = factor { (space | * | / | ·) factor }
///                          factor  = ( symbol | "(" product ")" ) [ ^ integer | ² | ³ ]
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : rest_(text) {}

  Unit parse() {
    skip_spaces(rest_);
    if (rest_.empty()) throw Reason("no unit");
    const Unit unit = product();
    if (!rest_.empty()) throw Reason(fmt::format("cannot read {}", in_quotes(rest_)));
    return unit;
  }

 private:
  // Powers that no unit of mechanics reaches; they keep all sums far from overflow.
  static constexpr int kLargestPower = 9, kLargestDepth = 8, kLargestExponent = 100;

  static void multiply(Unit& unit, const Unit& other, int power) {
    unit.dimension.mass += power * other.dimension.mass;
    unit.dimension.length += power * other.dimension.length;
    unit.dimension.time += power * other.dimension.time;
    unit.dimension.angle += power * other.dimension.angle;
    unit.decimal += power * other.decimal;
    unit.factor *= std::pow(other.factor, power);
    const Dimension& d = unit.dimension;
    for (const int exponent : {d.mass, d.length, d.time, d.angle, unit.decimal})
      if (std::abs(exponent) > kLargestExponent)
        throw Reason(fmt::format("out of range: powers of a unit up to {}", kLargestExponent));
  }

  Unit product() {
    if (++depth_ > kLargestDepth) throw Reason("too many parentheses");
    Unit unit;
    bool after_slash = false;
    if (!take_reciprocal()) multiply(unit, factor(), 1);
    for (skip_spaces(rest_); !rest_.empty() && rest_.front() != ')'; skip_spaces(rest_)) {
      if (skip(rest_, "/")) {
        multiply(unit, factor(), -1);
        after_slash = true;
        continue;
      }
      if (after_slash) throw Reason("a product after `/` needs parentheses, as in `N/(m s)`");
      if (!skip(rest_, "*")) skip(rest_, "·");
      multiply(unit, factor(), 1);
    }
    --depth_;
    return unit;
  }

  /// "1/s" and "/s": true if the product starts with its first divisor.
  bool take_reciprocal() {
    skip_spaces(rest_);
    std::string_view after = rest_;
    if (skip(after, "1")) skip_spaces(after);
    if (!after.starts_with('/')) return false;
    rest_ = after;
    return true;
  }

  Unit factor() {
    skip_spaces(rest_);
    Unit base;
    if (skip(rest_, "(")) {
      base = product();
      if (!skip(rest_, ")")) throw Reason("`)` is missing");
    } else {
      base = symbol();
      if (!rest_.empty() && is_digit(rest_.front()))
        throw Reason("a power is written with `^`, as in `cm^3`");
    }
    Unit unit;
    multiply(unit, base, power());
    return unit;
  }

  Unit symbol() {
    std::string name;
    if (skip(rest_, "µ") || skip(rest_, "μ")) name = "u";  // micro sign, Greek mu
    while (!rest_.empty() && is_letter(rest_.front())) {
      name += rest_.front();
      rest_.remove_prefix(1);
    }
    if (name.empty()) {
      if (rest_.empty()) throw Reason("the unit is not complete");
      if (is_digit(rest_.front()) || rest_.front() == '-' || rest_.front() == '+')
        throw Reason("too many numbers");
      throw Reason(fmt::format("cannot read {}", in_quotes(rest_)));
    }
    for (const Symbol& symbol : kSymbols)
      if (symbol.name == name) return symbol.unit;
    throw Reason(unknown_symbol(name));
  }

  int power() {
    if (skip(rest_, "²")) return 2;
    if (skip(rest_, "³")) return 3;
    if (!skip(rest_, "^")) return 1;
    const bool negative = skip(rest_, "-");
    const std::size_t n = count_digits(rest_);
    if (n != 1) throw Reason(fmt::format("a power is a whole number up to {}", kLargestPower));
    const int power = rest_.front() - '0';
    rest_.remove_prefix(1);
    return negative ? -power : power;
  }

  std::string_view rest_;
  int depth_ = 0;
};

Unit unit_of_kind(std::string_view text, const QuantityKind& kind) {
  const Unit unit = UnitParser(text).parse();
  if (unit.dimension != kind.dimension) throw Reason(noun_of(unit.dimension));
  return unit;
}

}  // namespace

double parse_quantity(std::string_view text, const QuantityKind& kind) try {
  std::string_view rest = text;
  const std::optional<Decimal> number = take_number(rest);
  if (!number) throw Reason("no number");
  return value(*number, unit_of_kind(rest, kind));
} catch (const Reason& reason) {
  throw std::invalid_argument(fmt::format("expected {} such as {}, found {} ({})", kind.noun,
                                          in_quotes(kind.example), in_quotes(text), reason.what()));
}

Eigen::Vector3d parse_vector(std::string_view text, const QuantityKind& kind) try {
  std::string_view rest = text;
  std::array<Decimal, 3> numbers;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<Decimal> number = take_number(rest);
    if (!number && i == 0) throw Reason("no number");
    if (!number) throw Reason(fmt::format("{} number{}", i, i == 1 ? "" : "s"));
    numbers[i] = *number;
  }
  const Unit unit = unit_of_kind(rest, kind);
  return {value(numbers[0], unit), value(numbers[1], unit), value(numbers[2], unit)};
} catch (const Reason& reason) {
  throw std::invalid_argument(
      fmt::format("expected {} as three numbers and one unit, such as {}, found {} ({})", kind.noun,
                  in_quotes(kind.vector_example), in_quotes(text), reason.what()));
}

double parse_unit(std::string_view text, const QuantityKind& kind) try {
  return value({"1", 0}, unit_of_kind(text, kind));
} catch (const Reason& reason) {
  const std::string_view example = kind.example.substr(kind.example.find(' ') + 1);
  throw std::invalid_argument(fmt::format("expected the unit of {} such as {}, found {} ({})",
                                          kind.noun, in_quotes(example), in_quotes(text),
                                          reason.what()));
}

MeasuredUnit parse_any_unit(std::string_view text) try {
  const Unit unit = UnitParser(text).parse();
  return {unit.dimension, value({"1", 0}, unit)};
} catch (const Reason& reason) {
  throw std::invalid_argument(
      fmt::format("expected a unit such as \"mm\", found {} ({})", in_quotes(text), reason.what()));
}

std::string noun_of(const Dimension& dimension) {
  for (const Noun& noun : kNouns)
    if (noun.dimension == dimension) return std::string(noun.name);
  std::string text;
  const auto append = [&text](std::string_view base, int power) {
    if (power == 0) return;
    text += fmt::format("{}{}", text.empty() ? "" : " ", base);
    if (power != 1) text += fmt::format("^{}", power);
  };
  append("kg", dimension.mass);
  append("m", dimension.length);
  append("s", dimension.time);
  append("rad", dimension.angle);
  return text;
}

}  // namespace articular::sim
