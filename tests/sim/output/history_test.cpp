// What probes record, beside closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fem/material/any_material.hpp"
#include "sim/base/error.hpp"
#include "tests/sim/support/pressed_block.hpp"
#include "tests/sim/support/probes.hpp"
#include "tests/sim/support/scenario_file.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::history_test {

/// The plate comes down by 0.2 mm and turns.
Scenario press(Scenario::Analysis analysis, double turn) {
  MotionLoad down = shift("plate", 0.2, {0, 0, -2e-4});
  down.motion.rotation = {Vec3::Zero(), Vec3(0, turn, 0)};
  down.motion.about = Vec3(0, 0, kSide / 2);
  Scenario s = pressed_block(analysis == Scenario::Analysis::Static ? 1 : 0.02, down);
  s.analysis = analysis;
  for (const auto& [first, second] : {std::pair("block", "plate"), std::pair("plate", "block")}) {
    const std::string name = first;
    s.probes.push_back({name, ContactProbe{first, second}});
    s.probes.push_back({name + "_low", half(first, second, -1)});
    s.probes.push_back({name + "_high", half(first, second, 1)});
  }
  s.probes.push_back(
      {"share", ShareProbe{{"block_high"}, {"block_low", "block_high"}, Vec3::UnitZ()}});
  return s;
}

/// Of a contact probe: force, its moment about the origin, area and what p sums to.
struct Carried {
  Vec3 force, moment;
  double area, normal_force;
};

Carried carried(const Probes& probes, const std::string& name) {
  const Vec3 force = probes.vec3(name + ".force", "N");
  const double area = probes(name + ".area [mm^2]");
  return {force,
          probes.vec3(name + ".moment", "N m") +
              1e-3 * probes.vec3(name + ".center", "mm").cross(force),
          area, probes(name + ".mean_pressure [Pa]") * area * 1e-6};
}

TEST(ContactProbe, CompartmentsAddUpToTheWholeOfEitherBodyInStaticsAndInTime) {
  for (const auto analysis : {Scenario::Analysis::Static, Scenario::Analysis::Dynamic}) {
    Simulation run(press(analysis, 0.004), contact_stiffness_of(kStiffness));
    run.advance(analysis == Scenario::Analysis::Static ? 1 : 0.3);
    const Probes probes(run);
    for (const std::string name : {"block", "plate"}) {
      const Carried whole = carried(probes, name), low = carried(probes, name + "_low"),
                    high = carried(probes, name + "_high");
      const double force = whole.force.norm();
      EXPECT_GT(force, 0.01);
      EXPECT_LT((low.force + high.force - whole.force).norm(), 1e-12 * force);
      EXPECT_LT((low.moment + high.moment - whole.moment).norm(), 1e-12 * force * kSide);
      EXPECT_NEAR(low.area + high.area, whole.area, 1e-12 * whole.area);
      EXPECT_NEAR(low.normal_force + high.normal_force, whole.normal_force, 1e-12 * force);
      EXPECT_EQ(std::max(probes(name + "_low.max_pressure [Pa]"),
                         probes(name + "_high.max_pressure [Pa]")),
                probes(name + ".max_pressure [Pa]"));
      EXPECT_LE(std::max(probes(name + "_low.max_face_pressure [Pa]"),
                         probes(name + "_high.max_face_pressure [Pa]")),
                probes(name + ".max_face_pressure [Pa]"));
      // The plate's turn about y presses harder where x > 0.
      EXPECT_GT(high.normal_force, 1.2 * low.normal_force);
      EXPECT_GT(probes(name + "_high.center.x [mm]"), 0);
      EXPECT_LT(probes(name + "_low.center.x [mm]"), 0);
    }
    const double high = probes("block_high.force.z [N]"), low = probes("block_low.force.z [N]");
    EXPECT_NEAR(probes("share.share [-]"), high / (high + low), 1e-15);
  }
}

