// Probes that could never show anything are refused.
#include "sim/build/make_probes.hpp"

#include <gtest/gtest.h>

#include <string>

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

// Forces of 0 would look like a result.
TEST(MakeProbes, ContactThatIsTurnedOffIsRefusedToo) {
  Scenario s = balls("left", "floor");
  s.contact = false;
  s.contacts.clear();
  try {
    build_model(s);
    FAIL() << "a probe of contact without contact";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("touch in this scene: contact = false"),
              std::string::npos)
        << error.what();
  }
}

// Faces of "left" have sides of 10 mm, those of the floor more.
TEST(MakeProbes, ASpotFarSmallerThanFacesIsRefused) {
  for (const auto& [first, second] : {std::pair("left", "floor"), std::pair("floor", "left")}) {
    Scenario s = balls(first, second);
    ContactsProbe both{{"touch"}};
    s.probes.push_back({"both", both});
    double& spot = std::get<ContactProbe>(s.probes[0].what).sensor.spot;
    double& spot_of_both = std::get<ContactsProbe>(s.probes[1].what).sensor.spot;
    spot = spot_of_both = 2.6e-3;
    EXPECT_NO_THROW(build_model(s));
    spot_of_both = 2.4e-3;
    EXPECT_THROW(build_model(s), InputError);
    spot = 2.4e-3;
    spot_of_both = 0;
    EXPECT_THROW(build_model(s), InputError);
  }
}

}  // namespace articular::sim::make_probes_test
