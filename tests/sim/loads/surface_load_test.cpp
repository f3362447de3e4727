// Pressure and traction on surfaces: forces, tangent, work, closed forms.
#include "sim/loads/surface_load.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/sim/support/scenario_file.hpp"
#include "tests/sim/support/scene.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::surface_load_test {

constexpr double kPressure = 700;  // [Pa]

SurfaceLoad on_surface(const Vec3& low, const Vec3& high,
                       const std::variant<double, Vec3>& stress) {
  SurfaceLoad load;
  load.at.tissue = "block";
  load.at.region.box = {low, high};
  load.stress = stress;
  return load;
}

SurfaceLoad all_round(double pressure) {
  return on_surface(Vec3::Constant(-1), Vec3::Ones(), pressure);
}

Scenario block_under(const SurfaceLoad& load) {
  Scenario s = scene(1e-3, Integrator::Scheme::TrBdf2);
  s.bodies = {
      box_body("block", Body::Kind::Tissue, {0.02, 0.01, 0.01}, {0.3, -0.2, 0.1}, {3, 2, 2})};
  s.loads = {load};
  return s;
}

/// Nodes moved at random by up to a part of the block.
Configuration moved(const Model& model, double part, unsigned seed) {
  Configuration now;
  read_state(model, initial_state(model).data(), 0, now);
  Random random(seed);
  for (auto x : now.x.colwise()) x += part * 0.01 * random.vec3();
  return now;
}

Eigen::VectorXd forces(const Model& model, const Configuration& now) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * model.num_blocks);
  add_surface_force(model.surface_loads[0], now, f);
  return f;
}

// ∮ n dA = 0 and ∮ x × n dA = 0 for any closed surface of triangles, however it is folded.
TEST(SurfaceLoad, PressureOnAClosedSurfaceHasNeitherForceNorMoment) {
  const Model model = build_model(block_under(all_round(kPressure)));
  const Configuration now = moved(model, 0.3, 1);
  const Eigen::VectorXd f = forces(model, now);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double scale = 0;
  for (int b = 0; b < model.layout.num_free_nodes; ++b) {
    force += f.segment<3>(3 * b);
    moment += now.x.col(b).cross(f.segment<3>(3 * b));
    scale += f.segment<3>(3 * b).norm();
  }
  EXPECT_GT(scale, 0.1);
  EXPECT_LT(force.norm(), 1e-14 * scale);
  EXPECT_LT(moment.norm(), 1e-14 * scale);
}

// On a face of the block: −p A n and t A, at its middle.
TEST(SurfaceLoad, PushesInwardsByPressureAndAlongATraction) {
  const Vec3 top_low(-1, -1, 0.105 - 1e-6);
  for (const bool pressure : {true, false}) {
    const std::variant<double, Vec3> stress =
        pressure ? std::variant<double, Vec3>(kPressure) : Vec3(10, -20, 30);
    const Model model = build_model(block_under(on_surface(top_low, Vec3::Ones(), stress)));
    EXPECT_EQ(model.surface_loads[0].faces.size(), 12u);
    Configuration now;
    read_state(model, initial_state(model).data(), 0, now);
    const Eigen::VectorXd f = forces(model, now);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (int b = 0; b < model.layout.num_free_nodes; ++b) {
      force += f.segment<3>(3 * b);
      moment += (now.x.col(b) - Vec3(0.3, -0.2, 0.105)).cross(f.segment<3>(3 * b));
    }
    const Vec3 expected = 2e-4 * (pressure ? Vec3(0, 0, -kPressure) : Vec3(10, -20, 30));
    EXPECT_LT((force - expected).norm(), 1e-13 * expected.norm());
    EXPECT_LT(moment.norm(), 1e-13 * expected.norm());
  }
}

