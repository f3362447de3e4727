// Excursions of the jaw of scenarios/mandible/: forward, and to either side.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/scenarios/coarse_jaw.hpp"

namespace articular::excursions_test {

using sim::Vec3;

/// Coarse discs and steps, until the jaw rests at the end of its way.
ScenarioResults excursion(const std::string& movement, std::vector<std::string> more = {}) {
  more.insert(more.end(), {"choice.movement=" + movement, "accuracy=fast", "integrator.step=6 ms",
                           "duration=0.96 s"});
  return coarse_jaw("excursions.toml", more);
}

/// From the start to the end: left, posterior, up [mm].
Vec3 way(const ScenarioResults& results, const std::string& point) {
  const auto along = [&](const char* axis) {
    const auto& column = results.column(point + ".position." + axis + " [mm]");
    return column.back() - column.front();
  };
  return {along("x"), along("y"), along("z")};
}

// Published: 8.0 mm (Woelfel), 9.3 mm at incisors and 9.2 to 9.5 mm at condyles (Buschang), forward
// along the eminence.
TEST(JawExcursions, BothCondylesSlideDownTheEminenceInProtrusion) {
  const ScenarioResults results = excursion("protrusion");
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const Vec3 incisor = way(results, "incisor"), left = way(results, "condyle_left"),
             right = way(results, "condyle_right");
  EXPECT_GT(-incisor.y(), 7);
  EXPECT_LT(-incisor.y(), 11);
  EXPECT_LT(std::abs(incisor.z()), 1);  // the mouth stays closed
  EXPECT_GT(-left.y(), 6);
  EXPECT_LT(left.z(), -3);
  EXPECT_NEAR(incisor.x(), 0, 1e-6);
  EXPECT_NEAR((left - right.cwiseProduct(Vec3(-1, 1, 1))).norm(), 0, 1e-6);
}

// The balancing condyle slides, the working one turns in its fossa and gives way by a Bennett
// shift. Left and right are mirror images to what round-off leaves after the run.
TEST(JawExcursions, TheWorkingCondyleStaysAndSidesAreMirrorImages) {
  const ScenarioResults left = excursion("left"), right = excursion("right");
  EXPECT_EQ(left.summary().at("outcome"), "finished");
  const Vec3 working = way(left, "condyle_left"), balancing = way(left, "condyle_right");
  EXPECT_GT(way(left, "incisor").x(), 7);
  EXPECT_LT(way(left, "incisor").x(), 13);
  EXPECT_GT(-balancing.y(), 6);
  EXPECT_LT(balancing.z(), -3);
  EXPECT_LT(working.tail<2>().norm(), 1);
  EXPECT_GT(working.x(), 0);
  EXPECT_LT(working.x(), 2);
  for (const auto& [point, mirrored] : {std::pair("incisor", "incisor"),
                                        {"condyle_left", "condyle_right"},
                                        {"condyle_right", "condyle_left"}}) {
    const Vec3 other = way(right, mirrored).cwiseProduct(Vec3(-1, 1, 1));
    EXPECT_LT((way(left, point) - other).norm(), 1e-6) << point;  // [mm]
  }
}

// One muscle of one side does not pull: the jaw swerves to that side.
TEST(JawExcursions, AParalysedPterygoidLetsTheJawSwerveToItsSide) {
  const ScenarioResults results = excursion("protrusion", {"curve.protruders_left.value=[0,0,0]"});
  EXPECT_GT(way(results, "incisor").x(), 2);
  EXPECT_GT(-way(results, "condyle_right").y(), -way(results, "condyle_left").y() + 3);
}

}  // namespace articular::excursions_test
