// Nodes of tissue that slide on planes: symmetry, patch tests, motion, reactions, refusals.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numeric>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/mesh/shapes.hpp"
#include "sim/model/held_blocks.hpp"
#include "tests/sim/support/probes.hpp"
#include "tests/sim/support/scenario_file.hpp"
#include "tests/sim/support/scene.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::support_test {

using Element = TissueMaterial::Element;
using Scheme = Integrator::Scheme;
using Solver = Integrator::Solver;

constexpr double kEnd = 1e-7;  // [m] around a plane

/// Holds the nodes of `block` in a box along some axes.
Support support(const std::string& name, const Vec3& low, const Vec3& high,
                const Eigen::Matrix3Xd& held) {
  Support made;
  made.name = name;
  made.body = "block";
  made.region.box = {low, high};
  made.held = held;
  return made;
}

Probe reaction(const std::string& support) { return {support, SupportProbe{support}}; }

Scenario static_scene(Solver solver = Solver::Auto) {
  Scenario s = scene(1);
  s.analysis = Scenario::Analysis::Static;
  s.integrator.solver = solver;
  return s;
}

TissueMaterial material(TissueMaterial made, Element element) {
  made.element = element;
  return made;
}

SurfaceLoad on_surface(const Vec3& low, const Vec3& high,
                       const std::variant<double, Vec3>& stress) {
  SurfaceLoad load;
  load.at.tissue = "block";
  load.at.region.box = {low, high};
  load.stress = stress;
  return load;
}

struct Setting {
  Element element;
  Solver solver;
};
class SupportOfEach : public ::testing::TestWithParam<Setting> {
 protected:
  /// Of a linear problem: round-off, or a hundred times where an iteration stops.
  static double tolerance() { return GetParam().solver == Solver::Cholesky ? 1e-8 : 1e-4; }
};
INSTANTIATE_TEST_SUITE_P(ElementAndSolver, SupportOfEach,
                         ::testing::Values(Setting{Element::Plain, Solver::Cholesky},
                                           Setting{Element::Plain, Solver::ConjugateGradients},
                                           Setting{Element::Plain, Solver::Multigrid},
                                           Setting{Element::Smoothed, Solver::Cholesky},
                                           Setting{Element::Smoothed, Solver::ConjugateGradients},
                                           Setting{Element::Smoothed, Solver::Multigrid}));

// Under the same pressure p from everywhere all shrinks towards a point, u = −p x/(3 κ), and planes
// through that point stay where they are. So three planes of any angles between them hold a block
// without another stress, and each takes the pressure that acts on it: p A. The area has shrunk by
// p/κ = 1e-5 of it.
TEST_P(SupportOfEach, ThreeObliquePlanesHoldABlockUnderPressureByTheClosedForm) {
  constexpr double kE = 1e4, kNu = 0.3, kPressure = 0.1, kSide = 0.01;
  const double kappa = kE / (3 * (1 - 2 * kNu));
  Mat3 edges;  // along which the planes meet
  edges.col(0) = kSide * Vec3(1, 0.1, -0.2);
  edges.col(1) = kSide * Vec3(0.3, 1.1, 0.1);
  edges.col(2) = kSide * Vec3(-0.2, 0.4, 0.9);
  const Vec3 origin(0.03, -0.02, 0.01);
  HexahedronGeometry block;
  block.cells = {3, 2, 2};
  constexpr int kCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int c = 0; c < 8; ++c)
    block.corners.col(c) = origin + edges * Vec3(kCorners[c][0], kCorners[c][1], kCorners[c][2]);
  Scenario s = static_scene(GetParam().solver);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Ones())};
  s.bodies[0].geometry = block;
  s.bodies[0].material = material(linear(kE, kNu), GetParam().element);
  SurfaceLoad everywhere = on_surface(Vec3::Constant(-1), Vec3::Constant(1), kPressure);
  s.loads = {everywhere};
  // A plane is no box: a thin body lies along each. There the load is taken back.
  Mat3 outward;
  for (int k = 0; k < 3; ++k) {
    const Vec3 e1 = edges.col((k + 1) % 3), e2 = edges.col((k + 2) % 3);
    outward.col(k) = -e1.cross(e2).normalized();
    const std::string name(1, static_cast<char>('a' + k));
    Body sheet = box_body("sheet_" + name, Body::Kind::Fixed, Vec3::Ones());
    HexahedronGeometry flat;
    const double h = 1e-3 * kSide;
    for (int c = 0; c < 8; ++c)
      flat.corners.col(c) = origin + (kCorners[c][0] - 0.5) * 3 * e2 +
                            (kCorners[c][1] - 0.5) * 3 * e1 + kCorners[c][2] * h * outward.col(k);
    sheet.geometry = flat;
    sheet.collides = false;
    s.bodies.push_back(sheet);
    Support plane = support(name, {}, {}, outward.col(k));
    plane.region = Region{};
    plane.region.near_body = {"sheet_" + name, 1e-2 * h};
    s.supports.push_back(plane);
    s.probes.push_back(reaction(name));
    SurfaceLoad back = everywhere;
    back.at.region = plane.region;
    back.stress = -kPressure;
    s.loads.push_back(back);
  }
  Simulation run(s);
  run.advance(1);
  const Tissue& tissue = run.model.tissues[0];
  const double scale = kPressure / (3 * kappa) * kSide;
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    const Vec3 X = tissue.X.col(static_cast<Eigen::Index>(i));
    const Vec3 u = run.now().position(tissue.nodes[i]) - X;
    EXPECT_LT((u + kPressure / (3 * kappa) * (X - origin)).norm(), 1e-4 * scale) << i;
  }
  const Probes probes(run);
  for (int k = 0; k < 3; ++k) {
    const double area = edges.col((k + 1) % 3).cross(edges.col((k + 2) % 3)).norm();
    const std::string name(1, static_cast<char>('a' + k));
    EXPECT_LT((probes.vec3(name + ".force", "N") - kPressure * area * outward.col(k)).norm(),
              1e-4 * kPressure * area)
        << k;
  }
}

