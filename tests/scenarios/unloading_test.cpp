// The jaw of scenarios/mandible/ bites on a bar, which then is gone.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/scenarios/coarse_jaw.hpp"

namespace articular::unloading_test {

constexpr double kRelease = 0.2;  // [s]

/// With coarser discs, in coarser steps, and sooner, than in the scenario.
ScenarioResults bite(const std::string& duration, std::vector<std::string> more = {}) {
  more.insert(more.end(),
              {"accuracy=fast", "integrator.step=2 ms", "output.interval=20 ms",
               R"(load.1.time=["0 s", "0.1 s", "0.2 s", "0.201 s"])",
               R"(curve.closers.time=["0 s", "0.1 s", "0.15 s"])", "duration=" + duration});
  return coarse_jaw("unloading.toml", more);
}

/// On incisors that are held, until they have closed on.
const ScenarioResults& held() {
  static const ScenarioResults results = bite("0.216 s");
  return results;
}

double travel(const ScenarioResults& results, double time) {
  const std::string height = "incisor.position.z [mm]";
  return results.at(height, time) - results.at(height, kRelease);
}

double bite_force(const ScenarioResults& results, double time) {
  return std::hypot(results.at("bite.force.y [N]", time), results.at("bite.force.z [N]", time));
}

// Published: after a bite of 100 N the speed no longer rises once the incisors have moved 4.5 mm,
// and it is the muscles' speed that limits it [Slager 1997, J Neurophysiol 78:3222].
TEST(JawUnloading, TheSpeedOfTheMusclesLimitsThatOfTheTeeth) {
  const ScenarioResults& results = held();
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  EXPECT_GT(bite_force(results, kRelease - 0.002), 80);
  EXPECT_LT(bite_force(results, kRelease - 0.002), 120);
  EXPECT_EQ(bite_force(results, kRelease + 0.002), 0);
  EXPECT_GT(travel(results, 0.212), 4.5);
  const double early = travel(results, 0.212) - travel(results, 0.208);
  const double later = travel(results, 0.216) - travel(results, 0.212);
  EXPECT_GT(later, 0.8 * early);  // [mm] in 4 ms each
  EXPECT_LT(later, 1.2 * early);

  const ScenarioResults unlimited = bite("0.204 s", {"muscle_table.0.max_velocity=1000 1/s"});
  EXPECT_NEAR(bite_force(unlimited, kRelease - 0.002), bite_force(results, kRelease - 0.002), 5);
  EXPECT_GT(travel(unlimited, 0.204), 2 * travel(results, 0.204));
}

// Closers that shorten too fast to pull leave the discs free to spring back, and they throw the
// jaw.
TEST(JawUnloading, DiscsThatGiveBackAllThatTheBitePutIntoThemThrowTheJaw) {
  const ScenarioResults elastic =
      bite("0.212 s", {"body.disc_left.material.stiffness_damping=0 s",
                       "body.disc_right.material.stiffness_damping=0 s"});
  EXPECT_GT(travel(elastic, 0.212), 1.1 * travel(held(), 0.212));
}

// By the levers of the closers: the molar is nearer to the joint than the incisors.
TEST(JawUnloading, AMolarIsBittenOnHarderThanIncisorsByTheirLevers) {
  const ScenarioResults molars = bite("0.2 s", {"choice.bar=left molars"});
  const double ratio = bite_force(molars, kRelease) / bite_force(held(), kRelease);
  EXPECT_GT(ratio, 1.3);  // 78 mm by 42 mm in front of the joint is 1.9, of a bite straight up
  EXPECT_LT(ratio, 2);
  EXPECT_GT(molars.last("joint_right.force.z [N]"), molars.last("joint_left.force.z [N]"));
}

// A bar that is held keeps the jaw where a free opening brings it, by a force fore or aft. One that
// gives way takes none, and the closers draw the condyles back into their fossae.
TEST(JawUnloading, OnABarThatGivesWayTheJawBitesStraightUpAndItsCondylesGoBack) {
  const ScenarioResults giving = bite("0.2 s", {"choice.bar=incisors, gives way"});
  EXPECT_EQ(giving.summary().at("outcome"), "finished");
  EXPECT_GT(giving.last("bite.force.z [N]"), 50);
  EXPECT_LT(std::abs(giving.last("bite.force.y [N]")), 1);
  const std::string condyle = "condyle_left.position.y [mm]";
  EXPECT_GT(giving.last(condyle), held().at(condyle, kRelease) + 3);
}

}  // namespace articular::unloading_test
