// Sheets of fibres in whole scenes.
#include "sim/build/make_sheets.hpp"

#include <gtest/gtest.h>

#include "sim/assembly/energies.hpp"
#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/shapes.hpp"
#include "sim/output/fingerprint.hpp"
#include "tests/sim/support/probes.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::make_sheets_test {

constexpr double kStiffness = 10e6, kThickness = 0.2e-3;  // [Pa], [m]

/// A soft bar along x, 20 x 4 x 4 mm, whose end at x = -10 mm is held.
std::string bar(const std::string& geometry, const std::string& settings) {
  return settings + R"(
contact = false
[[body]]
name = "bar"
kind = "tissue"
density = "1 g/cm^3"
material = { law = "neo-hookean", young_modulus = "1 kPa", poisson_ratio = 0 }
)" + geometry +
         R"(
[[body]]
name = "wall"
kind = "fixed"
[[body]]
name = "grip"
kind = "fixed"
[[attach]]
body = "bar"
to = "wall"
region = { box = ["-11 -3 -3 mm", "-9.99 3 3 mm"] }
)";
}

const std::string kBox = R"(geometry = { box = { size = "20 4 4 mm", cells = [8, 2, 2] } })";
const std::string kStatic =
    "duration = \"1 s\"\nanalysis = \"static\"\nintegrator = { step = \"0.5 s\" }";

std::string sheet(const std::string& name, const std::string& region, const std::string& fibres,
                  const std::string& more = "") {
  return "[[sheet]]\nname = \"" + name + "\"\nbody = \"bar\"\nregion = " + region +
         "\nthickness = \"0.2 mm\"\nyoung_modulus = \"10 MPa\"\nfibres = { " + fibres + " }\n" +
         more + "\n";
}

const std::string kAlong = "direction = [1, 0, 0]";
const std::string kFront = R"({ box = ["-11 1.99 -3 mm", "11 2.01 3 mm"] })",
                  kBack = R"({ box = ["-11 -2.01 -3 mm", "11 -1.99 3 mm"] })";

Model model_of(const std::string& text) {
  const TemporaryFolder folder;
  return build_model(read_scenario(folder.file("bar.toml", text)));
}

