// What is told of the pressure of contact, against closed forms and finer meshes: the peak on both
// bodies, by ways to make a number a node of what lies on the patches around it.
//
// A flat circular punch on a half space has F/(2πa²) in its middle and p(r) = F/(2πa²)/√(1 − r²/a²)
// [Johnson 1985, ch. 3.8]; a sphere has p₀ = 3F/(2πa²) [Hertz 1882].
//
// [Johnson 1985] Johnson. Contact Mechanics. Cambridge University Press.
// [Hertz 1882] Hertz. Ueber die Berührung fester elastischer Körper. J. reine angew. Math. 92:156.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>

#include "fem/material/any_material.hpp"
#include "sim/contact/contact_pressure.hpp"
#include "tests/benchmarks/sim/contact_study.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim {
namespace {

using std::numbers::pi;

constexpr double kPunchYoung = 1e6, kPunchPoisson = 0.3;
constexpr double kPunchRadius = 1;  // a, of the punch and of the sphere's contact [m]
constexpr double kSphere = 20 * kPunchRadius;
constexpr double kPunchGrowth = 1.6;  // of cells away from the contact
constexpr int kPunchSteps = 2;

/// A block with its top at z = 0, tied at its bottom.
void add_block(Scene& scene, double h) {
  constexpr double kDepth = 8 * kPunchRadius, kHalfWidth = 6 * kPunchRadius,
                   kFine = 1.3 * kPunchRadius;
  const std::vector<double> side = graded_lines(kHalfWidth, kFine, h, kPunchGrowth);
  scene.tissue("lower",
               block_mesh({side, side, graded_depth(-kDepth, 0.8 * kPunchRadius, h, kPunchGrowth)}),
               fem::NeoHookean(kPunchYoung, kPunchPoisson));
  scene.add(stand("floor"));
  scene.tie("lower", "floor", -1.001 * kDepth, -0.999 * kDepth);
}

/// A disc that looks down, its rings h wide.
MeshData disc(double h) {
  const int rings = static_cast<int>(std::lround(kPunchRadius / h)), sectors = 6 * rings;
  MeshData mesh;
  mesh.X.setZero(3, 1 + rings * sectors);
  const auto node = [&](int ring, int sector) {
    return ring == 0 ? 0 : 1 + (ring - 1) * sectors + sector % sectors;
  };
  std::vector<Eigen::Vector3i> triangles;
  for (int ring = 1; ring <= rings; ++ring)
    for (int s = 0; s < sectors; ++s) {
      const double angle = 2 * pi * s / sectors, r = kPunchRadius * ring / rings;
      mesh.X.col(node(ring, s)) = Vec3(r * std::cos(angle), r * std::sin(angle), 0);
      triangles.emplace_back(node(ring, s), node(ring - 1, s), node(ring, s + 1));
      if (ring > 1)
        triangles.emplace_back(node(ring, s + 1), node(ring - 1, s), node(ring - 1, s + 1));
    }
  mesh.triangles.resize(3, std::ssize(triangles));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    mesh.triangles.col(t) = triangles[static_cast<std::size_t>(t)];
  return mesh;
}

/// A wedge of tissue, thin edge at x = 0, whose top rises with the slope; it is as wide as long.
constexpr double kWedge = 4, kSlope = 0.5;
MeshData wedge(double h) {
  const int n = static_cast<int>(std::lround(kWedge / h));
  constexpr double kEdge = 0.1;  // how high the thin edge is
  MeshData mesh = block_mesh({uniform_lines(0, kWedge, n), uniform_lines(0, 4 * h, 4),
                              uniform_lines(0, 1, std::max(2, n / 2))});
  for (auto x : mesh.X.colwise()) x.z() *= kEdge + kSlope * x.x();
  return mesh;
}

Eigen::VectorXd over(const Eigen::VectorXd& force, const Eigen::VectorXd& area) {
  return (area.array() > 0).select(force.array() / area.array(), 0);
}

/// What a table has of pressures at these places [Pa], where there is one.
using Measure = std::function<double(const Positions& X, const Eigen::VectorXd& pressures)>;

double largest(const Positions&, const Eigen::VectorXd& pressures) {
  double p = 0;
  for (const double value : pressures)
    if (value > p) p = value;
  return p;
}

std::size_t body_of(const Model& model, const std::string& name) {
  const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                 [&](const BodyModel& b) { return b.name == name; });
  return static_cast<std::size_t>(body - model.bodies.begin());
}

/// The pressure of the contact law at the groups of the body whose depths are averaged.
std::optional<Eigen::VectorXd> law_pressure(const ContactRun& run, std::size_t body) {
  for (const ContactPairState* pair : run.response().pair_states())
    if (sides_of(run.model(), *pair).triangle_body == static_cast<int>(body)) return pair->pressure;
  return std::nullopt;
}

void print_row(const ContactRun& run, int elements, const std::string& name,
               const Measure& measure) {
  const Model& model = run.model();
  const std::size_t b = body_of(model, name);
  const Collider& collider = *model.bodies[b].collider;
  const PressureLoad load = pressure_loads(model, run.response(), run.configuration())[b];
  const Eigen::VectorXd areas = group_areas(collider, load), faces = face_pressures(load);
  Positions nodes(3, areas.size()), middles(3, faces.size());
  for (Eigen::Index g = 0; g < areas.size(); ++g)
    nodes.col(g) = collider.X.col(collider.group_node[static_cast<std::size_t>(g)]);
  Eigen::VectorXd ring = Eigen::VectorXd::Zero(areas.size());
  for (Eigen::Index f = 0; f < faces.size(); ++f) {
    middles.col(f) = collider.X(Eigen::all, collider.surface.faces.col(f)).rowwise().mean();
    for (const int g : collider.groups.col(f)) ring[g] += faces[f] * load.face_area[f] / 3;
  }
  const auto told = group_pressures(collider, load);
  const auto law = law_pressure(run, b);
  std::printf("| %d | %s | %s |", elements, name.c_str(),
              law ? fmt::format("{:.1f}", measure(nodes, *law)).c_str() : "–");
  for (const Eigen::VectorXd& candidate :
       {told, over(load.force, load.covered), over(load.force, areas), over(ring, areas)})
    std::printf(" %.1f |", measure(nodes, candidate));
  std::printf(" %.1f | %ld | %.1e |\n", measure(middles, faces),
              std::count_if(told.begin(), told.end(), [](double p) { return std::isnan(p); }),
              load.through.sum() / std::abs(run.contact().force.z()) - 1);
  std::fflush(stdout);
}