// σ = t, ε = σ/E along the column and −ν of it across, on any mesh to round-off: the planes let it.
TEST_P(SupportOfEach, AColumnUnderTractionOnThreePlanesHasTheUniaxialState) {
  constexpr double kE = 1e4, kNu = 0.3, kTraction = -300, kSide = 0.01;
  Scenario s = static_scene(GetParam().solver);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3(1, 1, 2) * kSide,
                       Vec3(0.5, 0.5, 1) * kSide, {2, 3, 4})};
  s.bodies[0].material = material(linear(kE, kNu), GetParam().element);
  for (int k = 0; k < 3; ++k) {
    Vec3 high = Vec3::Ones();
    high[k] = kEnd;
    const std::string name(1, static_cast<char>('x' + k));
    s.supports.push_back(support(name, Vec3::Constant(-kEnd), high, Vec3::Unit(k)));
    s.probes.push_back(reaction(name));
  }
  s.loads = {on_surface({-1, -1, 2 * kSide - kEnd}, Vec3::Ones(), Vec3(0, 0, kTraction))};
  Simulation run(s);
  run.advance(1);
  const Tissue& tissue = run.model.tissues[0];
  const Vec3 stretch = Vec3(1 - kNu * kTraction / kE, 1 - kNu * kTraction / kE, 1 + kTraction / kE);
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
    const Vec3 X = tissue.X.col(static_cast<Eigen::Index>(i));
    EXPECT_LT((run.now().position(tissue.nodes[i]) - stretch.cwiseProduct(X)).norm(),
              tolerance() * kSide * -kTraction / kE)
        << i;
  }
  const Probes probes(run);
  const double force = kTraction * kSide * kSide;
  EXPECT_LT((probes.vec3("z.force", "N") - Vec3(0, 0, force)).norm(), tolerance() * -force);
  EXPECT_LT(probes.vec3("x.force", "N").norm(), tolerance() * -force);
  EXPECT_LT(probes.vec3("y.force", "N").norm(), tolerance() * -force);
  // About where the middle of the face was: it has widened away from the planes x = 0 and y = 0.
  const double shift = 0.5 * kSide * (stretch.x() - 1);
  EXPECT_LT((probes.vec3("z.moment", "N m") - force * Vec3(shift, -shift, 0)).norm(),
            tolerance() * -force * kSide);
  EXPECT_FALSE(run.stepper.loose());
}

