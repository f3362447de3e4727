// Probes of motions, loads put together and stresses, beside closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/support/pressed_block.hpp"
#include "tests/sim/support/probes.hpp"
#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::motion_probe_test {

constexpr double kDegree = M_PI / 180;

/// A bone that turns about an upright axis through (10, 0, 0) mm at 90 degrees a second and rises
/// at 20 mm/s: a screw.
MotionLoad screw(const std::string& body) {
  MotionLoad motion = shift(body, 2, {0, 0, 0.04});
  motion.motion.rotation = {Vec3::Zero(), Vec3(0, 0, M_PI)};
  motion.motion.about = Vec3(0.01, 0, 0);
  return motion;
}

Scenario with_screw() {
  Scenario s = scene(0.01);
  s.bodies = {box_body("bone", Body::Kind::Fixed, {0.04, 0.02, 0.02}),
              box_body("other", Body::Kind::Fixed, {0.02, 0.02, 0.02}, {0, 0.1, 0})};
  s.loads = {screw("bone")};
  return s;
}

// 20 mm from the axis: an arc of 31.4 mm and a rise of 20 mm. A hundred chords are shorter than the
// helix by a part of (0.9 deg)²/24 of the arc.
TEST(WayProbe, OfAScrewIsThatOfAHelix) {
  Scenario s = with_screw();
  s.probes = {{"tip", WayProbe{anchor("bone", {-0.01, 0, 0})}}};
  Simulation run(s);
  EXPECT_EQ(Probes(run)("tip.straight [mm]"), 0);
  run.advance(1);
  const Probes probes(run);
  const double arc = 20 * 0.5 * M_PI, helix = std::hypot(arc, 20.0);
  EXPECT_NEAR(probes("tip.length [mm]"), helix, helix * std::pow(0.9 * kDegree, 2) / 24);
  EXPECT_NEAR(probes("tip.straight [mm]"), std::hypot(20 * std::sqrt(2.0), 20.0), 1e-9);
  EXPECT_NEAR(probes("tip.speed [mm/s]"), helix, 1e-6);
  // From (-10, 0) about (10, 0) it has come to (10, -20) and goes on along x.
  EXPECT_LT((probes.vec3("tip.velocity", "mm/s") - Vec3(arc, 0, 20)).norm(), 1e-6);
}

// What goes along does not move, and a place that stands still goes round.
TEST(WayProbe, InAFrameIsWhatThatBodySees) {
  Scenario s = with_screw();
  s.probes = {{"along", WayProbe{anchor("bone", {-0.01, 0, 0}), "bone"}},
              {"still", WayProbe{anchor("other", {0.01, 0.1, 0}), "bone"}},
              {"place", PointProbe{anchor("other", {0.01, 0.1, 0}), "bone"}},
              {"world", PointProbe{anchor("other", {0.01, 0.1, 0})}}};
  Simulation run(s);
  EXPECT_LT((Probes(run).vec3("place.position", "mm") - Vec3(10, 100, 0)).norm(), 1e-12);
  run.advance(1);
  const Probes probes(run);
  EXPECT_NEAR(probes("along.length [mm]"), 0, 1e-9);
  EXPECT_NEAR(probes("along.speed [mm/s]"), 0, 1e-9);
  const double helix = std::hypot(100 * 0.5 * M_PI, 20.0);
  EXPECT_NEAR(probes("still.length [mm]"), helix, 1e-4 * helix);
  EXPECT_NEAR(probes("still.speed [mm/s]"), helix, 1e-6);
  EXPECT_LT((probes.vec3("place.position", "mm") - Vec3(110, 0, -20)).norm(), 1e-9);
  EXPECT_LT((probes.vec3("world.position", "mm") - Vec3(10, 100, 0)).norm(), 1e-12);
}

// A part of a way is as long after a restart from a copied state: it is a part of that.
TEST(WayProbe, IsAPartOfTheState) {
  Scenario s = with_screw();
  s.probes = {{"tip", WayProbe{anchor("bone", {-0.01, 0, 0})}}};
  Simulation whole(s), second(s);
  whole.advance(1);
  Simulation first(s);
  first.advance(0.5);
  second.state = first.state;
  second.stepper.restart(second.state);
  second.advance(1);
  EXPECT_NEAR(Probes(second)("tip.length [mm]"), Probes(whole)("tip.length [mm]"), 1e-9);
}

