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

// A line turns only what it ends on or wraps around.
TEST(MakeProbes, AnArmOnABodyThatALineDoesNotPullIsRefused) {
  Scenario s = balls("left", "floor");
  Ligament line;
  line.name = "string";
  line.path = {anchor("left", {-0.02, 0, 0.02}), anchor("wall", {0.1, 0, 0})};
  line.stiffness = 1000;
  s.ligaments = {line};
  for (const auto& [body, is_pulled] :
       {std::pair("left", true), std::pair("wall", true), std::pair("right", false)}) {
    s.probes[0].what = MomentArmProbe{"string", body, Vec3::Zero()};
    if (is_pulled)
      EXPECT_NO_THROW(build_model(s)) << body;
    else
      EXPECT_THROW(build_model(s), InputError) << body;
  }
  s.ligaments[0].wrap = {"right"};
  EXPECT_NO_THROW(build_model(s));
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

// Forces of one part are counted once, and as they act on one of the two bodies. Faces of "left"
// have their middles at x = −25, −21.7, −18.3 and −15 mm.
TEST(MakeProbes, ContactsThatCountAForceTwiceOrAgainstItselfAreRefused) {
  const auto part = [](const std::string& first, double low, double high) {
    ContactProbe contact{first, first == "left" ? "floor" : "left", Region{}};
    contact.region->box = {Vec3(low, -1, -1), Vec3(high, 1, 1)};
    return contact;
  };
  const auto of = [](const ContactProbe& one, const ContactProbe& other) {
    Scenario s = balls("left", "floor");
    s.probes = {{"one", one}, {"other", other}, {"both", ContactsProbe{{"one", "other"}}}};
    s.probes[2].where = {"scene.toml", 7, 1};
    try {
      build_model(s);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const ContactProbe whole{"left", "floor", {}}, turned{"floor", "left", {}};
  for (const std::string& said : {of(whole, whole), of(whole, part("left", -0.03, -0.01)),
                                  of(part("left", -0.022, 1), part("left", -1, -0.019))}) {
    EXPECT_NE(said.find("scene.toml:7"), std::string::npos) << said;
    EXPECT_NE(said.find("counts twice"), std::string::npos) << said;
  }
  EXPECT_NE(of(whole, turned).find("in opposite orders"), std::string::npos);
  EXPECT_EQ(of(part("left", -0.0201, 1), part("left", -1, -0.0201)), "");
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

// "left" is 10 mm long.
TEST(MakeProbes, ASpotFarLargerThanABodyIsRefused) {
  for (const auto& [first, second] : {std::pair("left", "floor"), std::pair("floor", "left")}) {
    Scenario s = balls(first, second);
    double& spot = std::get<ContactProbe>(s.probes[0].what).sensor.spot;
    spot = 19.9e-3;
    EXPECT_NO_THROW(build_model(s));
    spot = 20.1e-3;
    EXPECT_THROW(build_model(s), InputError);
  }
}

}  // namespace articular::sim::make_probes_test
