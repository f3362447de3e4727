#include "tests/benchmarks/sim/contact_scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "sim/build/build_model.hpp"
#include "sim/output/history.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim {
namespace {

/// A load step that has to be cut into shorter ones than this is given up [unit of time].
constexpr double kLeastStep = 1.0 / 64;
constexpr double kDensity = 1000;  // [kg/m³] of what is loose before contact: pseudo-time asks

/// Distances from 0 to `end`: h up to `fine`, then growing; the last one is `end` itself.
std::vector<double> graded(double end, double fine, double h, double growth) {
  std::vector<double> lines = {0};
  double size = h;
  while (lines.back() + 0.5 * size < end) {
    if (lines.back() + 1e-9 * h >= fine) size *= growth;
    lines.push_back(lines.back() + size);
  }
  for (double& line : lines)  // what was passed or missed is spread over the coarse cells
    if (line > fine + 1e-9 * h) line = fine + (line - fine) * (end - fine) / (lines.back() - fine);
  lines.back() = end;
  return lines;
}

Model model_of(const Scene& scene, const StudyOptions& options) {
  Model model = build_model(scene.scenario());
  model.contacts.change([options](ContactModel& contact) {
    if (options.rule != DepthRule::Averaged) contact.averaged = contact.is_bounded = false;
    contact.mean_stiffness *= options.stiffness;
    contact.factor *= options.stiffness;
    contact.layers /= options.stiffness;
  });
  return model;
}

}  // namespace

std::vector<double> uniform_lines(double from, double to, int cells) {
  std::vector<double> lines;
  for (int i = 0; i <= cells; ++i) lines.push_back(from + (to - from) * i / cells);
  return lines;
}

std::vector<double> graded_lines(double half, double fine, double h, double growth) {
  const std::vector<double> right = graded(half, fine, h, growth);
  std::vector<double> lines(right.rbegin(), right.rend());
  for (double& line : lines) line = -line;
  lines.insert(lines.end(), right.begin() + 1, right.end());
  return lines;
}

std::vector<double> graded_depth(double bottom, double fine, double h, double growth) {
  std::vector<double> lines = graded(-bottom, fine, h, growth);
  std::reverse(lines.begin(), lines.end());
  for (double& line : lines) line = -line;
  return lines;
}

MeshData block_mesh(const GridLines& lines) {
  const Eigen::Vector3i cells(static_cast<int>(lines.x.size()) - 1,
                              static_cast<int>(lines.y.size()) - 1,
                              static_cast<int>(lines.z.size()) - 1);
  // Nodes at whole numbers, which are then the numbers of the lines.
  MeshData mesh = box_mesh({cells.cast<double>(), cells, 0.5 * cells.cast<double>()});
  const auto at = [](const std::vector<double>& line, double number) {
    return line[static_cast<std::size_t>(std::lround(number))];
  };
  for (auto node : mesh.X.colwise())
    node = Vec3(at(lines.x, node.x()), at(lines.y, node.y()), at(lines.z, node.z()));
  return mesh;
}

void jitter(MeshData& mesh, double h, double part, unsigned seed) {
  Random random(seed);
  const Vec3 low = mesh.X.rowwise().minCoeff(), high = mesh.X.rowwise().maxCoeff();
  for (auto node : mesh.X.colwise()) {
    const Vec3 shift = part * h * random.vec3();
    for (int i = 0; i < 3; ++i)
      if (node[i] > low[i] + 1e-6 * h && node[i] < high[i] - 1e-6 * h) node[i] += shift[i];
  }
}

MeshData sphere_cap(double radius, double half, double fine, double h) {
  constexpr double kGrowth = 1.3;
  const std::vector<double> lines = graded_lines(half, fine, h, kGrowth);
  const auto n = static_cast<int>(lines.size());
  MeshData cap;
  cap.X.resize(3, n * n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = lines[static_cast<std::size_t>(i)], y = lines[static_cast<std::size_t>(j)];
      cap.X.col(j * n + i) = Vec3(x, y, radius - std::sqrt(radius * radius - x * x - y * y));
    }
  cap.triangles.resize(3, 2 * (n - 1) * (n - 1));
  Eigen::Index t = 0;
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {  // outward is down
      const int a = j * n + i;
      cap.triangles.col(t++) = Eigen::Vector3i(a, a + n, a + n + 1);
      cap.triangles.col(t++) = Eigen::Vector3i(a, a + n + 1, a + 1);
    }
  return cap;
}

Scene::Scene(const StudyOptions& options) : scenario_(scene(1)), element_(options.element) {
  scenario_.analysis = Scenario::Analysis::Static;
  scenario_.contact = true;
  scenario_.integrator.position_tolerance.reset();
}

Body Scene::meshed(const std::string& name, const MeshData& mesh) {
  Body body;
  body.name = name;
  MeshFile file;
  file.path = folder_ / (name + (mesh.tets.cols() > 0 ? ".vtu" : ".vtp"));
  file.unit = 1;
  write_mesh(file.path, mesh, 1);
  body.geometry = file;
  return body;
}

void Scene::tissue(const std::string& name, const MeshData& mesh, const fem::AnyMaterial& law) {
  Body body = meshed(name, mesh);
  body.kind = Body::Kind::Tissue;
  body.density = kDensity;
  body.material = material_of(law);
  body.material->element = element_;
  add(std::move(body));
}

