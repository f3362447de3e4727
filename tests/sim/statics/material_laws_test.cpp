// Material laws from the words of a scenario file to the force of an equilibrium. All nodes of a
// block lie on one of two plates, of which one may move along z: F = diag(1, 1, s), confined
// compression, and the force is the first Piola stress times the area at rest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fem/material/force_length.hpp"
#include "fem/material/material.hpp"
#include "sim/base/error.hpp"
#include "tests/sim/support/contact_scene.hpp"
#include "tests/sim/support/probes.hpp"
#include "tests/sim/support/scene.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::material_laws_test {

constexpr double kSide = 0.01, kArea = kSide * kSide;  // [m], [m²]

const std::string kBlock = R"(
duration = "1 s"
analysis = "static"
contact = false
[[body]]
name = "floor"
kind = "fixed"
[[body]]
name = "block"
kind = "tissue"
geometry = { box = { size = "10 10 10 mm", cells = [2, 2, 1], center = "0 0 5 mm" } }
density = "1 g/cm^3"
material = { @LAW }
[[attach]]
body = "block"
to = "floor"
region = { box = ["-6 -6 -0.1 mm", "6 6 0.1 mm"] }
[[attach]]
body = "block"
to = "plate"
region = { box = ["-6 -6 9.9 mm", "6 6 10.1 mm"] }
)";

const std::string kPressedPlate = R"(
[[body]]
name = "plate"
kind = "rigid"
geometry = { box = { size = "10 10 2 mm", cells = [2, 2, 1], center = "0 0 11 mm" } }
density = "1 g/cm^3"
hold = { freedoms = ["translation.x", "translation.y", "rotation.x", "rotation.y", "rotation.z"] }
[[load]]
kind = "force"
body = "plate"
point = "0 0 11 mm"
force = "0 0 @FORCE N"
profile = { time = ["0 s", "1 s"], value = [0, 1] }
)";

std::string with(std::string text, const std::string& mark, const std::string& words) {
  return text.replace(text.find(mark), mark.size(), words);
}

Scenario pressed(const std::string& law, double force) {
  const TemporaryFolder folder;
  const std::string text = kBlock + with(kPressedPlate, "@FORCE", fmt::format("{:.17g}", force));
  return read_scenario(folder.file("block.toml", with(text, "@LAW", law)));
}

/// Of the block, by where the plate is.
double stretch_of(const Simulation& run) {
  const RigidBody& plate = run.model.rigid_bodies.front();
  return 1 + (run.now().poses.front().p.z() - plate.rest.p.z()) / kSide;
}

/// The stretch of the block under a force [N].
double stretch_under(const std::string& law, double force) {
  Simulation run(pressed(law, force));
  run.advance(1);
  return stretch_of(run);
}

/// That the stretch s takes the stress [Pa], whatever the element.
void expect_stretch(const std::string& law, double s, double stress) {
  for (const char* element : {"plain", "smoothed"})
    EXPECT_NEAR(stretch_under(fmt::format("{}, element = \"{}\"", law, element), stress * kArea), s,
                1e-5)
        << law << element;
}

const double kE = 2e4, kNu = 0.3;
const std::string kElastic = ", young_modulus = \"20 kPa\", poisson_ratio = 0.3";

// Presses to stretches of 0.7 and draws to 1.2.
TEST(MaterialLaws, FromTheWordsOfAFileToTheForceOfConfinedCompression) {
  const fem::Lame lame = fem::lame_parameters(kE, kNu);
  const double mu = lame.mu, lambda = lame.lambda, H = lambda + 2 * mu, kappa = 5e4;
  for (const double s : {0.7, 1.2}) {
    expect_stretch("law = \"st-venant-kirchhoff\"" + kElastic, s, H / 2 * s * (s * s - 1));
    expect_stretch("law = \"coupled-neo-hookean\"" + kElastic, s,
                   mu * (s - 1 / s) + lambda * std::log(s) / s);
    const double beta = 0.8;
    expect_stretch("law = \"holmes-mow\", beta = 0.8" + kElastic, s,
                   H / 2 * (s - 1 / s) * std::pow(s, -2 * beta) * std::exp(beta * (s * s - 1)));
    const auto term = [s](double c, double m) {
      return 2.0 / 3 * c / m * (std::pow(s, 2 * m / 3) - std::pow(s, -m / 3)) / s;
    };
    const std::string ogden =
        "law = \"ogden\", terms = [{ c = \"8 kPa\", m = 2.5 }, { c = \"2 kPa\", m = -3 }], "
        "bulk_modulus = \"50 kPa\"";
    const double distortion = term(8e3, 2.5) + term(2e3, -3);
    expect_stretch(ogden, s, distortion + kappa * (s - 1));
    expect_stretch(ogden + ", volumetric = \"logarithmic\"", s,
                   distortion + kappa * std::log(s) / s);
  }
}