/// The matrix that Newton's iteration gets, dense, and −∂f/∂x by central differences.
std::pair<Eigen::MatrixXd, Eigen::MatrixXd> tangents(const Model& model, const Configuration& at) {
  const int n = model.layout.num_free_nodes;
  std::vector<int> all(static_cast<std::size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> offsets{0, n};
  fem::BlockMatrix A(n, all, offsets);
  add_surface_stiffness(model, model.surface_loads[0], at, 1, A);
  Eigen::MatrixXd K(3 * n, 3 * n), J(3 * n, 3 * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) K.block<3, 3>(3 * i, 3 * j) = A.block(A.slot(i, j));
  constexpr double h = 1e-4;  // f is quadratic: any step is exact but for round-off
  for (int k = 0; k < 3 * n; ++k) {
    Configuration less = at, more = at;
    less.x(k % 3, k / 3) -= h;
    more.x(k % 3, k / 3) += h;
    J.col(k) = (forces(model, less) - forces(model, more)).head(3 * n) / (2 * h);
  }
  return {K, J};
}

TEST(SurfaceLoad, TangentOfAClosedSurfaceIsTheDerivativeOfTheForce) {
  const Model model = build_model(block_under(all_round(kPressure)));
  const auto [K, J] = tangents(model, moved(model, 0.3, 2));
  EXPECT_GT(J.norm(), 1);
  EXPECT_LT((K - J).norm(), 1e-10 * J.norm());
}

// The rim is where the derivative is not symmetric.
TEST(SurfaceLoad, TangentOfAnOpenSurfaceIsTheSymmetricPartOfTheDerivative) {
  const Model model =
      build_model(block_under(on_surface({-1, -1, 0.105 - 1e-6}, Vec3::Ones(), kPressure)));
  const auto [K, J] = tangents(model, moved(model, 0.3, 3));
  EXPECT_LT((K - 0.5 * (J + J.transpose())).norm(), 1e-10 * J.norm());
  EXPECT_GT((J - J.transpose()).norm(), 0.1 * J.norm());
}

double volume(const Simulation& run) {
  Positions x;
  positions_of(run.now(), run.model.tissues[0].nodes, x);
  double sum = 0;
  for (const auto& tet : run.model.tissues[0].elements.tets().colwise()) {
    Mat3 edges;
    for (int a = 0; a < 3; ++a) edges.col(a) = x.col(tet[a + 1]) - x.col(tet[0]);
    sum += edges.determinant() / 6;
  }
  return sum;
}

// At a constant pressure the work is p times the volume that is gone, at any moment of a swing.
TEST(SurfaceLoad, WorkOfAPressureIsThatTimesTheVolume) {
  Simulation run(block_under(all_round(kPressure)));
  const double start = volume(run);
  double largest = 0;
  run.advance(0.02, [&] {
    const double work = kPressure * (start - volume(run));
    EXPECT_NEAR(run.state.energy.load_work, work, 1e-11 * kPressure * start);
    largest = std::max(largest, work);
  });
  EXPECT_GT(largest, 1e-3 * kPressure * start);
}

// Work of a pressure that rises slowly is what is stored: both are ∫ p dV.
TEST(SurfaceLoad, WorkOfARisingPressureIsStored) {
  const auto loss = [](double step) {
    SurfaceLoad load = all_round(3000);
    load.profile = {{0, 1}, {0, 1}};
    Scenario s = block_under(load);
    s.analysis = Scenario::Analysis::Static;
    s.integrator.step = step;
    s.bodies.push_back(stand("wall"));
    s.attachments = {attach("block", "wall", {-1, -1, -1}, {0.29 + 1e-6, 1, 1})};
    Simulation run(s);
    run.advance(1);
    EXPECT_GT(run.state.energy.load_work, 1e-5);
    return std::abs(run.loss()) / run.state.energy.load_work;
  };
  EXPECT_LT(loss(0.125), 5e-3);
  EXPECT_NEAR(std::log2(loss(0.25) / loss(0.125)), 2, 0.3);  // the way is taken for straight
}

// The rim of the loaded face is free: the tangent is not the whole derivative, and Newton's
// iteration gets there all the same. The wall carries −∮ p n dA of the bent surface.
TEST(SurfaceLoad, ABeamBendsUnderAPressureThatFollowsIt) {
  SurfaceLoad load = on_surface({-1, -1, 0.105 - 1e-6}, Vec3::Ones(), 400.0);
  load.profile = {{0, 1}, {0, 1}};
  Scenario s = block_under(load);
  s.analysis = Scenario::Analysis::Static;
  s.integrator.step = 0.5;
  s.bodies.push_back(stand("wall"));
  s.attachments = {attach("block", "wall", {-1, -1, -1}, {0.29 + 1e-6, 1, 1})};
  Simulation run(s);
  run.advance(1);
  const auto rows = run.stepper.take_convergence();
  EXPECT_LT(rows.size(), 20u);
  Vec3 pushed = Vec3::Zero();
  for (const auto& face : run.model.surface_loads[0].faces) {
    const Vec3 x0 = run.now().position(face[0]);
    pushed -=
        400.0 / 2 * (run.now().position(face[1]) - x0).cross(run.now().position(face[2]) - x0);
  }
  EXPECT_GT(std::abs(pushed.x()), 0.05 * pushed.norm());  // it has turned with the beam
  EXPECT_LT((run.force_on(0) - pushed).norm(), 1e-5 * pushed.norm());
}

/// A quarter of a thick-walled tube of inner radius a, outer b, one element long.
MeshData quarter_tube(int cells, double a, double b) {
  BoxGeometry box;
  box.size = {1, 1, 1};
  box.center = {0.5, 0.5, 0.5};
  box.cells = {cells, 2 * cells, 1};
  MeshData mesh = box_mesh(box);
  for (auto x : mesh.X.colwise()) {
    const double r = a + (b - a) * x.x(), angle = std::numbers::pi / 2 * (1 - x.y());
    x = Vec3(x.y() == 1 ? r : r * std::cos(angle), x.y() == 0 ? r : r * std::sin(angle),
             0.2 * (b - a) * x.z());
    if (angle == 0) x.y() = 0;
    if (std::abs(x.x()) < 1e-12) x.x() = 0;
  }
  return mesh;
}

// Lamé: u_r = (1 + ν) p a²/(E (b² − a²)) ((1 − 2ν) r + b²/r) in plane strain, on planes of symmetry
// at both angles and both ends.
TEST(SurfaceLoad, ATubeUnderInnerPressureWidensByLamesSolution) {
  constexpr double kInner = 1, kOuter = 2, kE = 1e4, kNu = 0.3, p = 1e-3;
  const TemporaryFolder folder;
  const auto error = [&](int cells) {
    const MeshData mesh = quarter_tube(cells, kInner, kOuter);
    std::string deck = "*NODE\n";
    for (Eigen::Index i = 0; i < mesh.X.cols(); ++i) {
      char line[128];
      std::snprintf(line, sizeof line, "%d, %.17g, %.17g, %.17g\n", static_cast<int>(i) + 1,
                    mesh.X(0, i), mesh.X(1, i), mesh.X(2, i));
      deck += line;
    }
    deck += "*ELEMENT, TYPE=C3D4\n";
    // The map turns the cells inside out: two corners change places.
    for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) {
      char line[128];
      std::snprintf(line, sizeof line, "%d, %d, %d, %d, %d\n", static_cast<int>(e) + 1,
                    mesh.tets(1, e) + 1, mesh.tets(0, e) + 1, mesh.tets(2, e) + 1,
                    mesh.tets(3, e) + 1);
      deck += line;
    }
    Scenario s = scene(1);
    s.analysis = Scenario::Analysis::Static;
    s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Ones())};
    MeshFile file;
    file.path = folder.file("tube.inp", deck);
    file.unit = 1;
    s.bodies[0].geometry = file;
    s.bodies[0].material = linear(kE, kNu);
    const auto plane = [&](const Vec3& low, const Vec3& high, const Vec3& normal) {
      Support made;
      made.body = "block";
      made.region.box = {low, high};
      made.held = normal;
      s.supports.push_back(made);
    };
    plane(Vec3::Constant(-1e-9), {3, 1e-9, 1}, Vec3::UnitY());
    plane(Vec3::Constant(-1e-9), {1e-9, 3, 1}, Vec3::UnitX());
    plane(Vec3::Constant(-1e-9), {3, 3, 1}, Vec3::UnitZ());
    SurfaceLoad load;
    load.at.tissue = "block";
    // Middles of the inner faces lie within; those at the ends of the tube are farther out.
    load.at.region.sphere = {Vec3(0, 0, 0.1), kInner + 0.02 / cells};
    load.stress = p;
    s.loads = {load};
    Simulation run(s);
    run.advance(1);
    EXPECT_EQ(run.model.surface_loads[0].faces.size(), static_cast<std::size_t>(4 * cells));
    double sum = 0;
    const Tissue& tissue = run.model.tissues[0];
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      const Vec3 X = tissue.X.col(static_cast<Eigen::Index>(i));
      const double r = std::hypot(X.x(), X.y());
      const double u = (1 + kNu) * p * kInner * kInner /
                       (kE * (kOuter * kOuter - kInner * kInner)) *
                       ((1 - 2 * kNu) * r + kOuter * kOuter / r);
      const Vec3 expected = u / r * Vec3(X.x(), X.y(), 0);
      sum += (run.now().position(tissue.nodes[i]) - X - expected).squaredNorm();
    }
    const double largest = (1 + kNu) * p / (3 * kE) * ((1 - 2 * kNu) + 4);
    return std::sqrt(sum / static_cast<double>(tissue.nodes.size())) / largest;
  };
  const double coarse = error(4), fine = error(8);
  EXPECT_LT(fine, 0.01);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.35);
}

