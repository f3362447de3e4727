#include "sim/scenario/quantity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace articular::sim::quantity_test {

/// The message with which a text is refused, or "" if it is not.
template <class Parse>
std::string refusal(Parse parse) {
  try {
    parse();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string refusal(const std::string& text, const QuantityKind& kind) {
  return refusal([&] { parse_quantity(text, kind); });
}

TEST(Quantity, ReadsTheUnitsOfTheFormat) {
  EXPECT_EQ(parse_quantity("15 kPa", kStress), 15e3);
  EXPECT_EQ(parse_quantity("1.06 g/cm^3", kDensity), 1060);
  EXPECT_EQ(parse_quantity("0.6 s", kTime), 0.6);
  EXPECT_EQ(parse_quantity("250 N/mm", kStiffness), 250e3);
  EXPECT_EQ(parse_quantity("0.05 N s/mm", kDamping), 50);
  EXPECT_EQ(parse_quantity("10 1/s", kRate), 10);
  EXPECT_EQ(parse_quantity("10 /s", kRate), 10);
  EXPECT_EQ(parse_quantity("10 Hz", kRate), 10);
  EXPECT_EQ(parse_quantity("1e4 Pa s/m", kContactDamping), 1e4);
  EXPECT_EQ(parse_quantity("2 min", kTime), 120);
  EXPECT_DOUBLE_EQ(parse_quantity("30 deg", kAngle), std::numbers::pi / 6);
  EXPECT_EQ(parse_vector("0 0 -9.81 m/s^2", kAcceleration), Eigen::Vector3d(0, 0, -9.81));
  EXPECT_EQ(parse_vector("147 246 297 kg mm^2", kInertia), Eigen::Vector3d(147e-6, 246e-6, 297e-6));
  EXPECT_EQ(parse_unit("mm", kLength), 1e-3);
}

TEST(Quantity, APowerWithoutItsSignIsTold) {
  for (const char* text : {"1 g/cm3", "1 g/(cm3)"})
    EXPECT_NE(refusal(text, kDensity).find("a power is written with `^`, as in `cm^3`"),
              std::string::npos)
        << text;
}

TEST(Quantity, EquivalentSpellingsGiveTheSameNumber) {
  for (const char* text :
       {"2 N s/mm", "2 N*s/mm", "2 N·s/mm", "2 N s / mm", "2N s/mm", " +2.0e0 N  s/mm ",
        "2 s N mm^-1", "2 s N/(mm)", "2 kN s/m", "2 N/(mm/s)"})
    EXPECT_EQ(parse_quantity(text, kDamping), 2000) << text;
  for (const char* text : {"5 um", "5 µm", "5 μm", "0.005 mm", ".005 mm", "5. um", "5E-3 mm"})
    EXPECT_EQ(parse_quantity(text, kLength), 5e-6) << text;
  for (const char* text :
       {"1 kg/m^3", "1 kg/m³", "1 kg/m/m/m", "1 kg/(m m^2)", "1 kg m^-3", "1 g/m^3 "})
    EXPECT_EQ(parse_quantity(text, kDensity), std::string(text).starts_with("1 g") ? 1e-3 : 1)
        << text;
}

// The power of ten of the unit is joined to the digits before they are rounded, so that a length in
// micrometres is the same double as the one written in metres.
TEST(Quantity, IsTheDoubleNearestToTheDecimalWritten) {
  EXPECT_EQ(parse_quantity("0.1 um", kLength), 1e-7);
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const std::string digits =
        std::to_string(random() % 100000) + "." + std::to_string(random() % 1000);
    EXPECT_EQ(parse_quantity(digits + " us", kTime),
              std::strtod((digits + "e-6").c_str(), nullptr));
    EXPECT_EQ(parse_quantity(digits + " MPa", kStress),
              std::strtod((digits + "e6").c_str(), nullptr));
  }
}

struct Factor {
  const char* name;
  Dimension dimension;
  double size;
};

const std::vector<Factor> kFactors{
    {"m", {0, 1, 0, 0}, 1},       {"cm", {0, 1, 0, 0}, 1e-2},
    {"mm", {0, 1, 0, 0}, 1e-3},   {"um", {0, 1, 0, 0}, 1e-6},
    {"km", {0, 1, 0, 0}, 1e3},    {"s", {0, 0, 1, 0}, 1},
    {"ms", {0, 0, 1, 0}, 1e-3},   {"us", {0, 0, 1, 0}, 1e-6},
    {"min", {0, 0, 1, 0}, 60},    {"kg", {1, 0, 0, 0}, 1},
    {"g", {1, 0, 0, 0}, 1e-3},    {"mg", {1, 0, 0, 0}, 1e-6},
    {"t", {1, 0, 0, 0}, 1e3},     {"N", {1, 1, -2, 0}, 1},
    {"mN", {1, 1, -2, 0}, 1e-3},  {"kN", {1, 1, -2, 0}, 1e3},
    {"Pa", {1, -1, -2, 0}, 1},    {"kPa", {1, -1, -2, 0}, 1e3},
    {"MPa", {1, -1, -2, 0}, 1e6}, {"GPa", {1, -1, -2, 0}, 1e9},
    {"J", {1, 2, -2, 0}, 1},      {"mJ", {1, 2, -2, 0}, 1e-3},
    {"W", {1, 2, -3, 0}, 1},      {"Hz", {0, 0, -1, 0}, 1},
    {"rad", {0, 0, 0, 1}, 1},     {"deg", {0, 0, 0, 1}, std::numbers::pi / 180}};

/// A product of up to four random factors over a product of up to three, with its size.
struct RandomUnit {
  explicit RandomUnit(std::mt19937& random) {
    append(random, 1 + random() % 4, 1);
    if (const unsigned divisors = random() % 4; divisors > 0) {
      text += divisors == 1 ? "/" : " / (";
      append(random, divisors, -1);
      text += divisors == 1 ? "" : ")";
    }
  }

  void append(std::mt19937& random, unsigned count, int sign) {
    for (unsigned i = 0; i < count; ++i) {
      const Factor& factor = kFactors[random() % kFactors.size()];
      const int power = static_cast<int>(random() % 7) - 3;
      if (i > 0) text += random() % 2 == 0 ? " " : "*";
      text += factor.name;
      if (power != 1) text.append("^").append(std::to_string(power));
      size *= std::pow(factor.size, sign * power);
      dimension.mass += sign * power * factor.dimension.mass;
      dimension.length += sign * power * factor.dimension.length;
      dimension.time += sign * power * factor.dimension.time;
      dimension.angle += sign * power * factor.dimension.angle;
    }
  }

  std::string text;
  Dimension dimension;
  double size = 1;
};

TEST(Quantity, RandomProductsOfUnitsHaveTheProductOfSizesAndDimensions) {
  std::mt19937 random(7);
  for (int i = 0; i < 5000; ++i) {
    const RandomUnit unit(random);
    const double number = std::ldexp(static_cast<double>(random() % 2001) - 1000, -3);
    const QuantityKind kind{unit.dimension, "a product", "1 m"};
    const std::string text = std::to_string(number) + " " + unit.text;
    const double expected = number * unit.size;
    EXPECT_NEAR(parse_quantity(text, kind), expected, 1e-13 * std::abs(expected)) << text;
  }
}

TEST(Quantity, RandomProductsAreRefusedForAnotherDimension) {
  std::mt19937 random(8);
  for (int i = 0; i < 1000; ++i) {
    const RandomUnit unit(random);
    QuantityKind kind{unit.dimension, "a product", "1 m"};
    (i % 2 == 0 ? kind.dimension.length : kind.dimension.angle) += 1;
    EXPECT_NE(refusal("1 " + unit.text, kind), "") << unit.text;
  }
}

TEST(Quantity, MessagesNameWhatIsExpectedAndFound) {
  EXPECT_EQ(refusal("15 mm", kStress),
            "expected a stress such as \"15 kPa\", found \"15 mm\" (a length)");
  EXPECT_EQ(refusal("15", kStress), "expected a stress such as \"15 kPa\", found \"15\" (no unit)");
  EXPECT_EQ(refusal("kPa", kStress),
            "expected a stress such as \"15 kPa\", found \"kPa\" (no number)");
  EXPECT_EQ(refusal("2 1/s", kAngularVelocity),
            "expected an angular velocity such as \"2 rad/s\", found \"2 1/s\" (a rate)");
  EXPECT_EQ(refusal("1 N kg", kForce),
            "expected a force such as \"190 N\", found \"1 N kg\" (kg^2 m s^-2)");
  EXPECT_EQ(refusal("15 kpa", kStress),
            "expected a stress such as \"15 kPa\", found \"15 kpa\" (unknown unit `kpa`; did you "
            "mean `kPa`?)");
  EXPECT_EQ(refusal("15 Nm", kForce),
            "expected a force such as \"190 N\", found \"15 Nm\" (unknown unit `Nm`; a product is "
            "written `N m`)");
  EXPECT_EQ(refusal("1 2 3 mm", kLength),
            "expected a length such as \"5 mm\", found \"1 2 3 mm\" (too many numbers)");
  EXPECT_EQ(
      refusal([] { parse_vector("1 2 mm", kLength); }),
      "expected a length as three numbers and one unit, such as \"0 -9.5 36.1 mm\", found \"1 2 "
      "mm\" (2 numbers)");
  EXPECT_EQ(refusal([] { parse_unit("kg", kLength); }),
            "expected the unit of a length such as \"mm\", found \"kg\" (a mass)");
}

TEST(Quantity, RefusesWhatIsNoFiniteNumberWithAUnit) {
  for (const char* text : {"",
                           " ",
                           "nan m",
                           "inf m",
                           "-inf m",
                           "1e400 m",
                           "1e160 m",
                           "1e99999 m",
                           "1,5 m",
                           "0x10 m",
                           "m",
                           "- 1 m",
                           "1 m m m",
                           "1 m^",
                           "1 m^x",
                           "1 m^99",
                           "1 m^1.5",
                           "1 m/",
                           "1 (m",
                           "1 m)",
                           "1 ()",
                           "1 m//s s",
                           "1 *m",
                           "1 m *",
                           "1 m 2",
                           "1 1 m",
                           "1 m;",
                           "--1 m",
                           "1 m\n",
                           "1e m",
                           "10 1 mm",
                           "1_000 m",
                           "1 m/s s",
                           "1 m/s*s",
                           "1 ((((((((((m))))))))))",
                           "1 (((((m^9)^9)^9)^9)^9)"})
    EXPECT_NE(refusal(text, kLength), "") << text;
}

TEST(Quantity, AProductAfterASlashNeedsParentheses) {
  EXPECT_NE(refusal("1 N/mm s", kDamping).find("needs parentheses, as in `N/(m s)`"),
            std::string::npos);
  EXPECT_EQ(parse_quantity("1 kg/(mm s^2)", kStress), 1000);
}

TEST(Quantity, AnyTextIsReadOrRefusedInOneLine) {
  constexpr std::string_view kAlphabet = "0123456789.eE+-^*/() \t\nmskgNPaJWHzderunµ²,\"\\\x01\xff";
  std::mt19937 random(3);
  int accepted = 0;
  for (int i = 0; i < 40000; ++i) {
    std::string text = i % 4 == 0 ? "1 m" : "";
    for (auto n = random() % 12; n > 0; --n) text += kAlphabet[random() % kAlphabet.size()];
    const std::string message = refusal(text, kLength);
    if (message.empty()) ++accepted;
    EXPECT_EQ(message.find_first_of("\n\r\t"), std::string::npos) << text;
  }
  EXPECT_GT(accepted, 100);
}

TEST(Quantity, AUnitOfAnythingHasItsDimension) {
  EXPECT_EQ(parse_any_unit("kPa").dimension, kStress.dimension);
  EXPECT_DOUBLE_EQ(parse_any_unit("N mm").size, 1e-3);
  EXPECT_EQ(noun_of(parse_any_unit("mm^2").dimension), "an area");
  EXPECT_NE(refusal([] { parse_any_unit("kpa"); }).find("did you mean `kPa`?"), std::string::npos);
  EXPECT_NE(refusal([] { parse_any_unit(""); }).find("no unit"), std::string::npos);
}

}  // namespace articular::sim::quantity_test