// The plate is driven to the stretch s while the fibres along z are activated to 0.8. What it
// feels is the sum of ground and passive fibre, with the isochoric stretch λ̄ = s^(2/3), of active
// fibre, with s, and of volume.
TEST(MaterialLaws, ActiveStressFollowsTheLengthOfTheSarcomeres) {
  const std::string driven = R"(
[[body]]
name = "plate"
kind = "fixed"
[[muscle]]
name = "fibres"
tissue = "block"
excitation = { time = ["0 s", "1 s"], value = [0, 0.8] }
[[load]]
kind = "motion"
body = "plate"
time = ["0 s", "1 s"]
translation = ["0 0 0 mm", "0 0 @WAY mm"]
)";
  const std::string law =
      "law = \"transversely-isotropic\", c10 = \"2 kPa\", c3 = \"1 kPa\", c4 = 10, c5 = \"100 "
      "kPa\", toe_end = 1.3, active_stress = \"135.7 kPa\", bulk_modulus = \"50 kPa\", fibres = { "
      "direction = [0, 0, 1] }, force_length = { @CURVE }";
  const auto force = [&](double s, const std::string& curve) {
    const TemporaryFolder folder;
    const std::string text =
        kBlock + with(driven, "@WAY", fmt::format("{:.17g}", 1e3 * kSide * (s - 1)));
    Simulation run(
        read_scenario(folder.file("block.toml", with(text, "@LAW", with(law, "@CURVE", curve)))));
    run.advance(1);
    return -run.force_on(1).z();
  };
  const auto expected = [](double s, const fem::ForceLength& curve) {
    const double stretch = std::pow(s, 2.0 / 3);
    const double ground = 4e3 * (stretch * stretch - 1 / stretch);
    const double passive = stretch > 1 ? 1e3 * std::expm1(10 * (stretch - 1)) : 0;
    const double active = 0.8 * 135.7e3 * curve.factor(s);
    return ((ground + passive) * 2 / 3 / s + active / s + 5e4 * (s - 1)) * kArea;
  };
  const fem::ForceLength published({});
  const fem::ForceLength other({.sarcomere_length = 2.1e-6,
                                .zero_length = 1.6e-6,
                                .b = 4e6,
                                .calcium = 2,
                                .max_calcium = 4});
  for (const double s : {0.9, 1.0, 1.15}) {
    EXPECT_NEAR(force(s, ""), expected(s, published), 1e-9 * 135.7e3 * kArea) << s;
    EXPECT_NEAR(force(s,
                      "sarcomere_length = \"2.1 um\", zero_length = \"1.6 um\", b = \"4 1/um\", "
                      "calcium = 2, max_calcium = 4"),
                expected(s, other), 1e-9 * 135.7e3 * kArea)
        << s;
  }
}

/// A bar along z whose fibres are drawn out by `prestretch`. Planes hold it, of which the last, at
/// its end, may be left out.
Simulation prestretched_bar(double prestretch, bool held, const char* element) {
  const std::string text = R"(
duration = "1 s"
analysis = "static"
contact = false
[[body]]
name = "bar"
kind = "tissue"
geometry = { box = { size = "4 4 20 mm", cells = [2, 2, 5], center = "2 2 10 mm" } }
density = "1 g/cm^3"
material = { law = "transversely-isotropic", c10 = "1.44 MPa", c3 = "0.57 MPa", c4 = 48, c5 = "467.1 MPa", toe_end = 1.063, bulk_modulus = "100 GPa", prestretch = @PRESTRETCH, fibres = { direction = [0, 0, 1] }, element = "@ELEMENT" }
[[support]]
body = "bar"
region = { box = ["-0.1 -0.1 -0.1 mm", "0.1 4.1 20.1 mm"] }
freedoms = ["translation.x"]
[[support]]
body = "bar"
region = { box = ["-0.1 -0.1 -0.1 mm", "4.1 0.1 20.1 mm"] }
freedoms = ["translation.y"]
[[support]]
body = "bar"
region = { box = ["-0.1 -0.1 -0.1 mm", "4.1 4.1 0.1 mm"] }
freedoms = ["translation.z"]
)";
  const std::string end = R"(
[[probe]]
name = "fibres"
kind = "fibres"
body = "bar"
[[support]]
name = "end"
body = "bar"
region = { box = ["-0.1 -0.1 19.9 mm", "4.1 4.1 20.1 mm"] }
freedoms = ["translation.z"]
[[probe]]
name = "end"
kind = "reaction"
support = "end"
)";
  const TemporaryFolder folder;
  return Simulation(read_scenario(folder.file(
      "bar.toml",
      with(with(held ? text + end : text, "@PRESTRETCH", fmt::format("{:.17g}", prestretch)),
           "@ELEMENT", element))));
}