// Uniform pressure: each half has half of the force, in the middle of its half, on half the area.
TEST(ContactProbe, HalfOfAUniformlyPressedBlockCarriesHalf) {
  Simulation run(press(Scenario::Analysis::Static, 0), contact_stiffness_of(kStiffness));
  run.advance(1);
  const Probes probes(run);
  const double p = 2e-4 / (kSide / 20e3 + 1 / kStiffness), area = kSide * kSide;
  for (const std::string name : {"block_low", "block_high"}) {
    EXPECT_NEAR(probes(name + ".force.z [N]"), -p * area / 2, 1e-6 * p * area);
    EXPECT_NEAR(probes(name + ".area [mm^2]"), 1e6 * area / 2, 1e-9);
    EXPECT_NEAR(probes(name + ".mean_pressure [Pa]"), p, 1e-6 * p);
    EXPECT_NEAR(std::abs(probes(name + ".center.x [mm]")), 1e3 * kSide / 4, 1e-6);
  }
  EXPECT_NEAR(probes("share.share [-]"), 0.5, 1e-6);
}

TEST(ContactProbe, ApartThereIsNoMeanPressureAndNoShare) {
  Simulation run(press(Scenario::Analysis::Dynamic, 0), contact_stiffness_of(kStiffness));
  const Probes probes(run);
  EXPECT_EQ(probes("block_low.mean_pressure [Pa]"), 0);
  EXPECT_TRUE(std::isnan(probes("block_low.center.x [mm]")));
  EXPECT_TRUE(std::isnan(probes("share.share [-]")));
}

// Force and counterforce leave nothing but round-off, of which there are no shares.
TEST(ContactProbe, OfForcesThatCancelThereIsNoShare) {
  Scenario s = press(Scenario::Analysis::Static, 0.004);
  s.probes.back().what =
      ShareProbe{{"block"}, {"block_low", "block_high", "plate"}, Vec3(0.48, 0.6, 0.64)};
  Simulation run(s, contact_stiffness_of(kStiffness));
  run.advance(1);
  const Probes probes(run);
  EXPECT_GT(carried(probes, "block").force.norm(), 0);
  EXPECT_TRUE(std::isnan(probes("share.share [-]")));
}

// Half of the surface that the plate presses on is tied to the wall: there contact goes straight
// into the bone. What the wall gets in all is what the plate gives, up to what statics leaves
// unbalanced (1e-6 of the largest force at each node).
TEST(AttachmentProbe, CountsContactOnTheTiedNodesToo) {
  Scenario s = press(Scenario::Analysis::Static, 0.004);
  s.bodies[0].material = neo_hookean(20e3, 0);  // turns without moment
  s.attachments.push_back(attach("block", "wall", {-1, -1, 0.49 * kSide}, {1e-6, 1, 1}));
  s.probes.back().what = ShareProbe{{"tied"}, {"block"}, Vec3::UnitZ()};
  s.probes.push_back({"tied", AttachmentProbe{"block", "wall"}});
  s.probes.push_back({"wall", ReactionProbe{"wall"}});
  Simulation run(s, contact_stiffness_of(kStiffness));
  run.advance(1);
  const Probes probes(run);
  const Carried plate = carried(probes, "block"), tied_half = carried(probes, "block_low");
  const double force = plate.force.norm();
  // Where nothing gives way pressure is much larger than on the free half.
  EXPECT_GT(tied_half.force.norm(), 0.5 * force);
  EXPECT_LT((probes.vec3("tied.force", "N") - plate.force).norm(), 1e-5 * force);
  EXPECT_LT((probes.vec3("tied.moment", "N m") - plate.moment).norm(), 1e-5 * force * kSide);
  EXPECT_LT((probes.vec3("wall.force", "N") - probes.vec3("tied.force", "N")).norm(),
            1e-12 * force);
  EXPECT_LT((probes.vec3("wall.moment", "N m") - probes.vec3("tied.moment", "N m")).norm(),
            1e-12 * force * kSide);
  EXPECT_NEAR(probes("share.share [-]"), 1, 1e-5);
}

/// A bar of 4 mm that stands at z = 0, in two halves, and two bodies to attach it to.
std::string bar_and_plates(const std::string& material) {
  return R"(
duration = "1 s"
contact = false
[[body]]
name = "bar"
kind = "tissue"
geometry = { box = { size = "1 1 4 mm", cells = [1, 1, 2], center = "0 0 2 mm" } }
density = "1 g/cm^3"
material = )" +
         material + R"(
[[body]]
name = "wall"
kind = "fixed"
[[body]]
name = "plate"
kind = "fixed"
)";
}