std::string as_deck(const Positions& X, const Tetrahedra& tets) {
  std::string text = "*NODE\n";
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    char line[128];
    std::snprintf(line, sizeof line, "%d, %.17g, %.17g, %.17g\n", static_cast<int>(i) + 1, X(0, i),
                  X(1, i), X(2, i));
    text += line;
  }
  text += "*ELEMENT, TYPE=C3D4\n";
  for (Eigen::Index e = 0; e < tets.cols(); ++e)
    text += std::to_string(e + 1) + ", " + std::to_string(tets(0, e) + 1) + ", " +
            std::to_string(tets(1, e) + 1) + ", " + std::to_string(tets(2, e) + 1) + ", " +
            std::to_string(tets(3, e) + 1) + "\n";
  return text;
}

/// A mesh with its mirror image across x = 0, and for each node of it the one of the half.
struct Mirrored {
  Positions X;
  Tetrahedra tets;
  std::vector<int> of_half;
  std::vector<double> sign;  // of x
};

Mirrored mirrored(const MeshData& half) {
  const auto n = static_cast<int>(half.X.cols());
  Mirrored whole;
  std::vector<int> image(static_cast<std::size_t>(n));
  whole.of_half.resize(static_cast<std::size_t>(n));
  std::iota(whole.of_half.begin(), whole.of_half.end(), 0);
  whole.sign.assign(static_cast<std::size_t>(n), 1);
  for (int i = 0; i < n; ++i) {
    if (std::abs(half.X(0, i)) < 1e-12) {
      image[static_cast<std::size_t>(i)] = i;
      continue;
    }
    image[static_cast<std::size_t>(i)] = static_cast<int>(whole.of_half.size());
    whole.of_half.push_back(i);
    whole.sign.push_back(-1);
  }
  whole.X.resize(3, static_cast<Eigen::Index>(whole.of_half.size()));
  for (Eigen::Index i = 0; i < whole.X.cols(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    whole.X.col(i) = half.X.col(whole.of_half[k]);
    whole.X(0, i) *= whole.sign[k];
  }
  whole.tets.resize(4, 2 * half.tets.cols());
  for (Eigen::Index e = 0; e < half.tets.cols(); ++e) {
    const Eigen::Vector4i tet = half.tets.col(e);
    whole.tets.col(2 * e) = tet;
    const auto at = [&](int k) { return image[static_cast<std::size_t>(tet[k])]; };
    whole.tets.col(2 * e + 1) << at(1), at(0), at(2), at(3);
  }
  return whole;
}

/// How far half of a block on its plane of symmetry is from half of the whole one, by what moves
/// most: the mean square over the nodes, and the largest.
struct Asymmetry {
  double mean = 0, largest = 0;
};

/// Under an uneven pressure, in equilibrium or swinging.
Asymmetry half_and_whole(Element element, bool in_time, int cells) {
  constexpr double kSide = 0.01;
  BoxGeometry box;
  box.size = Vec3(1, 2, 2) * kSide;
  box.center = Vec3(0.5, 0, 1) * kSide;
  box.cells = cells * Eigen::Vector3i(2, 3, 3);
  const MeshData half = box_mesh(box);
  const Mirrored whole = mirrored(half);
  const TemporaryFolder folder;
  const auto scene_of = [&](const Positions& X, const Tetrahedra& tets, const std::string& name) {
    Scenario s = in_time ? scene(1e-3, Scheme::Dirk3) : static_scene(Solver::Cholesky);
    if (!in_time) s.integrator.step = 0.5;
    s.integrator.position_tolerance = 1e-12;
    s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Ones()), stand("floor")};
    MeshFile file;
    file.path = folder.file(name, as_deck(X, tets));
    file.unit = 1;
    s.bodies[0].geometry = file;
    s.bodies[0].material = material(neo_hookean(1e4, 0.3), element);
    s.attachments = {attach("block", "floor", {-1, -1, -1}, {1, 1, kEnd})};
    // Each face of the half that lies within has its image within.
    SurfaceLoad load = on_surface({-0.7 * kSide, 0, 0.5 * kSide}, {0.7 * kSide, 1, 1}, 600.0);
    if (!in_time) load.profile = {{0, 1}, {0, 1}};
    s.loads = {load};
    return s;
  };
  Scenario of_half = scene_of(half.X, half.tets, "half.inp");
  of_half.supports = {support("symmetry", {-kEnd, -1, kEnd}, {kEnd, 1, 1}, Vec3::UnitX())};
  Simulation a(of_half), b(scene_of(whole.X, whole.tets, "whole.inp"));
  const double end = in_time ? 0.01 : 1;
  a.advance(end);
  b.advance(end);
  double motion = 0, squares = 0, largest = 0;
  for (std::size_t i = 0; i < whole.of_half.size(); ++i) {
    Vec3 x = a.now().position(a.model.tissues[0].nodes[static_cast<std::size_t>(whole.of_half[i])]);
    x.x() *= whole.sign[i];
    const Vec3 y = b.now().position(b.model.tissues[0].nodes[i]);
    squares += (x - y).squaredNorm();
    largest = std::max(largest, (x - y).norm());
    motion = std::max(motion, (y - whole.X.col(static_cast<Eigen::Index>(i))).norm());
  }
  EXPECT_GT(motion, 0.1 * kSide);
  return {std::sqrt(squares / static_cast<double>(whole.of_half.size())) / motion,
          largest / motion};
}

