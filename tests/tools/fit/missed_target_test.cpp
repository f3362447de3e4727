#include "tools/fit/missed_target.hpp"

#include <gtest/gtest.h>

namespace articular::missed_target_test {

using tools::missed_text;

TEST(MissedTargets, AreNamedLargestFirstWhateverTheirSign) {
  EXPECT_EQ(missed_text({{"a", 6}, {"b", 5}, {"c", -75.04}, {"d", -4.9}, {"e", 1600}}),
            "e by 1600 spreads, c by -75.0 spreads, a by 6.0 spreads");
  EXPECT_EQ(missed_text({{"a", 5}, {"b", -5}}), "");
  EXPECT_EQ(missed_text({}), "");
}

}  // namespace articular::missed_target_test