// Half of a bar is drawn out by 2, the other half not at all, and none becomes narrower.
TEST(TissueProbes, HaveTheMeanOverTheVolumeAndTheExtremesOfFibresAndVolumes) {
  const TemporaryFolder folder;
  const std::string material =
      R"({ law = "transversely-isotropic", c10 = "1 kPa", c3 = "1 kPa", c4 = 1, c5 = "1 kPa", toe_end = 1.1, bulk_modulus = "10 kPa", prestretch = 1.1, fibres = { direction = [0, 0, 1] } })";
  const std::string text = bar_and_plates(material) + R"(
[[attach]]
body = "bar"
to = "wall"
region = { box = ["-1 -1 -1 mm", "1 1 2.1 mm"] }
[[attach]]
body = "bar"
to = "plate"
region = { box = ["-1 -1 3.9 mm", "1 1 5 mm"] }
[[load]]
kind = "motion"
body = "plate"
time = ["0 s", "1 s"]
translation = ["0 0 0 mm", "0 0 2 mm"]
[[probe]]
name = "fibres"
kind = "fibres"
body = "bar"
[[probe]]
name = "bar"
kind = "volume"
body = "bar"
[output]
length_unit = "mm"
)";
  Simulation run(read_scenario(folder.file("bar.toml", text)));
  run.advance(1);
  const Probes probes(run);
  EXPECT_NEAR(probes("fibres.stretch [-]"), 1.1 * 1.5, 1e-9);
  EXPECT_NEAR(probes("fibres.largest_stretch [-]"), 1.1 * 2, 1e-9);
  EXPECT_NEAR(probes("fibres.least_stretch [-]"), 1.1, 1e-9);
  EXPECT_NEAR(probes("bar.volume [mm^3]"), 6, 1e-9);
  EXPECT_NEAR(probes("bar.ratio [-]"), 1.5, 1e-9);
  EXPECT_NEAR(probes("bar.largest_ratio [-]"), 2, 1e-9);
  EXPECT_NEAR(probes("bar.least_ratio [-]"), 1, 1e-9);
  EXPECT_NEAR(probes("bar.ratio_spread [-]"), 0.5, 1e-9);
}

// A bar of 4 mm in a plate that turns by a right angle and moves: the bar goes along, and reaches
// as far in the plate as before. In the frame of the wall it lies along another axis.
TEST(ExtentProbe, IsAlongAnAxisThatGoesWithItsBody) {
  const TemporaryFolder folder;
  const auto probe = [](const char* name, const char* frame, const char* direction) {
    return std::string("[[probe]]\nkind = \"extent\"\nbody = \"bar\"\nname = \"") + name +
           "\"\nframe = \"" + frame + "\"\npoint = \"0 0 1 mm\"\ndirection = " + direction + "\n";
  };
  const std::string material =
      R"({ law = "neo-hookean", young_modulus = "1 kPa", poisson_ratio = 0.3 })";
  const std::string text = bar_and_plates(material) + R"(
[[attach]]
body = "bar"
to = "plate"
region = { box = ["-1 -1 -1 mm", "1 1 5 mm"] }
[[load]]
kind = "motion"
body = "plate"
time = ["0 s", "1 s"]
translation = ["0 0 0 mm", "3 0 0 mm"]
rotation = ["0 0 0 deg", "0 90 0 deg"]
)" + probe("in_plate", "plate", "[0, 0, 2]") +
                           probe("in_wall", "wall", "[0, 0, 1]") +
                           probe("along", "wall", "[1, 0, 0]");
  Simulation run(read_scenario(folder.file("bar.toml", text)));
  run.advance(1);
  const Probes probes(run);
  EXPECT_NEAR(probes("in_plate.largest [mm]"), 3, 1e-9);
  EXPECT_NEAR(probes("in_plate.least [mm]"), -1, 1e-9);
  EXPECT_NEAR(probes("in_wall.largest [mm]"), -0.5, 1e-9);
  EXPECT_NEAR(probes("in_wall.least [mm]"), -1.5, 1e-9);
  EXPECT_NEAR(probes("along.largest [mm]"), 7, 1e-9);
  EXPECT_NEAR(probes("along.least [mm]"), 3, 1e-9);
}

