// Which sizes, densities, stiffnesses and forces are doubted.
#include "sim/build/unit_doubts.hpp"

#include <gtest/gtest.h>

#include "sim/build/build_model.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim::unit_doubts_test {

/// A block of cartilage, a bone and a muscle between bone and floor.
Scenario usual() {
  Scenario s = scene(1e-3);
  Body bone = box_body("bone", Body::Kind::Rigid, {0.1, 0.1, 0.1}, {1, 0, 0});
  bone.density = 1800;
  s.bodies = {box_body("block", Body::Kind::Tissue, {0.02, 0.02, 0.02}), bone, stand("floor")};
  Muscle muscle;
  muscle.name = "masseter";
  muscle.path = {anchor("bone", {1, 0, 0}), anchor("floor", {1, 0, 0.3})};
  muscle.max_force = 300;
  muscle.excitation = {{0}, {1}};
  s.muscles = {muscle};
  return s;
}

/// From the bone to the floor. @param length  [m]
Ligament of_length(double length) {
  Ligament ligament;
  ligament.name = "acl";
  ligament.path = {anchor("bone", {1, 0, 0}), anchor("floor", {1, 0, length})};
  return ligament;
}

std::size_t num_doubts(const Scenario& s) { return build_model(s).warnings.size(); }

TEST(UnitDoubts, AreNoneOfWhatIsUsual) { EXPECT_EQ(num_doubts(usual()), 0U); }

TEST(UnitDoubts, AreOfSizeBothWays) {
  for (const double factor : {1e-3, 1e3}) {
    Scenario s = usual();
    std::get<BoxGeometry>(s.bodies[0].geometry).size *= factor;
    s.contact = false;
    EXPECT_EQ(num_doubts(s), 1U) << factor;
  }
}

TEST(UnitDoubts, AreOfDensityBothWays) {
  for (const std::size_t body : {0U, 1U})
    for (const double factor : {1e-3, 1e3}) {
      Scenario s = usual();
      s.bodies[body].density = *s.bodies[body].density * factor;
      EXPECT_EQ(num_doubts(s), 1U) << body << " " << factor;
    }
}

TEST(UnitDoubts, AreOfAMass) {
  for (const double mass : {99.0, 101.0}) {
    Scenario s = usual();
    s.bodies.push_back(mass_body("bob", mass, {0, 0, 0.5}, Vec3::Constant(1)));
    EXPECT_EQ(num_doubts(s), mass < 100 ? 0U : 1U) << mass;
  }
}

TEST(UnitDoubts, AreOfGravityBothWays) {
  for (const double g : {0.0, 0.09, 0.11, 49.0, 51.0}) {
    Scenario s = usual();
    s.loads = {GravityLoad{{0, 0, -g / 2}, {}, {{0, 1}, {0, 2}}}};
    EXPECT_EQ(num_doubts(s), g == 0 || (g > 0.1 && g < 50) ? 0U : 1U) << g;
  }
}

TEST(UnitDoubts, AreOfForcesAndMomentsAtTheirLargest) {
  for (const double factor : {0.9, 1.1}) {
    Scenario s = usual();
    ForceLoad force;
    force.at = anchor("bone", {1, 0, 0});
    force.force = {0, 0, -1e4 * factor};
    force.profile = {{0, 1}, {0, -2}};
    MomentLoad moment{"bone", {0, 1e3 * factor, 0}, {{0, 1}, {0, 2}}, {}};
    s.loads = {force, moment};
    EXPECT_EQ(num_doubts(s), factor < 1 ? 0U : 2U) << factor;
  }
}

TEST(UnitDoubts, AreOfAMotionOfMetres) {
  for (const double way : {0.9, 1.1}) {
    Scenario s = usual();
    s.loads = {shift("floor", 1, {0, way, 0})};
    EXPECT_EQ(num_doubts(s), way < 1 ? 0U : 1U) << way;
  }
}

TEST(UnitDoubts, AreOfALigamentsStiffnessByItsLaw) {
  for (const double stiffness : {0.9e6, 1.1e6, 0.9e7, 1.1e7}) {
    Scenario s = usual();
    Ligament ligament = of_length(0.3);
    ligament.stiffness = stiffness;
    s.ligaments = {ligament};
    EXPECT_EQ(num_doubts(s), stiffness < 1e7 ? 0U : 1U) << stiffness;
    s.ligaments[0].law = Ligament::Law::Blankevoort;
    EXPECT_EQ(num_doubts(s), stiffness < 1e6 ? 0U : 1U) << stiffness;
  }
}