// A plane of symmetry is what the other half does.
TEST(Support, HalfABlockOnAPlaneMovesAsHalfOfTheWhole) {
  for (const bool in_time : {false, true})
    EXPECT_LT(half_and_whole(Element::Plain, in_time, 1).largest, 1e-8) << in_time;
}

// Of the smoothing domains at the plane only one half is there, which the other would make even.
TEST(Support, OfSmoothedElementsTheHalfConvergesToHalfOfTheWhole) {
  const double coarse = half_and_whole(Element::Smoothed, false, 1).mean,
               fine = half_and_whole(Element::Smoothed, false, 2).mean;
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, 0.6 * coarse);
}

class SupportInTime : public ::testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, SupportInTime,
                         ::testing::Values(Scheme::ImplicitEuler, Scheme::TrBdf2, Scheme::Dirk3,
                                           Scheme::Explicit));

constexpr double kGravity = 9.81;

Scenario on_an_incline(Scheme scheme, const Vec3& normal, const Region& region) {
  Scenario s = scene(1e-3, scheme);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(0.01), Vec3::Zero(), {2, 2, 2})};
  Support plane = support("plane", {}, {}, normal);
  plane.region = region;
  s.supports = {plane};
  s.probes = {reaction("plane")};
  s.loads = {gravity({0, 0, -kGravity})};
  return s;
}

// All nodes on planes that are parallel: the block does not deform, slides by g_t t²/2 and weighs
// m g_n on its support, which does no work.
TEST_P(SupportInTime, ABlockSlidesDownAnInclineByTheClosedForm) {
  const Vec3 normal = Vec3(0.3, -0.5, 0.9).normalized();
  const Vec3 g(0, 0, -kGravity), along = g - normal * normal.dot(g);
  Simulation run(on_an_incline(GetParam(), normal, Region{}));
  const double mass = 1000 * 1e-6;
  double t_before = 0;
  Vec3 way = Vec3::Zero();  // of implicit Euler
  run.advance(0.05, [&] {
    const double h = run.state.t - t_before;
    t_before = run.state.t;
    way += h * run.state.t * along;
    const Tissue& tissue = run.model.tissues[0];
    const Vec3 expected =
        GetParam() == Scheme::ImplicitEuler ? way : Vec3(0.5 * run.state.t * run.state.t * along);
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      const Vec3 u =
          run.now().position(tissue.nodes[i]) - tissue.X.col(static_cast<Eigen::Index>(i));
      EXPECT_LT((u - expected).norm(), 1e-8);  // ten times the tolerance of an explicit step
      EXPECT_LT(std::abs(normal.dot(u)), 1e-15);
    }
    EXPECT_LT((Probes(run).vec3("plane.force", "N") - mass * normal * normal.dot(g)).norm(),
              1e-9 * mass * kGravity);
  });
  EXPECT_EQ(run.state.energy.motion_work, 0);
  EXPECT_EQ(run.state.energy.load_work, 0);
}

