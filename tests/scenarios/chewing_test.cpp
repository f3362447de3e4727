// The jaw of scenarios/mandible/ chews on a bolus between the left molars.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tests/scenarios/coarse_jaw.hpp"

namespace articular::chewing_test {

constexpr double kCycle = 0.8;  // [s]

/// Two cycles with coarse discs and steps; the second begins on the bolus, as all that follow.
ScenarioResults chew() {
  return coarse_jaw("chewing.toml", {"accuracy=fast", "integrator.step=5 ms",
                                     "output.interval=50 ms", "duration=1.6 s"});
}

/// Where the incisor is, to the left, at this height on its way down or up in the second cycle.
double sideways_at(const ScenarioResults& results, double height, bool opening) {
  const auto& time = results.column("time [s]");
  const auto& x = results.column("incisor.position.x [mm]");
  const auto& z = results.column("incisor.position.z [mm]");
  for (std::size_t i = 1; i < time.size(); ++i)
    if (time[i] > kCycle &&
        (opening ? z[i - 1] > height && z[i] <= height : z[i - 1] < height && z[i] >= height))
      return x[i];
  throw std::out_of_range("the incisor is never at this height");
}

// Published of a simulated chew on the left: 20 mm down and 6 mm to the side of the bolus.
TEST(JawChewing, TheCycleSwingsToTheSideOfTheBolusWhileTheMouthCloses) {
  const ScenarioResults results = chew();
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const auto& z = results.column("incisor.position.z [mm]");
  const double lowest = *std::min_element(z.begin(), z.end());
  EXPECT_GT(z.front() - lowest, 15);
  EXPECT_LT(z.front() - lowest, 30);
  const double middle = 0.5 * (lowest + results.at("incisor.position.z [mm]", kCycle));
  EXPECT_GT(sideways_at(results, middle, false), sideways_at(results, middle, true) + 2);
  EXPECT_GT(results.largest("incisor.position.x [mm]"), 4);
  EXPECT_LT(results.largest("incisor.position.x [mm]"), 10);
  EXPECT_GT(results.largest("bite.force.z [N]"), 30);

  // The cycle closes, and the condyle of the working side is back first.
  for (const std::string axis : {"x", "y", "z"}) {
    const std::string column = "incisor.position." + axis + " [mm]";
    EXPECT_NEAR(results.last(column), results.at(column, kCycle), 0.5) << axis;
  }
  EXPECT_GT(results.at("condyle_left.position.y [mm]", kCycle + 0.38),
            results.at("condyle_right.position.y [mm]", kCycle + 0.38) + 2);
}

}  // namespace articular::chewing_test
