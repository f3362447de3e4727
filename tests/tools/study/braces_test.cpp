#include "tools/study/braces.hpp"

#include <gtest/gtest.h>

namespace articular::tools::braces_test {

TEST(Braces, NamesAreFoundInBracesAlone) {
  EXPECT_EQ(names_in_braces("{ a } {b_2 - 1e-3} { \"c\" = 1 } {d e} {3} {f -} {g + -2} {h * -2.5} "
                            "{i * 2 + 1} {j *} ${K} {l"),
            (std::vector<std::string>{"a", "b_2", "h", "i"}));
}

TEST(Braces, BecomeNumbers) {
  const std::vector<std::string> names = {"a", "b"};
  const Eigen::Vector2d values(1.5, -2);
  EXPECT_EQ(with_numbers("{a} {b + 8} { a-2.5 } {a * -8} {b * 2 - 1} ${a} {3}", names, values),
            "1.5 6 -1 -12 -5 ${a} {3}");
}

// A key that takes a number would not take a text.
TEST(Braces, AloneInQuotesAreNumbers) {
  const std::vector<std::string> names = {"a"};
  const Eigen::VectorXd value = Eigen::VectorXd::Constant(1, 0.25);
  EXPECT_EQ(with_numbers("x=\"{a}\"", names, value), "x=0.25");
  EXPECT_EQ(with_numbers("x=[\"{a}\", \"{a} mm\"]", names, value), "x=[0.25, \"0.25 mm\"]");
}

// A drawn number of kPa before MPa would be a thousand times what was meant.
TEST(Braces, BeforeAnotherUnitThanTheirOwnAreNamed) {
  const std::vector<std::string> names = {"E", "n"}, units = {"kPa", ""};
  for (const char* text :
       {"E=\"{E} kPa\"", "E=\"{E * 0.001} MPa\"", "E=\"{E}\"", "x=\"{n} MPa\"", "{E} of it",
        "{E} s", "x=[\"{E} kPa\", \"2 MPa\"]", "x=[{E}, \"2 MPa\"]"})
    EXPECT_EQ(wrong_unit(text, names, units), "") << text;
  for (const char* text : {"E=\"{E} MPa\"", "E=\"{E + 2} MPa\"", "--E {E} MPa",
                           "x=\"0 {E} {n} -1.5 MPa\"", "x=['{n} {E} MPa']"})
    EXPECT_EQ(wrong_unit(text, names, units),
              "`{E}` is a number of kPa and stands before MPa: expected `{E} kPa`")
        << text;
}

TEST(Braces, NamesOfParametersAreWords) {
  for (const char* name : {"a", "acl_strain", "E2"}) EXPECT_TRUE(is_parameter_name(name)) << name;
  for (const char* name : {"", "2a", "_a", "a b", "a.b", "ä"})
    EXPECT_FALSE(is_parameter_name(name)) << name;
}

}  // namespace articular::tools::braces_test
