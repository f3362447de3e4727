// Probes that could never show anything are refused.
#include "sim/build/make_probes.hpp"

#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::make_probes_test {

/// Two balls over a floor, of which only one may touch it.
Scenario balls(const std::string& first, const std::string& second) {
  Scenario s = scene(1e-3);
  s.contact = true;
  s.bodies = {box_body("floor", Body::Kind::Fixed, {0.1, 0.1, 0.01}, {0, 0, -0.01}),
              box_body("wall", Body::Kind::Fixed, {0.01, 0.1, 0.1}, {0.1, 0, 0}),
              box_body("left", Body::Kind::Rigid, {0.01, 0.01, 0.01}, {-0.02, 0, 0.02}),
              box_body("right", Body::Kind::Rigid, {0.01, 0.01, 0.01}, {0.02, 0, 0.02})};
  ContactPair pair;
  pair.a = "left";
  pair.b = "floor";
  s.contacts = {pair};
  Probe probe;
  probe.name = "touch";
  probe.what = ContactProbe{first, second, {}};
  s.probes = {probe};
  return s;
}

TEST(MakeProbes, ContactOfBodiesThatMayNotTouchIsRefused) {
  EXPECT_NO_THROW(build_model(balls("left", "floor")));
  EXPECT_NO_THROW(build_model(balls("floor", "left")));
  for (const auto& [first, second] : {std::pair("right", "floor"), std::pair("left", "right"),
                                      std::pair("floor", "wall"), std::pair("left", "left")})
    EXPECT_THROW(build_model(balls(first, second)), InputError) << first << second;
}

// One key turns all contact off: probes then read 0, and need not be taken out.
TEST(MakeProbes, ContactThatIsTurnedOffIsNoMistakeOfAProbe) {
  Scenario s = balls("right", "floor");
  s.contact = false;
  EXPECT_NO_THROW(build_model(s));
}

}  // namespace articular::sim::make_probes_test