TEST(LineProbe, ALigamentHasItsForceAndItsStrainFromSlack) {
  Scenario s = scene(0.1);
  s.bodies = {stand("a"), stand("b")};
  Ligament ligament;
  ligament.name = "acl";
  ligament.path = {anchor("a", Vec3::Zero()), anchor("b", {0, 0, 0.03})};
  ligament.law = Ligament::Law::Blankevoort;
  ligament.stiffness = 5000;
  ligament.reference_strain = 0.02;
  s.ligaments = {ligament};
  s.loads = {shift("b", 1, {0, 0, 0.003})};
  s.probes = {{"acl", LineProbe{"acl"}}};
  Simulation run(s);
  EXPECT_NEAR(Probes(run)("acl.strain [-]"), 0.02, 1e-15);
  EXPECT_NEAR(Probes(run)("acl.force [N]"), 5000 * 0.02 * 0.02 / (4 * 0.03), 1e-9);
  run.advance(1);
  const double strain = 1.1 * 1.02 - 1;  // beyond the toe
  EXPECT_NEAR(Probes(run)("acl.strain [-]"), strain, 1e-12);
  EXPECT_NEAR(Probes(run)("acl.force [N]"), 5000 * (strain - 0.03), 1e-8);
}

// Between flat ends that are drawn apart by a tenth the mean of F along them is 1.1.
TEST(LineProbe, AMuscleOfFibresHasItsActivationAndItsMeanStretch) {
  Scenario s = scene(0.1);
  s.analysis = Scenario::Analysis::Static;
  s.bodies = {stand("a"), stand("b"),
              box_body("block", Body::Kind::Tissue, {0.01, 0.01, 0.03}, Vec3::Zero(), {2, 2, 6})};
  s.bodies[2].material = material_of(fem::BlemkerMuscle<>(fem::MuscleFibre({}), {.c10 = 1e4}));
  s.bodies[2].material->fibres = Fibres{Vec3::UnitZ()};
  s.attachments = {attach("block", "a", {-1, -1, -0.0151}, {1, 1, -0.0149}),
                   attach("block", "b", {-1, -1, 0.0149}, {1, 1, 0.0151})};
  Muscle muscle;
  muscle.name = "fibres";
  muscle.tissue = "block";
  muscle.excitation = {{0, 1}, {0, 0.5}};
  s.muscles = {muscle};
  s.loads = {shift("b", 1, {0, 0, 0.003})};
  s.probes = {{"fibres", LineProbe{"fibres"}}};
  Simulation run(s);
  EXPECT_NEAR(Probes(run)("fibres.stretch [-]"), 1, 1e-12);
  run.advance(1);
  EXPECT_NEAR(Probes(run)("fibres.stretch [-]"), 1.1, 0.002);
  EXPECT_NEAR(Probes(run)("fibres.activation [-]"), 0.5, 1e-12);
}

// A driven box that a line pulls at: the moment is about its middle, where that is by then.
TEST(ReactionProbe, ADrivenBodyHasForceAndMomentAboutItsMiddle) {
  Scenario s = scene(0.1);
  const Vec3 middle(0.1, 0.2, 0.3), corner(0.11, 0.21, 0.32), wall(0, 1, 0);
  s.bodies = {box_body("box", Body::Kind::Fixed, {0.02, 0.04, 0.06}, middle), stand("wall")};
  Ligament spring;
  spring.name = "spring";
  spring.path = {anchor("wall", wall), anchor("box", corner)};
  spring.stiffness = 100;
  spring.slack_length = 0.5;
  s.ligaments = {spring};
  MotionLoad motion = shift("box", 1, {0.05, 0, 0});
  motion.motion.rotation = {Vec3::Zero(), Vec3(0, 0, 1.5)};
  s.loads = {motion};
  s.probes = {{"box", ReactionProbe{"box"}}};
  Simulation run(s);
  run.advance(1);
  const Mat3 R = rotation_matrix({0, 0, 1.5});
  const Vec3 end = R * corner + Vec3(0.05, 0, 0);
  const Vec3 pull = 100 * ((wall - end).norm() - 0.5) * (wall - end).normalized();
  const Probes probes(run);
  EXPECT_LT((probes.vec3("box.force", "N") - pull).norm(), 1e-9);
  EXPECT_LT((probes.vec3("box.moment", "N m") - (R * (corner - middle)).cross(pull)).norm(), 1e-9);
}

/// The jaw's frame: x left, y posterior, z up.
JointSide side_at(const std::string& body, bool is_right, const Vec3& origin) {
  return {body, origin, Vec3(is_right ? -1 : 1, 0, 0), Vec3::UnitZ()};
}