void Scene::add_rigid(const std::string& name, const MeshData& mesh) {
  Body body = meshed(name, mesh);
  body.kind = Body::Kind::Fixed;
  add(std::move(body));
}

void Scene::tie(const std::string& tissue, const std::string& rigid, double z_low, double z_high) {
  constexpr double kFar = 1e3;  // [m]
  tie_box(tissue, rigid, {-kFar, -kFar, z_low}, {kFar, kFar, z_high});
}

void Scene::tie_box(const std::string& tissue, const std::string& rigid, const Vec3& low,
                    const Vec3& high) {
  scenario_.attachments.push_back(attach(tissue, rigid, low, high));
}

void Scene::drive(const std::string& rigid, const std::vector<Vec3>& places) {
  MotionLoad load;
  load.body = rigid;
  load.motion.interpolation = Motion::Interpolation::Linear;
  for (std::size_t i = 0; i < places.size(); ++i) {
    load.motion.time.push_back(static_cast<double>(i));
    load.motion.translation.push_back(places[i]);
  }
  scenario_.loads.push_back(load);
  scenario_.duration = static_cast<double>(places.size()) - 1;
}

void Scene::touch(const std::string& a, const std::string& b) {
  scenario_.contacts = {{a, b, {}}};
  scenario_.probes = {{"contact", ContactProbe{a, b}}};
}

ContactRun::ContactRun(const Scene& scene, const StudyOptions& options)
    : model_(model_of(scene, options)),
      stepper_(model_, step_settings(scene.scenario())),
      state_(stepper_.initial()) {}

void ContactRun::step(double t) {
  const auto start = std::chrono::steady_clock::now();
  const double least = std::min(kLeastStep, 0.9 * (t - state_.t));
  while (state_.t < t) {
    const double before = state_.t;
    stepper_.step(state_, t);
    if (state_.t < t && state_.t - before < least)
      throw std::runtime_error("a load step was cut too often");
  }
  ++steps_;
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void ContactRun::steps(double until, int count) {
  const double from = state_.t;
  for (int i = 1; i <= count; ++i) step(i == count ? until : from + (until - from) * i / count);
}

void ContactRun::reset_costs() {
  steps_ = 0;
  seconds_ = 0;
  before_ = state_.counts;
}

Costs ContactRun::costs() const {
  const SolverCounts since = static_cast<const SolverCounts&>(state_.counts) - before_;
  return {static_cast<double>(since.newton_iterations) / steps_,
          static_cast<int>(since.rejected_newton), seconds_ / steps_};
}

ContactValues ContactRun::contact() const {
  History history(model_, {1, "m"});
  history.record(state_, stepper_);
  const auto value = [&](const std::string& start) {
    for (std::size_t i = 0; i < history.columns().size(); ++i)
      if (history.columns()[i].rfind("contact." + start + " ", 0) == 0) return history.last()[i];
    throw std::logic_error("no column contact." + start);
  };
  return {{value("force.x"), value("force.y"), value("force.z")},
          value("area"),
          value("max_penetration")};
}

std::vector<NodalContact> ContactRun::nodal_contacts(const std::string& name,
                                                     const Vec3& outward) const {
  const auto named = [&](const BodyModel& body) { return body.name == name; };
  const auto body = std::find_if(model_.bodies.begin(), model_.bodies.end(), named);
  const Collider& collider = body->collider.value();
  const Positions forces =
      stepper_.contact_forces()[static_cast<std::size_t>(body - model_.bodies.begin())];
  Eigen::VectorXd area = Eigen::VectorXd::Zero(collider.X.cols());
  for (const auto& face : collider.surface.faces.colwise()) {
    const Vec3 a = collider.X.col(face[1]) - collider.X.col(face[0]);
    const Vec3 b = collider.X.col(face[2]) - collider.X.col(face[0]);
    const Vec3 cross = a.cross(b);
    if (cross.dot(outward) < 0.5 * cross.norm()) continue;
    for (const int node : face) area[node] += cross.norm() / 6;
  }
  std::vector<NodalContact> nodes;
  for (Eigen::Index i = 0; i < area.size(); ++i)
    if (area[i] > 0) {
      const double force = forces.col(i).norm();
      nodes.push_back({collider.X.col(i), force, force / area[i]});
    }
  return nodes;
}

Eigen::VectorXd ContactRun::axial_stress(std::size_t tissue) const {
  const Tissue& t = model_.tissues[tissue];
  Positions x;
  positions_of(stepper_.now().configuration, t.nodes, x);
  return t.elements.cauchy_stress(x, 0).row(2);
}

double peak_pressure(const std::vector<NodalContact>& nodes) {
  double peak = 0;
  for (const NodalContact& node : nodes) peak = std::max(peak, node.pressure);
  return peak;
}

const char* const kCostHeader = "iterations/step | rejected | s/step |";
const char* const kCostRule = "---|---|---|";

std::string cost_columns(const Costs& costs) {
  return fmt::format("{:.1f} | {} | {:.2f} |", costs.iterations, costs.rejected, costs.seconds);
}

void print_failure(const std::string& name, const std::exception& error) {
  std::printf("| %s | failed: %s |\n", name.c_str(), error.what());
  std::fflush(stdout);
}

}  // namespace articular::sim
