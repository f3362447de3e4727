#include "sim/scenario/name_pattern.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace articular::sim::name_pattern_test {

/// By the definition: what stands for the first `*` is tried in every length.
bool fits_slowly(const std::string& pattern, const std::string& name) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] == '*') {
    for (std::size_t length = 0; length <= name.size(); ++length)
      if (fits_slowly(pattern.substr(1), name.substr(length))) return true;
    return false;
  }
  return !name.empty() && name[0] == pattern[0] && fits_slowly(pattern.substr(1), name.substr(1));
}

TEST(NamePattern, FitsWhatItSays) {
  EXPECT_TRUE(fits("cube", "cube"));
  EXPECT_FALSE(fits("cube", "cube 1"));
  EXPECT_TRUE(fits("cube *", "cube 17"));
  EXPECT_FALSE(fits("cube *", "cube"));
  EXPECT_TRUE(fits("*", ""));
  EXPECT_TRUE(fits("*_left", "disc_left"));
  EXPECT_FALSE(fits("*_left", "disc_left_2"));
  EXPECT_TRUE(is_pattern("a*b"));
  EXPECT_FALSE(is_pattern("a b"));
}

TEST(NamePattern, FitsAsByTheDefinition) {
  std::mt19937 random(1);
  const auto text = [&](const std::string& letters) {
    std::string word;
    for (std::size_t k = random() % 7; k > 0; --k) word += letters[random() % letters.size()];
    return word;
  };
  int fitting = 0;
  for (int k = 0; k < 20000; ++k) {
    const std::string pattern = text("ab**"), name = text("ab");
    EXPECT_EQ(fits(pattern, name), fits_slowly(pattern, name)) << pattern << " and " << name;
    fitting += fits(pattern, name) ? 1 : 0;
  }
  EXPECT_GT(fitting, 2000);
  EXPECT_LT(fitting, 18000);
}

}  // namespace articular::sim::name_pattern_test