/// Flexion takes the shank back, abduction outwards, internal rotation the toes inwards: rotations
/// about x, then the y that has turned with it, then the z of the shank.
Mat3 shank_turned(double flexion, double abduction, double internal, bool is_right) {
  const double s = is_right ? 1 : -1;
  return rotation_matrix({flexion, 0, 0}) * rotation_matrix({0, s * abduction, 0}) *
         rotation_matrix({0, 0, s * internal});
}

TEST(JointCoordinates, GiveBackTheTurnsThatAPoseIsComposedOf) {
  const Mat3 thigh = rotation_matrix({0.3, -0.8, 2.1});
  for (const bool is_right : {true, false})
    for (const double flexion : {-0.1, 0.0, 0.5, 2.4})
      for (const double abduction : {-0.3, 0.0, 0.2})
        for (const double internal : {-0.4, 0.0, 0.7}) {
          const JointFrame femur =
              proximal_frame(side_at("femur", is_right, Vec3::Zero()), is_right, 0, {}, {});
          const JointFrame tibia =
              distal_frame(side_at("tibia", is_right, Vec3::Zero()), is_right, 1, {}, {});
          const Pose distal{Vec3::Zero(),
                            thigh * shank_turned(flexion, abduction, internal, is_right)};
          const JointCoordinates q =
              joint_coordinates(femur, {Vec3::Zero(), thigh}, tibia, distal, is_right);
          EXPECT_NEAR(q.flexion, flexion, 1e-14);
          EXPECT_NEAR(q.abduction, abduction, 1e-14);
          EXPECT_NEAR(q.internal_rotation, internal, 1e-14);
          EXPECT_LT(std::abs(q.lateral) + std::abs(q.anterior) + std::abs(q.distraction), 1e-15);
        }
}

// In a knee bent by 90 degrees (shank towards +y): its forward is down, and away from the thigh is
// back.
TEST(JointCoordinates, TranslationsAreAlongLateralFloatingAndShankAxis) {
  for (const bool is_right : {true, false}) {
    const double out = is_right ? -1 : 1;
    const JointFrame femur =
        proximal_frame(side_at("femur", is_right, {0, 0, 0.02}), is_right, 0, {}, {});
    const JointFrame tibia =
        distal_frame(side_at("tibia", is_right, {0, 0, -0.01}), is_right, 1, {}, {});
    JointCoordinates q = joint_coordinates(
        femur, {}, tibia, {Vec3(3e-3 * out, -2e-3, -1e-3), Mat3::Identity()}, is_right);
    EXPECT_NEAR(q.lateral, 3e-3, 1e-15);
    EXPECT_NEAR(q.anterior, 2e-3, 1e-15);
    EXPECT_NEAR(q.distraction, 31e-3, 1e-15);
    const Mat3 bent = rotation_matrix({M_PI / 2, 0, 0});
    const Vec3 origin = Vec3(0, 0, 0.02) + Vec3(3e-3 * out, 5e-3, -7e-3);
    q = joint_coordinates(femur, {}, tibia, {origin - bent * Vec3(0, 0, -0.01), bent}, is_right);
    EXPECT_NEAR(q.flexion, M_PI / 2, 1e-14);
    EXPECT_NEAR(q.lateral, 3e-3, 1e-15);
    EXPECT_NEAR(q.anterior, 7e-3, 1e-15);
    EXPECT_NEAR(q.distraction, 5e-3, 1e-15);
  }
}

TEST(JointCoordinates, HaveNoFlexionAtARightAngleOfAbduction) {
  const JointFrame femur = proximal_frame(side_at("femur", true, Vec3::Zero()), true, 0, {}, {});
  const JointFrame tibia = distal_frame(side_at("tibia", true, Vec3::Zero()), true, 1, {}, {});
  const JointCoordinates q =
      joint_coordinates(femur, {}, tibia, {Vec3::Zero(), shank_turned(0, M_PI / 2, 0, true)}, true);
  EXPECT_NEAR(q.abduction, M_PI / 2, 1e-7);
  EXPECT_TRUE(std::isnan(q.flexion));
}

