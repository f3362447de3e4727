// scenarios/verification/wrap.toml.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/scenarios/scenario_results.hpp"

namespace articular::wrap_test {

// The nodes lie on the sphere and triangles within it, so that radius and length are a little
// small.
TEST(Wrap, AStringWoundUpOnADrumHasTheClosedForm) {
  const ScenarioResults results = run_scenario("verification/wrap.toml");
  constexpr double kRadius = 20, kWithin = 0.02;  // [mm]
  const double free = std::sqrt(60.0 * 60 - kRadius * kRadius);
  const double kept = 80 * std::numbers::pi / 180 - std::acos(kRadius / 60);
  const auto& time = results.column("time [s]");
  const auto& length = results.column("string.length [mm]");
  const auto& force = results.column("string.force [N]");
  const auto& arm = results.column("arm.moment_arm [mm]");
  const auto& moment = results.column("drum.moment.y [N m]");
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double s = time[i];
    const double turn = 70 * std::numbers::pi / 180 * s * s * (3 - 2 * s);
    EXPECT_NEAR(length[i], free + kRadius * (kept + turn), kWithin * kRadius * (kept + turn));
    EXPECT_NEAR(force[i], length[i] - length[0], 1e-7 * force.back());
    EXPECT_NEAR(arm[i], kRadius, 1.5 * kWithin * kRadius);
    EXPECT_NEAR(moment[i], 1e-3 * force[i] * arm[i], 1e-8);
  }
  EXPECT_NEAR(results.last("string.force [N]"), 24.435, kWithin * 24.435);
  // Not whole triangles at both ends: an element each.
  const double wound = kRadius * (kept + 70 * std::numbers::pi / 180);
  EXPECT_NEAR(results.last("wrap.contact_length [mm]"), wound, 4);
  EXPECT_GT(results.last("wrap.edges [-]"), 10);
  // What drives the drum does the work that is stored, at the order of the ledger's sums.
  const double stored = 0.5e-3 * force.back() * force.back();
  EXPECT_NEAR(results.last("energy.motion_work [J]"), stored, 1e-3 * stored);
}

}  // namespace articular::wrap_test