TEST(UnitDoubts, AreOfALigamentThatIsSofterThanAThread) {
  for (const double stiffness : {0.9, 1.1}) {
    Scenario s = usual();
    Ligament ligament = of_length(0.3);
    ligament.stiffness = stiffness;
    s.ligaments = {ligament};
    EXPECT_EQ(num_doubts(s), stiffness > 1 ? 0U : 1U) << stiffness;
  }
}

TEST(UnitDoubts, AreOfALayersThicknessAndModulus) {
  const auto doubts_of = [](double thickness, double modulus) {
    Scenario s = usual();
    s.bodies[1].layer = Layer{thickness, modulus, 0.3};
    return num_doubts(s);
  };
  EXPECT_EQ(doubts_of(2e-3, 5e6), 0U);
  EXPECT_EQ(doubts_of(2, 5e6), 1U);
  EXPECT_EQ(doubts_of(0.9e-6, 5e6), 1U);
  EXPECT_EQ(doubts_of(2e-3, 5), 1U);
  EXPECT_EQ(doubts_of(2e-3, 5e11), 1U);
  Scenario s = usual();
  s.muscles.clear();
  s.bodies[2] = box_body("floor", Body::Kind::Fixed, {5, 5, 1}, {0, 0, -2});
  s.bodies[2].layer = Layer{2, 5e6, 0.3};
  EXPECT_EQ(num_doubts(s), 1U) << "of a floor, whose size is not doubted";
}

TEST(UnitDoubts, AreOfTimeConstantsAndTheLengthRatioOfAMuscle) {
  const auto doubts_of = [](double activation, double deactivation, double ratio) {
    Scenario s = usual();
    s.muscles[0].activation_time = activation;
    s.muscles[0].deactivation_time = deactivation;
    s.muscles[0].max_length_ratio = ratio;
    return num_doubts(s);
  };
  EXPECT_EQ(doubts_of(0.9, 0.9, 2.9), 0U);
  EXPECT_EQ(doubts_of(15, 0.05, 1.3), 1U);
  EXPECT_EQ(doubts_of(0.015, 50, 1.3), 1U);
  EXPECT_EQ(doubts_of(0.015, 0.05, 130), 1U);
  EXPECT_EQ(doubts_of(5e-5, 0.05, 1.3), 1U);
}

TEST(UnitDoubts, AreOfASpeedAtTheStart) {
  for (const double speed : {19.0, 21.0}) {
    Scenario s = usual();
    s.bodies[1].velocity = {0, speed, 0};
    EXPECT_EQ(num_doubts(s), speed < 20 ? 0U : 1U) << speed;
  }
}

// Poisson's ratio is negative where the bulk modulus is less than 2/3 of the shear modulus, 20 kPa
// here; and next to fibres of the modulus c5 where it is less than 2/9 of it.
// The middle of the bone lies at x = 1 m.
TEST(UnitDoubts, AreOfAHoldFarFromItsBody) {
  for (const double apart : {1.9, 2.1}) {
    Scenario s = usual();
    s.bodies[1].hold = Hold{};
    s.bodies[1].hold->held[1] = true;
    s.bodies[1].hold->at = Vec3(1 + apart, 0, 0);
    EXPECT_EQ(num_doubts(s), apart < 2 ? 0U : 1U) << apart;
  }
}

TEST(UnitDoubts, AreOfALigamentsLength) {
  for (const double length : {0.9, 1.1}) {
    Scenario s = usual();
    Ligament ligament = of_length(0.8);
    ligament.stiffness = 100;
    ligament.slack_length = length;
    s.ligaments = {ligament};
    EXPECT_EQ(num_doubts(s), length < 1 ? 0U : 1U) << length;
  }
}