TEST(JointProbe, ADrivenTibiaHasTheCoordinatesOfItsMotion) {
  Scenario s = scene(0.1);
  s.bodies = {box_body("femur", Body::Kind::Fixed, {0.04, 0.04, 0.04}, {0, 0, 0.03}),
              box_body("tibia", Body::Kind::Fixed, {0.04, 0.04, 0.04}, {0, 0.01, -0.03})};
  MotionLoad motion = shift("tibia", 1, {0, 0, -0.004});
  motion.motion.rotation = {Vec3::Zero(), Vec3(0.6, 0, 0)};
  s.loads = {motion};
  s.probes = {{"knee", JointProbe{side_at("femur", false, Vec3::Zero()),
                                  side_at("tibia", false, Vec3::Zero()), false}}};
  Simulation run(s);
  run.advance(1);
  const Probes probes(run);
  EXPECT_NEAR(probes("knee.flexion [deg]"), 0.6 * 180 / M_PI, 1e-10);
  EXPECT_NEAR(probes("knee.abduction [deg]"), 0, 1e-12);
  EXPECT_NEAR(probes("knee.distraction [mm]"), 4 * std::cos(0.6), 1e-12);
  EXPECT_NEAR(probes("knee.anterior [mm]"), 4 * std::sin(0.6), 1e-12);
}

using ProbeFile = ScenarioTest;

TEST_F(ProbeFile, SharesAndJointsAreRead) {
  const Scenario s = read(kStart + R"(
[[probe]]
name = "skull"
kind = "reaction"
body = "skull"
[[probe]]
name = "share"
kind = "share"
part = ["skull"]
whole = ["skull"]
direction = [0, 0, 2]
[[probe]]
name = "jaw"
kind = "joint"
side = "left"
proximal = { body = "skull", point = "1 2 3 mm", lateral = [1, 0, 0], up = [0, 0, 1] }
distal = { body = "mandible", point = "0 0 0 mm", lateral = [1, 0, 0], up = [0, 0, 1] }
)");
  ASSERT_EQ(s.probes.size(), 3U);
  const auto& share = std::get<ShareProbe>(s.probes[1].what);
  EXPECT_EQ(share.part, std::vector<std::string>{"skull"});
  EXPECT_EQ(share.direction, Vec3::UnitZ());
  const auto& joint = std::get<JointProbe>(s.probes[2].what);
  EXPECT_FALSE(joint.is_right);
  EXPECT_LT((joint.proximal.origin - Vec3(1e-3, 2e-3, 3e-3)).norm(), 1e-15);
}

TEST_F(ProbeFile, WhatSharesAndJointsCannotBeIsRefused) {
  const auto expect = [&](const std::string& text, const std::string& words) {
    EXPECT_NE(refusal(kStart + "[[probe]]\nname = \"p\"\n" + text).find(words), std::string::npos)
        << refusal(kStart + "[[probe]]\nname = \"p\"\n" + text);
  };
  const std::string skull =
      "proximal = { body = \"skull\", point = \"0 0 0 m\", "
      "lateral = [1, 0, 0], up = [0, 0, 1] }\n";
  expect("kind = \"share\"\npart = [\"p\"]\nwhole = [\"p\"]\ndirection = [0, 0, 1]\n",
         "expected names of contact, attachment or reaction probes, found `p`");
  expect("kind = \"share\"\npart = [\"p\"]\nwhole = [\"p\"]\n", "`direction`");
  expect("kind = \"joint\"\nside = \"right\"\n" + skull +
             "distal = { body = \"skull\", point = \"0 0 0 m\", lateral = [1, 0, 0], "
             "up = [0, 0, 1] }\n",
         "a joint needs two bodies");
  expect("kind = \"joint\"\nmirror = \"x\"\nside = \"right\"\n" + skull,
         "`mirror` does not belong here");
  expect("kind = \"energy\"\nregion = {}\n", "the probe is of kind \"energy\"");
}

TEST(History, RefusesWhatIsNoNumber) {
  Scenario s = scene(1e-3);
  s.bodies = {mass_body("mass", 1)};
  s.probes = {Probe{.name = "energies", .what = EnergyProbe{}}};
  Simulation run(s);
  History history(run.model, {});
  history.record(run.state, run.stepper);
  run.state.energy.load_work = std::numeric_limits<double>::infinity();
  EXPECT_THROW(history.record(run.state, run.stepper), SimulationError);
}

}  // namespace articular::sim::history_test