// Held at its ends the bar stays as it is, and pulls by the stress of free tissue at that stretch:
// σ = 2 c10 (s² − 1/s) + c3 (exp(c4 (s − 1)) − 1). It is incompressible to σ/κ < 1e-4,
// which takes at most 1e-5 from λ̄ and so, at a slope of 300 MPa, 5e-4 from the stress.
TEST(MaterialLaws, APrestretchedBarPullsAtItsEndsByTheClosedForm) {
  for (const char* element : {"plain", "smoothed"})
    for (const double s : {1.02, 1.05}) {
      Simulation run = prestretched_bar(s, true, element);
      run.advance(1);
      const double stress = 2 * 1.44e6 * (s * s - 1 / s) + 0.57e6 * std::expm1(48 * (s - 1));
      EXPECT_NEAR(Probes(run).vec3("end.force", "N").z(), -stress * 16e-6, 5e-4 * stress * 16e-6)
          << element << s;
      for (const char* column : {"fibres.stretch [-]", "fibres.largest_stretch [-]"})
        EXPECT_NEAR(Probes(run)(column), s, 1e-4);
    }
}

// With a free end it gets 1/s times as long and √s times as wide, without stress.
TEST(MaterialLaws, APrestretchedBarThatIsCutFreeShortensToItsFreeLength) {
  for (const char* element : {"plain", "smoothed"})
    for (const double s : {0.97, 1.05}) {
      Simulation run = prestretched_bar(s, false, element);
      run.advance(1);
      const Positions& X = run.model.tissues[0].X;
      const Positions free = Vec3(std::sqrt(s), std::sqrt(s), 1 / s).asDiagonal() * X;
      EXPECT_LT((nodes_of(run, 0) - free).norm(), 1e-6 * X.norm()) << element << s;
    }
}

// The most that the law bears confined is H s (1 − s²)/2 at s = 1/√3: beyond it there is no
// equilibrium, and none that is inside out is given for one.
TEST(MaterialLaws, StVenantKirchhoffSaysThatItCarriesNoMore) {
  const fem::Lame lame = fem::lame_parameters(kE, kNu);
  const double most = (lame.lambda + 2 * lame.mu) / std::sqrt(27.0) * kArea;
  const std::string law = "law = \"st-venant-kirchhoff\"" + kElastic;
  EXPECT_NEAR(stretch_under(law, -0.99 * most), 0.6239, 1e-3);
  for (const char* element : {"plain", "smoothed"}) {
    Simulation run(pressed(fmt::format("{}, element = \"{}\"", law, element), -1.01 * most));
    try {
      run.advance(1);
      ADD_FAILURE() << "a force that the law can't bear is balanced";
    } catch (const SimulationError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("tissue `block`"), std::string::npos) << what;
      EXPECT_NE(what.find("st-venant-kirchhoff"), std::string::npos) << what;
    }
    EXPECT_GT(stretch_of(run), 1 / std::sqrt(3.0));
  }
}

// A block of free sides, pressed to half in one load step, ends where ten steps do. Pushed through
// the floor, here without free nodes, it is inside out, and ends with an error.
TEST(MaterialLaws, OneLargeLoadStepIsCutOrEndsWithAnError) {
  const auto energy = [](const std::string& law, double step, double way, const char* cells) {
    const TemporaryFolder folder;
    const std::string plate = R"(
[[body]]
name = "plate"
kind = "fixed"
[[load]]
kind = "motion"
body = "plate"
time = ["0 s", "1 s"]
translation = ["0 0 0 mm", "0 0 @WAY mm"]
)";
    std::string text = with(kBlock + plate, "@LAW", law);
    text = with(with(text, "@WAY", fmt::format("{:.17g}", 1e3 * way)), "[2, 2, 1]", cells);
    Scenario s = read_scenario(folder.file("block.toml", text));
    s.integrator.step = step;
    Simulation run(s);
    run.advance(1);
    EXPECT_TRUE(run.state.y.allFinite());
    return run.stepper.stored_energy().elastic;
  };
  for (const std::string& law :
       {"law = \"coupled-neo-hookean\"" + kElastic, "law = \"holmes-mow\", beta = 0.8" + kElastic,
        std::string("law = \"ogden\", terms = [{ c = \"8 kPa\", m = 2.5 }], bulk_modulus = \"50 "
                    "kPa\"")}) {
    for (const char* element : {"plain", "smoothed"}) {
      const std::string words = fmt::format("{}, element = \"{}\"", law, element);
      const double expected = energy(words, 0.1, -0.5 * kSide, "[2, 2, 4]");
      EXPECT_GT(expected, 0);
      EXPECT_NEAR(energy(words, 1, -0.5 * kSide, "[2, 2, 4]"), expected, 1e-4 * expected) << words;
      EXPECT_THROW(energy(words, 1, -1.1 * kSide, "[2, 2, 1]"), SimulationError) << words;
    }
  }
}

}  // namespace articular::sim::material_laws_test