// The middle of the bone lies at x = 1 m.
TEST(UnitDoubts, AreOfAProbesPointFarFromItsBody) {
  for (const double distance : {1.9, 2.1}) {
    const Vec3 point(1, distance, 0);  // the bone lies at x = 1
    const auto expect = [&](const auto& what) {
      Scenario s = usual();
      s.probes = {{"probe", what}};
      EXPECT_EQ(num_doubts(s), distance < 2 ? 0U : 1U) << what.body << " " << distance;
    };
    expect(HelicalAxisProbe{"bone", "", point});
    expect(MomentArmProbe{"masseter", "bone", point});
    expect(MuscleMomentProbe{{"masseter"}, "bone", point});
    Scenario s = usual();
    s.probes = {{"extent", ExtentProbe{"block", "bone", point, Vec3::UnitZ()}}};
    EXPECT_EQ(num_doubts(s), distance < 2 ? 0U : 1U) << "extent " << distance;
    const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
    s.probes = {{"joint", JointProbe{{"floor", Vec3::Zero(), x, z}, {"bone", point, x, z}}}};
    EXPECT_EQ(num_doubts(s), distance < 2 ? 0U : 1U) << "joint " << distance;
  }
}

TEST(UnitDoubts, AreOfAPointFarFromItsBody) {
  for (const double apart : {1.9, 2.1}) {
    Scenario s = usual();
    s.muscles[0].path[0].point = {1 + apart, 0, 0};
    s.muscles[0].path[0].beyond_mesh = true;
    EXPECT_EQ(num_doubts(s), apart < 2 ? 0U : 1U) << apart;
  }
}

TEST(UnitDoubts, AreOfAMusclesForceSpeedAndPassiveForce) {
  const auto doubts_of = [](double force, double speed, double passive) {
    Scenario s = usual();
    s.muscles[0].max_force = force;
    s.muscles[0].max_velocity = speed;
    s.muscles[0].passive_fraction = passive;
    return num_doubts(s);
  };
  EXPECT_EQ(doubts_of(0.2, 0.6, 0.9), 0U);
  EXPECT_EQ(doubts_of(3e5, 10, 0.015), 1U);
  EXPECT_EQ(doubts_of(300, 10.0 / 60, 0.015), 1U);
  EXPECT_EQ(doubts_of(300, 1e4, 0.015), 1U);
  EXPECT_EQ(doubts_of(300, 10, 1.5), 1U);
}

TEST(UnitDoubts, AreOfCurvesThatBeginWhenTheRunIsOver) {
  for (const double begin : {0.5, 2.0}) {
    Scenario s = usual();
    s.duration = 1;
    s.muscles[0].excitation = {{begin, begin + 1}, {0, 1}};
    EXPECT_EQ(num_doubts(s), begin < 1 ? 0U : 1U) << begin;
    s.loads = {shift("floor", begin + 1, {0, 0, 0.01})};
    std::get<MotionLoad>(s.loads[0]).motion.time.front() = begin;
    EXPECT_EQ(num_doubts(s), begin < 1 ? 0U : 2U) << begin;
  }
}

TEST(UnitDoubts, AreOfExcitationsThatAreOverAtOnce) {
  for (const double end : {5e-4, 5e-3}) {
    Scenario s = usual();
    s.duration = 1;
    s.muscles[0].excitation = {{0, end}, {0, 1}};
    EXPECT_EQ(num_doubts(s), end < 1e-3 ? 1U : 0U) << end;
    s.duration = 2 * end;
    EXPECT_EQ(num_doubts(s), 0U) << end;
    s.duration = 1;
    s.analysis = Scenario::Analysis::Static;
    EXPECT_EQ(num_doubts(s), 0U) << end;
  }
}

TEST(UnitDoubts, AreOfFoodThatIsPutInWhenTheRunIsOver) {
  for (const double from : {0.9, 1.0}) {
    Scenario s = usual();
    s.duration = 1;
    Bolus bolus;
    bolus.name = "carrot";
    bolus.path = {anchor("bone", {1, 0, 0}), anchor("floor", {1, 0, 0.3})};
    bolus.from = from;
    bolus.force = {{0, 1e-3}, {0, 10}};
    bolus.unloading_stiffness = 1e5;
    s.boluses = {bolus};
    EXPECT_EQ(num_doubts(s), from < 1 ? 0U : 1U) << from;
  }
}

TEST(UnitDoubts, AreOfFrictionInPerCent) {
  for (const double friction : {2.0, 2.1, 30.0}) {
    Scenario s = usual();
    ContactPair pair;
    pair.a = "block";
    pair.b = "bone";
    pair.friction = friction;
    s.contact = true;
    s.contacts = {pair};
    EXPECT_EQ(num_doubts(s), friction <= 2 ? 0U : 1U) << friction;
  }
}