void print_pressure_header(const std::string& title) {
  std::printf(
      "\n## %s\n\n| elements | body | p of the law | told | with slivers | by the whole area | "
      "mean of the ring | face | blank nodes | sum over force − 1 |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      title.c_str());
}

/// Presses, and prints a row for each body; measure_of(run) is what the rows have.
template <class MeasureOf>
void run_rows(const Scene& scene, const StudyOptions& options, int elements,
              const std::array<const char*, 2>& bodies, MeasureOf&& measure_of) {
  try {
    ContactRun run(scene, options);
    run.steps(1, kPunchSteps);
    for (const char* const body : bodies) print_row(run, elements, body, measure_of(run));
  } catch (const std::exception& error) {
    print_failure(std::to_string(elements), error);
  }
}

double normal_force(const ContactRun& run) { return std::abs(run.contact().force.z()); }

void punch(const StudyOptions& options) {
  print_pressure_header("Flat punch: largest error up to 0.6 a [%]");
  for (const int elements : {2, 3, 4, 8}) {
    if (elements > options.finest) continue;
    Scene scene(options);
    add_block(scene, kPunchRadius / elements);
    scene.add_rigid("punch", disc(kPunchRadius / (elements + 1)));
    scene.touch("punch", "lower");
    scene.drive("punch", {Vec3::Zero(), Vec3(0, 0, -0.02 * kPunchRadius)});
    run_rows(scene, options, elements, {"lower", "punch"}, [](const ContactRun& run) {
      const double middle = normal_force(run) / (2 * pi * kPunchRadius * kPunchRadius);
      return [middle](const Positions& X, const Eigen::VectorXd& p) {
        double error = 0;
        for (Eigen::Index i = 0; i < p.size(); ++i) {
          const double r = X.col(i).head<2>().norm() / kPunchRadius;
          const bool touches = r < 0.6 && std::abs(X(2, i)) < 1e-9;
          if (touches) error = std::max(error, std::abs(p[i] / middle * std::sqrt(1 - r * r) - 1));
        }
        return 100 * error;
      };
    });
  }
}

void sphere(const StudyOptions& options) {
  print_pressure_header("Sphere: error of the peak [%]");
  for (const int elements : {1, 2, 4, 8}) {
    if (elements > options.finest) continue;
    Scene scene(options);
    add_block(scene, kPunchRadius / elements);
    scene.add_rigid("sphere", sphere_cap(kSphere, 3 * kPunchRadius, 1.3 * kPunchRadius,
                                         kPunchRadius / (1.2 * elements)));
    scene.touch("sphere", "lower");
    scene.drive("sphere", {Vec3::Zero(), Vec3(0, 0, -kPunchRadius * kPunchRadius / kSphere)});
    run_rows(scene, options, elements, {"lower", "sphere"}, [](const ContactRun& run) {
      const double E_star = kPunchYoung / (1 - kPunchPoisson * kPunchPoisson),
                   force = normal_force(run);
      const double a = std::cbrt(0.75 * force * kSphere / E_star);
      return [peak = 1.5 * force / (pi * a * a)](const Positions& X, const Eigen::VectorXd& p) {
        return 100 * (largest(X, p) / peak - 1);
      };
    });
  }
}

void edge(const StudyOptions& options) {
  print_pressure_header("Edge of a wedge: peak [kPa]");
  constexpr double kLayer = 1, kBefore = 1.5, kBehind = 0.37;  // of what it presses on [m]
  for (const int elements : {4, 6, 8, 16}) {
    if (elements > 2 * options.finest) continue;
    const double h = kWedge / elements;
    const int cells = static_cast<int>(std::lround((kBefore + kWedge + kBehind) / (0.83 * h)));
    Scene scene(options);
    scene.tissue("wedge", wedge(h), fem::NeoHookean(kPunchYoung, kPunchPoisson));
    scene.tissue(
        "lower",
        block_mesh({uniform_lines(-kBefore, kWedge + kBehind, cells), uniform_lines(0, 4 * h, 4),
                    uniform_lines(-kLayer, 0, std::max(2, elements / 4))}),
        fem::NeoHookean(kPunchYoung, kPunchPoisson));
    scene.add(stand("floor"));
    scene.add(stand("rim"));
    scene.tie("lower", "floor", -1.001 * kLayer, -0.999 * kLayer);
    scene.tie_box("wedge", "rim", {0.999 * kWedge, -1, -1}, {1.001 * kWedge, 10, 10});
    scene.touch("wedge", "lower");
    scene.drive("rim", {Vec3::Zero(), Vec3(0, 0, -0.1)});
    run_rows(scene, options, elements, {"wedge", "lower"}, [](const ContactRun&) {
      return [](const Positions& X, const Eigen::VectorXd& p) { return 1e-3 * largest(X, p); };
    });
  }
}

}  // namespace

void study_pressure(const StudyOptions& options) {
  punch(options);
  sphere(options);
  edge(options);
}

}  // namespace articular::sim
