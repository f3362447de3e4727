#include "tools/report/setup_marks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tools/render/setup_frame.hpp"

namespace articular::tools {
namespace {

constexpr std::size_t kMostArrows = 60;  // of one load: more hide what they point at
constexpr const char* kLoadColour = "#c2410c";

Json numbers_of(const std::vector<Vec3>& vectors) {
  std::vector<double> numbers;
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), {v.x(), v.y(), v.z()});
  return quantised(numbers, 0);
}

void add_points(const std::string& name, const Marks::Points& points, Json& marks) {
  if (points.at.empty()) return;
  std::string colour = "#";
  for (const double channel : points.colour)
    colour += fmt::format("{:02x}", std::lround(255 * channel));
  marks.push_back({{"name", name}, {"colour", colour}, {"points", numbers_of(points.at)}});
}

void add_arrows(const std::string& name, const std::vector<Vec3>& at,
                const std::vector<Vec3>& directions, Json& marks) {
  if (at.empty()) return;
  marks.push_back({{"name", name},
                   {"colour", kLoadColour},
                   {"points", numbers_of(at)},
                   {"directions", numbers_of(directions)}});
}

void add_forces(const sim::Model& model, const sim::Configuration& start, double unit,
                Json& marks) {
  for (const sim::ForceModel& load : model.forces)
    if (load.force.norm() > 0)
      add_arrows(fmt::format("force of {:.4g} N", load.force.norm()),
                 {start.position(load.point) / unit}, {load.force.normalized()}, marks);
}

/// An arrow along the axis, from the body's center of mass or held point.
void add_moments(const sim::Model& model, const sim::Configuration& start, double unit,
                 Json& marks) {
  for (const sim::MomentModel& load : model.moments)
    if (load.moment.norm() > 0)
      add_arrows(fmt::format("moment of {:.4g} N m", load.moment.norm()),
                 {start.poses[static_cast<std::size_t>(load.rigid)].p / unit},
                 {load.moment.normalized()}, marks);
}

void add_surface_load(const sim::SurfaceLoadModel& load, const sim::Configuration& start,
                      double unit, Json& marks) {
  const auto* const traction = std::get_if<Vec3>(&load.stress);
  const double size = traction != nullptr ? traction->norm() : std::get<double>(load.stress);
  std::vector<Vec3> at, directions;
  const std::size_t stride = load.faces.size() / kMostArrows + 1;
  for (std::size_t f = 0; f < load.faces.size(); f += stride) {
    std::array<Vec3, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = start.position(load.faces[f][k]);
    const Vec3 inward = -(x[1] - x[0]).cross(x[2] - x[0]);
    const Vec3 direction = traction != nullptr ? *traction : Vec3(size < 0 ? -inward : inward);
    if (!(direction.norm() > 0)) continue;
    at.emplace_back((x[0] + x[1] + x[2]) / (3 * unit));
    directions.emplace_back(direction.normalized());
  }
  add_arrows(fmt::format("{} of {:.4g} Pa", traction != nullptr ? "traction" : "pressure", size),
             at, directions, marks);
}

/// Beside the scene, along the axis that it is most across to.
void add_gravity(const sim::Model& model, double unit, Json& marks) {
  Eigen::AlignedBox3d box;
  for (const sim::BodyModel& body : model.bodies) {
    const Positions X = start_positions(model, body) / unit;
    for (Eigen::Index i = 0; i < X.cols(); ++i) box.extend(X.col(i));
  }
  if (box.isEmpty()) return;
  for (const sim::GravityModel& load : model.gravity) {
    if (!(load.acceleration.norm() > 0)) continue;
    Eigen::Index axis = 0;
    load.acceleration.cwiseAbs().minCoeff(&axis);
    const Vec3 beside = box.center() + 0.6 * box.sizes()[axis] * Vec3::Unit(axis);
    add_arrows(fmt::format("gravity of {:.4g} m/s²", load.acceleration.norm()), {beside},
               {load.acceleration.normalized()}, marks);
  }
}

}  // namespace

Json setup_marks(const sim::Model& model, const sim::Configuration& start, double unit) {
  Json marks = Json::array();
  add_points("attached nodes", attached_nodes(model, unit), marks);
  add_points("supported nodes", supported_nodes(model, unit), marks);
  add_points("ends of muscles and ligaments", line_ends(model, start, unit), marks);
  add_forces(model, start, unit, marks);
  add_moments(model, start, unit, marks);
  for (const sim::SurfaceLoadModel& load : model.surface_loads)
    add_surface_load(load, start, unit, marks);
  add_gravity(model, unit, marks);
  return marks;
}

}  // namespace articular::tools
