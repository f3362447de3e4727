// A run's history is the same whichever tree finds its contacts.
#include <gtest/gtest.h>

#include "tests/scenarios/scenario_results.hpp"

namespace articular::trees_test {

void expect_same_history(const std::string& file, std::vector<std::string> overrides,
                         const std::vector<std::string>& columns) {
  overrides.push_back("detection.tree=blocks");
  const ScenarioResults blocks = run_scenario(file, overrides);
  overrides.back() = "detection.tree=buckets";
  const ScenarioResults buckets = run_scenario(file, overrides);
  EXPECT_GT(blocks.count("reported_pairs"), 0);
  for (const char* const count : {"reported_pairs", "newton_iterations", "tree_updates"})
    EXPECT_EQ(blocks.count(count), buckets.count(count)) << count;
  for (const std::string& column : columns)
    EXPECT_EQ(blocks.column(column), buckets.column(column)) << column;
}

TEST(Trees, TwoVShapesMoveAlikeByBlocksAndByBuckets) {
  expect_same_history("v-shapes/two.toml", {"duration=0.15 s"},
                      {"time [s]", "between.force.z [N]", "between.area [mm^2]"});
}

TEST(Trees, AVShapeThatClosesOnItselfMovesAlike) {
  expect_same_history("v-shapes/self.toml", {"duration=0.5 s"},
                      {"time [s]", "legs.area [mm^2]", "legs.max_penetration [mm]"});
}

TEST(Trees, TheJawOpensAlike) {
  expect_same_history("mandible/opening.toml", {"accuracy=fast", "duration=20 ms"},
                      {"time [s]", "incisor.position.z [mm]"});
}

}  // namespace articular::trees_test
