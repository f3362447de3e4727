// Excursions of the jaw of scenarios/mandible/: forward, and to either side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/scenarios/coarse_jaw.hpp"

namespace articular::excursions_test {

using sim::Vec3;

constexpr double kAtRest = 0.96, kHalf = 0.48;  // [s]

/// Coarse discs and steps, until the jaw rests at the end of its way.
ScenarioResults excursion(const std::string& movement, const std::vector<std::string>& more = {},
                          double duration = kAtRest) {
  std::vector<std::string> settings = {"choice.movement=" + movement, "accuracy=fast",
                                       "integrator.step=6 ms",
                                       "duration=" + std::to_string(duration) + " s"};
  settings.insert(settings.end(), more.begin(), more.end());
  return coarse_jaw("excursions.toml", settings);
}

/// From the start on: left, posterior, up [mm].
Vec3 way(const ScenarioResults& results, const std::string& point, double time = kAtRest) {
  const auto along = [&](const char* axis) {
    const std::string column = point + ".position." + axis + " [mm]";
    return results.at(column, time) - results.column(column).front();
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
// shift. Left and right are mirror images to what round-off leaves after half of the run.
TEST(JawExcursions, TheWorkingCondyleStaysAndSidesAreMirrorImages) {
  const ScenarioResults left = excursion("left"), right = excursion("right", {}, kHalf);
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
    const Vec3 other = way(right, mirrored, kHalf).cwiseProduct(Vec3(-1, 1, 1));
    EXPECT_GT(other.norm(), 0.1) << point;  // [mm]
    EXPECT_LT((way(left, point, kHalf) - other).norm(), 1e-6) << point;
  }
}

/// The same with teeth that guide, which take stronger protruders.
ScenarioResults guided_excursion(const std::string& movement, double duration = kAtRest) {
  return excursion(movement,
                   {"choice.teeth=guiding", "curve.protruders_left.value=[0,0,0.6]",
                    "curve.protruders_right.value=[0,0,0.6]"},
                   duration);
}

/// The largest force on a tooth [N] while the incisors have gone between these ways [mm] from the
/// start, level.
double largest_force(const ScenarioResults& results, const std::string& tooth, double from,
                     double to) {
  const auto along = [&](const std::string& name) -> const std::vector<double>& {
    return results.column(name);
  };
  const auto &x = along("incisor.position.x [mm]"), &y = along("incisor.position.y [mm]");
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double gone = std::hypot(x[i] - x[0], y[i] - y[0]);
    if (gone < from || gone > to) continue;
    double squares = 0;
    for (const char* axis : {"x", "y", "z"}) {
      const double f = along(tooth + ".force." + axis + " [N]")[i];
      squares += f * f;
    }
    largest = std::max(largest, std::sqrt(squares));
  }
  return largest;
}

// An overbite of 2.45 mm, of which the gap between the rows takes 0.3: the lower incisors pass
// below the upper ones, and the molars carry nothing on the way.
TEST(JawExcursions, IncisorsThatGuideLeadTheJawDownAndPartTheMolars) {
  const ScenarioResults results = guided_excursion("protrusion");
  EXPECT_EQ(results.summary().at("outcome"), "finished");
  const auto &y = results.column("incisor.position.y [mm]"),
             &z = results.column("incisor.position.z [mm]");
  double at_edges = 0;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (y[0] - y[i] < 3) at_edges = std::min(at_edges, z[i] - z[0]);
  EXPECT_NEAR(at_edges, -2.15, 0.25);
  EXPECT_GT(largest_force(results, "incisors", 0.5, 3), 10);
  for (const char* molars : {"molars_left", "molars_right"})
    EXPECT_EQ(largest_force(results, molars, 0.5, 20), 0);
}

TEST(JawExcursions, TheCanineOfThatSideGuidesAndSidesAreMirrorImages) {
  const ScenarioResults left = guided_excursion("left"), right = guided_excursion("right", kHalf);
  EXPECT_EQ(left.summary().at("outcome"), "finished");
  EXPECT_GT(largest_force(left, "canine_left", 1, 4), 10);
  EXPECT_LT(largest_force(left, "canine_right", 1, 4), 1);
  EXPECT_GT(largest_force(left, "canine_left", 1, 4), largest_force(left, "incisors", 1, 3));
  for (const char* back : {"molars_left", "molars_right", "premolars_left", "premolars_right"})
    EXPECT_LT(largest_force(left, back, 3, 20), 0.05) << back;
  // Edge to edge the two runs take other numbers of iterations, each to 0.9 um of a step.
  const Vec3 other = way(right, "incisor", kHalf).cwiseProduct(Vec3(-1, 1, 1));
  EXPECT_GT(other.norm(), 3.5);  // [mm]: the canine has guided it all the way
  EXPECT_LT((way(left, "incisor", kHalf) - other).norm(), 0.01);
}

// One muscle of one side does not pull: the jaw swerves to that side.
TEST(JawExcursions, AParalysedPterygoidLetsTheJawSwerveToItsSide) {
  const ScenarioResults results = excursion("protrusion", {"curve.protruders_left.value=[0,0,0]"});
  EXPECT_GT(way(results, "incisor").x(), 2);
  EXPECT_GT(-way(results, "condyle_right").y(), -way(results, "condyle_left").y() + 3);
}

}  // namespace articular::excursions_test