// On its lower face alone it swings across the plane, but nothing pushes it along: momentum there
// is m g_t t.
TEST_P(SupportInTime, MomentumAlongARollerIsThatOfTheLoadAlone) {
  const Vec3 normal(0, 0, 1);
  Region lower;
  lower.box = {Vec3(-1, -1, -1), Vec3(1, 1, -0.005 + kEnd)};
  Scenario s = on_an_incline(GetParam(), normal, lower);
  s.loads = {gravity({3, -2, -kGravity})};
  s.bodies[0].velocity = Vec3(0.1, 0, 0.2);
  Simulation run(s);
  const Tissue& tissue = run.model.tissues[0];
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      sum += tissue.lumped_mass[static_cast<Eigen::Index>(i)] * run.now().velocity(tissue.nodes[i]);
    return sum;
  };
  const Vec3 start = momentum();
  double lowest = 1, highest = 0;
  run.advance(0.03, [&] {
    const Vec3 p = momentum() - start;
    EXPECT_NEAR(p.x(), 1e-3 * 3 * run.state.t, 1e-8);
    EXPECT_NEAR(p.y(), 1e-3 * -2 * run.state.t, 1e-8);
    lowest = 1;
    highest = -1;
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      const double z = run.now().position(tissue.nodes[i]).z();
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
    }
    EXPECT_EQ(lowest, -0.005);
  });
  EXPECT_GT(std::abs(highest - 0.005), 1e-5);
}

// Confined compression by a plate that touches: σ_z = M ε, σ_x = λ ε = ν/(1 − ν) σ_z; what the
// plate presses the floor carries. Averaged contact passes the patch test to 0.03 %.
TEST(SupportWithContact, APlatePressesAConfinedBlockAndTheFloorCarriesIt) {
  constexpr double kNu = 0.3, kSide = 0.01;
  for (const Element element : {Element::Plain, Element::Smoothed}) {
    Scenario s = static_scene();
    s.contact = true;
    s.integrator.step = 0.5;
    s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(kSide), Vec3(0, 0, kSide / 2),
                         {2, 2, 2}),
                box_body("plate", Body::Kind::Fixed, {0.02, 0.02, 0.002},
                         {0, 0, kSide + 0.001 + 1e-5}, {3, 3, 1})};
    s.bodies[0].material = material(linear(1e4, kNu), element);
    const double a = kSide / 2;
    s.supports = {support("left", {-1, -1, -1}, {-a + kEnd, 1, 1}, Vec3::UnitX()),
                  support("right", {a - kEnd, -1, -1}, {1, 1, 1}, Vec3::UnitX()),
                  support("front", {-1, -1, -1}, {1, -a + kEnd, 1}, Vec3::UnitY()),
                  support("back", {-1, a - kEnd, -1}, {1, 1, 1}, Vec3::UnitY()),
                  support("floor", {-1, -1, -1}, {1, 1, kEnd}, Vec3::UnitZ())};
    for (const Support& given : s.supports) s.probes.push_back(reaction(given.name));
    s.probes.push_back({"contact", ContactProbe{"block", "plate"}});
    s.loads = {shift("plate", 1, {0, 0, -4e-4})};
    Simulation run(s);
    run.advance(1);
    const Probes probes(run);
    const double pressed = -probes.vec3("contact.force", "N").z();
    EXPECT_GT(pressed, 0.03);
    EXPECT_NEAR(-probes.vec3("floor.force", "N").z(), pressed, 1e-5 * pressed);
    const double lateral = kNu / (1 - kNu) * pressed;
    EXPECT_NEAR(probes.vec3("right.force", "N").x(), lateral, 5e-3 * lateral);
    EXPECT_NEAR(probes.vec3("left.force", "N").x(), -probes.vec3("right.force", "N").x(),
                1e-3 * lateral);
    EXPECT_NEAR(probes.vec3("back.force", "N").y(), lateral, 5e-3 * lateral);
    EXPECT_NEAR(probes.vec3("right.force", "N").y(), 0, 1e-12 * pressed);
  }
}