TEST(HelicalAxisProbe, FindsTheAxisOfAScrew) {
  Scenario s = with_screw();
  s.probes = {{"axis", HelicalAxisProbe{"bone", "", {-0.01, 0.005, 0.003}}}};
  Simulation run(s);
  EXPECT_TRUE(std::isnan(Probes(run)("axis.center.x [mm]")));  // nothing has turned
  run.advance(1);
  const Probes probes(run);
  EXPECT_NEAR(probes("axis.angle [deg]"), 90, 1e-9);
  EXPECT_NEAR(probes("axis.slide [mm]"), 20, 1e-9);
  EXPECT_LT((probes.vec3("axis.direction", "-") - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((probes.vec3("axis.center", "mm") - Vec3(10, 0, 3)).norm(), 1e-9);
  EXPECT_NEAR(probes("axis.speed [deg/s]"), 90, 1e-6);
  EXPECT_NEAR(probes("axis.slide_now [mm/s]"), 20, 1e-6);
  EXPECT_LT((probes.vec3("axis.direction_now", "-") - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_LT((probes.vec3("axis.center_now", "mm") - Vec3(10, 0, 23)).norm(), 1e-6);
}

// Seen from the bone the other body turns the other way round, about the same axis.
TEST(HelicalAxisProbe, InAFrameIsOfWhatThatBodySees) {
  Scenario s = with_screw();
  s.probes = {{"other", HelicalAxisProbe{"other", "bone", {0, 0.1, 0}}},
              {"itself", HelicalAxisProbe{"bone", "bone", Vec3::Zero()}}};
  Simulation run(s);
  run.advance(1);
  const Probes probes(run);
  EXPECT_NEAR(probes("other.angle [deg]"), 90, 1e-9);
  EXPECT_LT((probes.vec3("other.direction", "-") + Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(probes("other.slide [mm]"), 20, 1e-9);  // down, along a direction that points down
  EXPECT_LT((probes.vec3("other.center", "mm") - Vec3(10, 0, 0)).norm(), 1e-9);
  EXPECT_LT((probes.vec3("other.direction_now", "-") + Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(probes("other.slide_now [mm/s]"), 20, 1e-6);
  EXPECT_NEAR(probes("itself.angle [deg]"), 0, 1e-9);
  EXPECT_TRUE(std::isnan(probes("itself.slide [mm]")));
}

// Two muscles at their optimal length pull along y: 3 N at 20 mm beside an upright axis, and 5 N at
// 10 mm on the other side.
TEST(MuscleMomentProbe, IsTheSumOfForcesTimesArms) {
  Scenario s = scene(0.1);
  s.bodies = {box_body("bone", Body::Kind::Fixed, {0.06, 0.02, 0.02}), stand("wall")};
  const auto pulling = [](const char* name, double x, double force) {
    Muscle muscle;
    muscle.name = name;
    muscle.path = {anchor("bone", {x, 0, 0}), anchor("wall", {x, 0.05, 0})};
    muscle.max_force = 10;
    muscle.excitation = {{0}, {force / 10}};
    return muscle;
  };
  s.muscles = {pulling("right", 0.02, 3), pulling("left", -0.01, 5)};
  const auto net = [](std::vector<std::string> muscles) {
    return MuscleMomentProbe{std::move(muscles), "bone", Vec3::Zero(), Vec3::UnitZ()};
  };
  s.probes = {{"both", net({"right", "left"})}, {"one", net({"left"})}};
  Simulation run(s);
  EXPECT_NEAR(Probes(run)("both.moment [N m]"), 3 * 0.02 - 5 * 0.01, 1e-12);
  EXPECT_NEAR(Probes(run)("one.moment [N m]"), -5 * 0.01, 1e-12);
}

/// The plate comes down on the block by 0.2 mm and shifts by 1 mm.
Scenario press() {
  Scenario s = pressed_block(1, shift("plate", 1, {1e-3, 0, -2e-4}));
  s.analysis = Scenario::Analysis::Static;
  return s;
}

double pressure() { return 2e-4 / (kSide / 20e3 + 1 / kStiffness); }

// The halves of a block beside each other are the block.
TEST(ContactsProbe, PutsContactsTogether) {
  Scenario s = press();
  s.probes = {{"both", ContactsProbe{{"low", "high"}}},
              {"low", half("block", "plate", -1)},
              {"high", half("block", "plate", 1)},
              {"whole", ContactProbe{"block", "plate"}}};
  Simulation run(s, contact_stiffness_of(kStiffness));
  EXPECT_TRUE(std::isnan(Probes(run)("both.center.x [mm]")));
  run.advance(1);
  const Probes probes(run);
  const double p = pressure(), force = p * kSide * kSide;
  EXPECT_NEAR(probes("both.force.z [N]"), -force, 1e-6 * force);
  EXPECT_NEAR(probes("both.area [mm^2]"), 1e6 * kSide * kSide, 1e-6);
  EXPECT_NEAR(probes("both.mean_pressure [Pa]"), p, 1e-6 * p);
  EXPECT_LT((probes.vec3("both.center", "mm") - probes.vec3("whole.center", "mm")).norm(), 1e-9);
  EXPECT_LT((probes.vec3("both.moment", "N m") - probes.vec3("whole.moment", "N m")).norm(),
            1e-12 * force * kSide);
  EXPECT_EQ(probes("both.max_pressure [Pa]"),
            std::max(probes("low.max_pressure [Pa]"), probes("high.max_pressure [Pa]")));
}

// Of the block the middle of its upper face; of the plate what lies over that by now.
TEST(ContactProbe, SaysWhereItsCenterWasOnItsBody) {
  Scenario s = press();
  s.probes = {{"block", ContactProbe{"block", "plate"}},
              {"plate", ContactProbe{"plate", "block"}},
              {"high", half("block", "plate", 1)}};
  Simulation run(s, contact_stiffness_of(kStiffness));
  run.advance(1);
  const Probes probes(run);
  EXPECT_LT((probes.vec3("block.center_at_start", "mm") - Vec3(0, 0, 10)).norm(), 1e-6);
  EXPECT_LT((probes.vec3("high.center_at_start", "mm") - Vec3(5, 0, 10)).norm(), 1e-6);
  EXPECT_LT((probes.vec3("plate.center_at_start", "mm") - Vec3(-1, 0, 10)).norm(), 1e-6);
}

TEST(StressProbe, OfAnEvenlyPressedBlockIsThePressure) {
  Scenario s = press();
  Region upper;
  upper.box = {Vec3(-1, -1, 0), Vec3(1, 1, 1)};
  s.probes = {{"all", StressProbe{"block"}}, {"upper", StressProbe{"block", upper}}};
  Simulation run(s, contact_stiffness_of(kStiffness));
  run.advance(1);
  const Probes probes(run);
  const double p = pressure();
  for (const std::string name : {"all", "upper"}) {
    EXPECT_NEAR(probes(name + ".mean_von_mises [Pa]"), p, 1e-6 * p);
    EXPECT_NEAR(probes(name + ".max_von_mises [Pa]"), p, 1e-6 * p);
    EXPECT_NEAR(probes(name + ".mean_pressure [Pa]"), p / 3, 1e-6 * p);
    EXPECT_NEAR(probes(name + ".least_principal [Pa]"), -p, 1e-6 * p);
    EXPECT_NEAR(probes(name + ".largest_principal [Pa]"), 0, 1e-6 * p);
  }
}

// The lower half hangs by its upper face and is drawn down by a tenth: only there is stress.
TEST(StressProbe, CountsElementsOfItsRegion) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {box_body("block", Body::Kind::Tissue, {kSide, kSide, kSide}, Vec3::Zero(), {2, 2, 2}),
              stand("wall"), stand("weight")};
  s.bodies[0].material = linear(20e3, 0);
  s.attachments = {attach("block", "wall", {-1, -1, -1e-4}, {1, 1, 1}),
                   attach("block", "weight", {-1, -1, -1}, {1, 1, -0.49 * kSide})};
  s.loads = {shift("weight", 1, {0, 0, -0.05 * kSide})};
  Region upper, lower;
  upper.box = {Vec3(-1, -1, 0), Vec3(1, 1, 1)};
  lower.box = {Vec3(-1, -1, -1), Vec3(1, 1, 0)};
  s.probes = {{"upper", StressProbe{"block", upper}}, {"lower", StressProbe{"block", lower}}};
  Simulation run(s);
  run.advance(1);
  EXPECT_NEAR(Probes(run)("upper.max_von_mises [Pa]"), 0, 1e-9);
  EXPECT_NEAR(Probes(run)("lower.mean_von_mises [Pa]"), 2e3, 1e-6);
  EXPECT_NEAR(Probes(run)("lower.largest_principal [Pa]"), 2e3, 1e-6);
}

using ProbeFile = ScenarioTest;

TEST_F(ProbeFile, MusclesOfANetMomentGoByPatterns) {
  const std::string muscles =
      "[[muscle]]\nname = \"jaw\"\nmirror = \"x\"\nmax_force = \"1 N\"\npath = [{ body = "
      "\"skull\", "
      "point = \"0.1 0 0 m\" }, { body = \"mandible\", point = \"0 0 1 m\" }]\n";
  const auto moment = [&](const std::string& more) {
    return kStart + muscles +
           "[[probe]]\nname = \"net\"\nkind = \"muscle_moment\"\nbody = \"mandible\"\npoint = \"0 "
           "0 0 m\"\naxis = [1, 0, 0]\n" +
           more;
  };
  const auto named = [&](const std::string& more) {
    return std::get<MuscleMomentProbe>(read(moment(more)).probes.at(0).what).muscles;
  };
  EXPECT_EQ(named("").size(), 2U);
  EXPECT_EQ(named("muscles = [\"*_left\", \"jaw_left\"]\n"), std::vector<std::string>{"jaw_left"});
  EXPECT_NE(refusal(moment("muscles = [\"jav*\"]\n")).find("no muscle with a `path` is called"),
            std::string::npos);
}

TEST_F(ProbeFile, ContactsAreOfContactProbes) {
  EXPECT_NE(refusal(kStart + "[[probe]]\nname = \"skull\"\nkind = \"reaction\"\nbody = \"skull\"\n"
                             "[[probe]]\nname = \"p\"\nkind = \"contacts\"\nof = [\"skull\"]\n")
                .find("expected names of contact probes, found `skull`"),
            std::string::npos);
}

}  // namespace articular::sim::motion_probe_test