TEST(SurfaceLoad, OnNoFaceIsRefused) {
  std::string message;
  try {
    build_model(block_under(on_surface({2, 2, 2}, {3, 3, 3}, kPressure)));
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("no face of the surface of tissue `block` has its middle in the loaded "
                         "region"),
            std::string::npos);
}

using SurfaceLoadFile = ScenarioTest;

TEST_F(SurfaceLoadFile, IsRead) {
  const Scenario s = read(kStart + R"(
[[load]]
kind = "pressure"
body = "disc_left"
region = { surface = true }
pressure = "2 kPa"
profile = { time = ["0 s", "1 s"], value = [0, 1] }
[[load]]
kind = "traction"
body = "disc_left"
region = {}
traction = "0 1 -2 kPa"
)");
  ASSERT_EQ(s.loads.size(), 2u);
  const auto& pressure = std::get<SurfaceLoad>(s.loads[0]);
  EXPECT_EQ(std::get<double>(pressure.stress), 2000);
  EXPECT_EQ(pressure.profile.value, (std::vector<double>{0, 1}));
  EXPECT_EQ(std::get<Vec3>(std::get<SurfaceLoad>(s.loads[1]).stress), Vec3(0, 1000, -2000));
  EXPECT_NE(refusal(kStart + "[[load]]\nkind = \"pressure\"\nbody = \"mandible\"\nregion = "
                             "{}\npressure = \"1 kPa\"\n")
                .find("it acts on the surface of a tissue, and body `mandible` is none"),
            std::string::npos);
}

}  // namespace articular::sim::surface_load_test