// At a node on two planes that are not at right angles the part that is free is their line; at one
// on three nothing is.
TEST(Support, SeveralPlanesLeaveTheirIntersectionFree) {
  const Vec3 n1 = Vec3(1, 0.2, 0).normalized(), n2 = Vec3(0.4, 1, 0.3).normalized(),
             n3 = Vec3(0, 0.1, 1).normalized();
  Scenario s = scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Ones())};
  const Vec3 low = Vec3::Constant(-1);
  s.supports = {support("a", low, Vec3(1, 1, 1), n1), support("b", low, Vec3(1, 1, 0), n2),
                support("c", low, Vec3(1, 0, 0), n3), support("a again", low, Vec3(1, 1, 0), -n1)};
  const Model model = build_model(s);
  ASSERT_EQ(model.held_blocks.size(), 8u);
  std::map<int, int> count;  // by the rank of what is free
  for (const HeldBlock& held : model.held_blocks) {
    const Mat3& P = held.free;
    EXPECT_LT((P * P - P).norm(), 1e-14);
    EXPECT_LT((P * n1).norm(), 1e-14);
    const auto rank = static_cast<int>(std::lround(P.trace()));
    ++count[rank];
    if (rank == 1) {
      EXPECT_LT((P * n1.cross(n2) - n1.cross(n2)).norm(), 1e-14);
    }
  }
  EXPECT_EQ(count[2], 4);
  EXPECT_EQ(count[1], 2);
  EXPECT_EQ(count[0], 2);
  EXPECT_EQ(num_held_freedoms(model, model.tissues[0]), 4 + 2 * 2 + 2 * 3);
  // What the supports of a node take is all that is held.
  std::map<int, Mat3> sum;
  for (const SupportModel& made : model.supports)
    for (const SupportModel::Node& node : made.nodes)
      sum.try_emplace(node.held, Mat3::Zero()).first->second += node.share;
  for (const auto& [held, share] : sum)
    EXPECT_LT(
        (share + model.held_blocks[static_cast<std::size_t>(held)].free - Mat3::Identity()).norm(),
        1e-14);
}

// P A P + s (I − P): a matrix that is symmetric and positive definite stays so, and what is held
// answers nothing.
TEST(Support, TheMatrixLosesWhatIsHeldAndStaysDefinite) {
  Scenario s = scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Ones())};
  const Vec3 normal = Vec3(1, 2, 3).normalized();
  s.supports = {support("a", Vec3::Constant(-1), Vec3(1, 1, 0), normal)};
  const Model model = build_model(s);
  const int n = model.layout.num_unknown_blocks();
  std::vector<int> all(static_cast<std::size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> offsets{0, n};
  fem::BlockMatrix A(n, all, offsets);
  Random random(3);
  const Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(3 * n, 3 * n, [&] { return random(); });
  const Eigen::MatrixXd C = B * B.transpose();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) A.block(A.slot(i, j)) = C.block<3, 3>(3 * i, 3 * j);
  keep_free_part(model, A);
  Eigen::MatrixXd got(3 * n, 3 * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) got.block<3, 3>(3 * i, 3 * j) = A.block(A.slot(i, j));
  Eigen::MatrixXd P = Eigen::MatrixXd::Identity(3 * n, 3 * n);
  for (const HeldBlock& held : model.held_blocks)
    P.block<3, 3>(3 * held.block, 3 * held.block) = held.free;
  EXPECT_LT((P * got * P - P * C * P).norm(), 1e-13 * C.norm());
  EXPECT_LT((got - got.transpose()).norm(), 1e-13 * C.norm());
  EXPECT_LT((P * got * (Eigen::MatrixXd::Identity(3 * n, 3 * n) - P)).norm(), 1e-13 * C.norm());
  EXPECT_GT(got.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
}

std::string refusal(const Scenario& s) {
  try {
    build_model(s);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Support, OfANodeThatIsAttachedIsRefusedWithBothEntries) {
  Scenario s = scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Ones()), stand("floor")};
  s.attachments = {attach("block", "floor", {-1, -1, -1}, {1, 1, 0})};
  s.attachments[0].where = {"scene.toml", 12, 1};
  s.supports = {support("plane", {-1, -1, -1}, {0, 1, 1}, Vec3::UnitX())};
  s.supports[0].where = {"scene.toml", 17, 1};
  const std::string message = refusal(s);
  EXPECT_NE(message.find("scene.toml:17"), std::string::npos) << message;
  EXPECT_NE(message.find("attached to `floor`, by the [[attach]] at scene.toml:12"),
            std::string::npos)
      << message;
}

TEST(Support, OfNoNodeIsRefused) {
  Scenario s = scene(1e-3);
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Ones())};
  s.supports = {support("plane", {2, 2, 2}, {3, 3, 3}, Vec3::UnitX())};
  EXPECT_NE(refusal(s).find("no node of tissue `block` lies in the region of the [[support]]"),
            std::string::npos);
}