std::string refusal_of(const std::string& text) {
  try {
    (void)model_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// By 5 % into the toe of 0.03: E e²/(4 e_l) by width and thickness. The bar itself has less than
// 1 mN of 0.33 N.
TEST(Sheets, PullWithTheirWidthTimesTheirThickness) {
  const std::string text =
      bar(kBox, kStatic) + sheet("front", kFront, kAlong) + sheet("back", kBack, kAlong) + R"(
[[attach]]
body = "bar"
to = "grip"
region = { box = ["9.99 -3 -3 mm", "11 3 3 mm"] }
[[load]]
kind = "motion"
body = "grip"
time = ["0 s", "1 s"]
translation = ["0 0 0 mm", "1 0 0 mm"]
[[probe]]
name = "grip"
kind = "attachment"
bodies = ["bar", "grip"]
[[probe]]
name = "front"
kind = "sheet"
sheet = "front"
)";
  const TemporaryFolder folder;
  Simulation run(read_scenario(folder.file("bar.toml", text)));
  run.advance(1);
  const Probes probes(run);
  const double stress = kStiffness * 0.05 * 0.05 / (4 * 0.03);  // [Pa]
  EXPECT_NEAR(probes("grip.force.x [N]"), -2 * 4e-3 * kThickness * stress, 1e-3);
  EXPECT_NEAR(probes("front.stretch [-]"), 1.05, 1e-6);
  EXPECT_NEAR(probes("front.largest_stretch [-]"), 1.05, 1e-6);
  EXPECT_NEAR(probes("front.largest_tension [N/m]"), kThickness * stress, 1e-3);
}

// A bar that flies off is caught by its sheets: they hold what it had, and nothing is lost.
TEST(Sheets, HoldTheEnergyThatStretchesThem) {
  const std::string text =
      bar(kBox + "\nvelocity = \"1 0 0 m/s\"",
          "duration = \"0.6 ms\"\nintegrator = { scheme = \"dirk-3\", step = \"5 us\" }") +
      sheet("front", kFront, kAlong) + sheet("back", kBack, kAlong) +
      "[[probe]]\nname = \"energy\"\nkind = \"energy\"\n";
  const TemporaryFolder folder;
  Simulation run(read_scenario(folder.file("bar.toml", text)));
  const double given = kinetic_energy(run.stepper.now());
  run.advance(0.6e-3);
  const Probes probes(run);
  EXPECT_GT(probes("energy.elastic [J]"), 0.25 * given);
  EXPECT_LT(std::abs(probes("energy.numerical_loss [J]")), 2e-3 * given);
  EXPECT_EQ(run.stepper.evaluations()[Term::Sheet] % 2, 0);
  EXPECT_GT(run.stepper.evaluations()[Term::Sheet], 2 * 120);
}

// Under x → x + γ y a fibre along (1, 1) is drawn out to √(1 + γ + γ²/2), its image shortened.
TEST(Sheets, OfTheOtherSideAreMirrorImages) {
  const Model model =
      model_of(bar(kBox, kStatic) + sheet("top", R"({ box = ["0.1 -3 1.99 mm", "11 3 2.01 mm"] })",
                                          "direction = [1, 1, 0]", "mirror = \"x\""));
  const std::vector<SheetModel>& sheets = model.tissues[0].sheets;
  ASSERT_EQ(sheets.size(), 2U);
  EXPECT_EQ(sheets[0].name, "top_left");
  EXPECT_EQ(sheets[1].name, "top_right");
  EXPECT_NEAR(sheets[0].fibres.area().sum(), 40e-6, 1e-12);
  EXPECT_NEAR(sheets[1].fibres.area().sum(), 40e-6, 1e-12);
  Positions x = model.tissues[0].X;
  x.row(0) += 0.1 * x.row(1).eval();
  EXPECT_NEAR(sheets[0].fibres.stretch(x).minCoeff(), std::sqrt(1 + 0.1 + 0.005), 1e-12);
  EXPECT_NEAR(sheets[1].fibres.stretch(x).maxCoeff(), std::sqrt(1 - 0.1 + 0.005), 1e-12);
}

/// The bar as a file whose nodes at y = 2 mm are a set, and whose cells have fibres.
std::string bar_of_file(const TemporaryFolder& folder, double front_is_at = 2e-3,
                        const Vec3& fibre = Vec3(1, 3, 2)) {
  MeshData mesh = box_mesh({Vec3(0.02, 0.004, 0.004), {8, 2, 2}, Vec3::Zero()});
  MeshSet front;
  front.name = "front";
  for (int i = 0; i < mesh.X.cols(); ++i)
    if (std::abs(mesh.X(1, i) - front_is_at) < 1e-6) front.nodes.push_back(i);
  mesh.sets = {front};
  mesh.cell_vectors = {{"fibres", fibre.replicate(1, mesh.tets.cols())}};
  write_mesh(folder / "bar.vtu", mesh, 1e-3);
  return bar(R"(mesh = { file = "bar.vtu", unit = "mm" })", kStatic);
}

// A set of nodes of a .vtu means the faces of which all corners are in it; an array its vectors
// within the surface.
TEST(Sheets, LieOnASetOfNodesAlongAnArray) {
  const TemporaryFolder folder;
  const std::string text =
      bar_of_file(folder) + sheet("front", R"({ set = "front" })", "array = \"fibres\"");
  const Model model = build_model(read_scenario(folder.file("bar.toml", text)));
  const fem::FibreSheet& front = model.tissues[0].sheets[0].fibres;
  EXPECT_NEAR(front.area().sum(), 80e-6, 1e-12);
  const Positions x = Vec3(1.5, 1, 1).asDiagonal() * model.tissues[0].X;
  EXPECT_NEAR(front.stretch(x).maxCoeff(), std::hypot(1.5, 2) / std::hypot(1, 2), 1e-9);
}

// A run that is resumed has to have the sheets that it had.
TEST(Sheets, OfAnotherFileAreAnotherRun) {
  const TemporaryFolder folder;
  const auto of = [&](double front_is_at, const Vec3& fibre) {
    const std::string text = bar_of_file(folder, front_is_at, fibre) +
                             sheet("front", R"({ set = "front" })", "array = \"fibres\"");
    const Scenario scenario = read_scenario(folder.file("bar.toml", text));
    return fingerprint(scenario, build_model(scenario));
  };
  const std::string first = of(2e-3, {1, 3, 2});
  EXPECT_EQ(of(2e-3, {1, 3, 2}), first);
  EXPECT_NE(of(-2e-3, {1, 3, 2}), first);
  EXPECT_NE(of(2e-3, {1, 3, -2}), first);
}

// One that reaches across x = 0 would pull twice.
TEST(Sheets, ThatAreTheirOwnImageAreRefused) {
  const auto with = [](const std::string& region) {
    return refusal_of(bar(kBox, kStatic) + sheet("front", region, kAlong, "mirror = \"x\""));
  };
  EXPECT_EQ(with(R"({ box = ["0.1 1.99 -3 mm", "11 2.01 3 mm"] })"), "");
  const std::string across = with(R"({ box = ["-3 1.99 -3 mm", "11 2.01 3 mm"] })");
  EXPECT_NE(across.find("`front_right`: it has faces in common with its image `front_left`"),
            std::string::npos)
      << across;
}

TEST(Sheets, WhereTheyCannotLieIsRefused) {
  const auto with = [](const std::string& region, const std::string& fibres) {
    return refusal_of(bar(kBox, kStatic) + sheet("front", region, fibres));
  };
  EXPECT_NE(with(R"({ box = ["5 5 5 mm", "6 6 6 mm"] })", kAlong)
                .find("no face of the surface of tissue `bar` has its middle in the region"),
            std::string::npos);
  EXPECT_NE(
      with(kFront, "direction = [0, 1, 0]").find("is crossed by the fibres; expected `fibres`"),
      std::string::npos);
  EXPECT_NE(with(kFront, "array = \"a\"").find("its shape is made here"), std::string::npos)
      << with(kFront, "array = \"a\"");
}

}  // namespace articular::sim::make_sheets_test
