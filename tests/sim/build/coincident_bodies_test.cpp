// A body that stands in the scene twice.
#include <gtest/gtest.h>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::coincident_bodies_test {

constexpr double kSide = 0.01;  // [m]

Scenario two_boxes(const Vec3& apart, Body::Kind second) {
  Scenario s = contact_scene(1e-3);
  const Vec3 size = Vec3::Constant(kSide);
  s.bodies = {box_body("one", Body::Kind::Tissue, size, {0.1, 0.2, 0.3}, {2, 2, 2}),
              box_body("two", second, size, Vec3(0.1, 0.2, 0.3) + apart, {2, 2, 2})};
  return s;
}

std::string error_of(const Scenario& scenario) {
  try {
    (void)build_model(scenario);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CoincidentBodies, TheSameMeshAtTheSamePlaceIsRefusedWithBothNames) {
  for (const Body::Kind kind : {Body::Kind::Tissue, Body::Kind::Rigid, Body::Kind::Fixed})
    for (const double rounding : {0.0, 1e-13}) {
      const std::string message = error_of(two_boxes(Vec3::Constant(rounding), kind));
      EXPECT_NE(message.find("bodies `one` and `two` are the same mesh at the same place"),
                std::string::npos)
          << message;
    }
}

TEST(CoincidentBodies, BodiesThatLieFlushOrAreTiedOrCannotMeetAreNot) {
  EXPECT_EQ(error_of(two_boxes({kSide, 0, 0}, Body::Kind::Tissue)), "");
  EXPECT_EQ(error_of(two_boxes({0, 0, 1e-6}, Body::Kind::Tissue)), "");
  Scenario tied = two_boxes(Vec3::Zero(), Body::Kind::Fixed);
  tied.attachments = {attach("one", "two", {-1, -1, -1}, {1, 1, 0.2951})};
  EXPECT_EQ(error_of(tied), "");
  Scenario without_contact = two_boxes(Vec3::Zero(), Body::Kind::Tissue);
  without_contact.contact = false;
  EXPECT_EQ(error_of(without_contact), "");
}

TEST(CoincidentBodies, AContactProbeOfABodyWithItselfNeedsSelfContact) {
  Scenario s = two_boxes({2 * kSide, 0, 0}, Body::Kind::Tissue);
  Probe probe;
  probe.name = "fold";
  probe.what = ContactProbe{"one", "one", {}};
  s.probes = {probe};
  EXPECT_NE(error_of(s).find("probe `fold` observes contact of `one` with itself"),
            std::string::npos);
  ContactPair self;
  self.a = self.b = "one";
  s.contacts = {self};
  EXPECT_EQ(error_of(s), "");
}

}  // namespace articular::sim::coincident_bodies_test