TEST(UnitDoubts, AreOfSheetsOfOtherUnits) {
  const auto doubts_of = [](double thickness, double modulus, double toe) {
    Scenario s = usual();
    Sheet sheet;
    sheet.name = "fascia";
    sheet.at.tissue = "block";
    sheet.thickness = thickness;
    sheet.young_modulus = modulus;
    sheet.toe_strain = toe;
    sheet.fibres = Fibres{Vec3(1, 1, 1).normalized()};
    s.sheets = {sheet};
    return num_doubts(s);
  };
  EXPECT_EQ(doubts_of(0.5e-3, 3e8, 0.03), 0U);
  EXPECT_EQ(doubts_of(1e-6, 1e4, 0.5), 0U);
  EXPECT_EQ(doubts_of(0.5, 3e8, 0.03), 1U);      // m for mm
  EXPECT_EQ(doubts_of(0.5e-3, 300, 0.03), 1U);   // Pa for MPa
  EXPECT_EQ(doubts_of(0.5e-3, 3e11, 0.03), 1U);  // GPa for MPa
  EXPECT_EQ(doubts_of(0.5e-3, 3e8, 3), 1U);      // in per cent
  EXPECT_EQ(doubts_of(1e-8, 3e8, 0.03), 1U);
}

// A linear ligament has no toe, and none in the scenario.
TEST(UnitDoubts, AreOfAToeStrainInPerCent) {
  for (const double strain : {0.03, 0.5, 3.0}) {
    Scenario s = usual();
    Ligament ligament = of_length(0.3);
    ligament.law = Ligament::Law::Blankevoort;
    ligament.stiffness = 100;
    ligament.toe_strain = strain;
    s.ligaments = {ligament};
    EXPECT_EQ(num_doubts(s), strain <= 0.5 ? 0U : 1U) << strain;
    s.ligaments[0].law = Ligament::Law::Linear;
    EXPECT_EQ(num_doubts(s), 0U) << strain;
  }
}

// Cartilage of the scene: 10 kPa and 0.3 give λ + 2μ = 13.5 kPa.
TEST(UnitDoubts, AreOfAPressureOrTractionBeyondTheModulus) {
  for (const double factor : {0.9, 1.1}) {
    Scenario s = usual();
    s.bodies[0].material = linear(10e3, 0.3);
    const double modulus = 10e3 * 0.7 / (1.3 * 0.4);
    SurfaceLoad load;
    load.at.tissue = "block";
    load.at.region.box = {{-1, -1, 0.0099}, {1, 1, 0.0101}};
    load.profile = {{0, 1}, {0, 2}};
    load.stress = factor * modulus / 2;
    s.loads = {load};
    EXPECT_EQ(num_doubts(s), factor < 1 ? 0U : 1U);
    load.stress = Vec3(0, -factor * modulus / 2, 0);
    s.loads = {load};
    EXPECT_EQ(num_doubts(s), factor < 1 ? 0U : 1U);
  }
}

TEST(UnitDoubts, AreOfAMotionThatTurnsMoreThanOnce) {
  for (const double turn : {6.28, 30.0}) {
    Scenario s = usual();
    MotionLoad load = shift("floor", 1, {0, 0, 0.01});
    load.motion.rotation = {Vec3::Zero(), Vec3(0, turn, 0)};
    s.loads = {load};
    EXPECT_EQ(num_doubts(s), turn < 7 ? 0U : 1U) << turn;
  }
}

TEST(UnitDoubts, AFloorMayBeAsLargeAsItLikes) {
  Scenario s = usual();
  s.bodies.push_back(box_body("plate", Body::Kind::Fixed, {50, 50, 1}, {0, 0, -2}));
  EXPECT_EQ(num_doubts(s), 0U);
}

TEST(UnitDoubts, AreOfAFixedBodyFromAFileThatIsMetresWide) {
  for (const double size : {0.9, 1.1}) {
    const TemporaryFolder folder;
    Scenario s = usual();
    s.contact = false;
    s.bodies.push_back(mesh_body("wall", Body::Kind::Fixed,
                                 box_mesh({Vec3(size, 0.1, 0.1), {1, 1, 1}, Vec3::Zero()}),
                                 folder));
    EXPECT_EQ(num_doubts(s), size < 1 ? 0U : 1U) << size;
  }
}

}  // namespace articular::sim::unit_doubts_test