// Two planes leave a shift along their line; a load along it is an error that names it.
TEST(Support, WhatPlanesLeaveLooseIsNamed) {
  Scenario s = static_scene();
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(0.01), Vec3::Zero(), {2, 2, 2})};
  s.supports = {support("x", {-1, -1, -1}, {-0.005 + kEnd, 1, 1}, Vec3::UnitX()),
                support("y", {-1, -1, -1}, {1, -0.005 + kEnd, 1}, Vec3::UnitY())};
  s.loads = {gravity({0, 0, -kGravity})};
  Simulation run(s);
  std::string message;
  try {
    run.advance(1);
  } catch (const SimulationError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("body `block` can shift along (0.00 0.00 -1.00)"), std::string::npos)
      << message;
  s.supports.push_back(support("z", {-1, -1, -1}, {1, 1, -0.005 + kEnd}, Vec3::UnitZ()));
  Simulation held(s);
  EXPECT_FALSE(held.stepper.loose());
  held.advance(1);
}

// A driven wall draws a block along a plane: the prediction must leave the nodes on it.
TEST(Support, ADrivenWallDrawsABlockThatStaysOnItsPlane) {
  Scenario s = static_scene();
  s.bodies = {box_body("block", Body::Kind::Tissue, Vec3::Constant(0.01), Vec3::Zero(), {2, 2, 2}),
              stand("wall")};
  s.attachments = {attach("block", "wall", {0.005 - kEnd, -1, -1}, {1, 1, 1})};
  s.supports = {
      support("floor", {-1, -1, -1}, {0.005 - 2 * kEnd, 1, -0.005 + kEnd}, Vec3::UnitZ())};
  s.loads = {shift("wall", 1, {0.02, 0, 0.001})};
  Simulation run(s);
  run.advance(1);
  const Tissue& tissue = run.model.tissues[0];
  for (const SupportModel::Node& node : run.model.supports[0].nodes)
    EXPECT_EQ(run.now().position(tissue.nodes[static_cast<std::size_t>(node.node)]).z(), -0.005);
  EXPECT_LT(run.stepper.now().forces.head(3 * run.model.layout.num_free_nodes).norm(), 1e-6);
}

using SupportFile = ScenarioTest;

TEST_F(SupportFile, IsReadWithItsMirrorImage) {
  const Scenario s = read(kStart + R"(
[[support]]
name = "plane_left"
body = "disc_left"
region = { box = ["1 0 0 mm", "2 1 1 mm"] }
freedoms = ["translation.x", "translation.z"]
turned = "0 0 30 deg"
)");
  ASSERT_EQ(s.supports.size(), 1u);
  EXPECT_EQ(s.supports[0].name, "plane_left");
  EXPECT_EQ(s.supports[0].body, "disc_left");
  ASSERT_EQ(s.supports[0].held.cols(), 2);
  EXPECT_LT((s.supports[0].held.col(0) - Vec3(std::sqrt(0.75), 0.5, 0)).norm(), 1e-15);
  EXPECT_LT((s.supports[0].held.col(1) - Vec3::UnitZ()).norm(), 1e-15);
}

TEST_F(SupportFile, WithMistakesIsRefused) {
  const std::string entry = "[[support]]\nbody = \"disc_left\"\nregion = {}\n";
  EXPECT_NE(refusal(kStart + entry + "freedoms = [\"rotation.x\"]\n")
                .find("nodes of tissue have no rotation: expected translations, found "
                      "\"rotation.x\""),
            std::string::npos);
  EXPECT_NE(refusal(kStart + "[[support]]\nbody = \"mandible\"\nregion = {}\nfreedoms = "
                             "[\"translation.x\"]\n")
                .find("a support holds nodes of tissue, and body `mandible` is none; a rigid one "
                      "has `hold`"),
            std::string::npos);
  const std::string named = kStart + entry + "freedoms = [\"translation.x\"]\nname = \"plane\"\n";
  EXPECT_NE(refusal(named + "[[probe]]\nname = \"p\"\nkind = \"reaction\"\nsupport = \"plain\"\n")
                .find("no [[support]] has the name `plain`; did you mean `plane`?"),
            std::string::npos);
  EXPECT_EQ(refusal(named + "[[probe]]\nname = \"p\"\nkind = \"reaction\"\nsupport = \"plane\"\n"),
            "");
}

}  // namespace articular::sim::support_test
