#include "tools/render/view.hpp"

#include <vtkPointSet.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sim/base/error.hpp"
#include "tools/render/nearest.hpp"

namespace articular::tools {
namespace {

/// Towards the first word, against the second one; zero if no axis has either.
Vec3 axis_of(const Directions& directions, const std::string& towards, const std::string& against) {
  for (int k = 0; k < 3; ++k) {
    const std::string& word = directions[static_cast<std::size_t>(k)];
    if (word == towards) return Vec3::Unit(k);
    if (word == against) return -Vec3::Unit(k);
  }
  return Vec3::Zero();
}

/// Columns: left, posterior, up.
Mat3 body_axes(const std::string& up_axis, const Directions& directions) {
  Vec3 posterior = Vec3::UnitY(), up = Vec3::UnitZ();
  if (up_axis == "y") {
    posterior = -Vec3::UnitZ();
    up = Vec3::UnitY();
  } else if (up_axis.empty()) {
    const Vec3 stated_posterior = axis_of(directions, "posterior", "anterior"),
               stated_up = axis_of(directions, "superior", "inferior");
    if (!stated_posterior.isZero(0) && !stated_up.isZero(0)) {
      posterior = stated_posterior;
      up = stated_up;
    }
  } else if (up_axis != "z") {
    throw sim::InputError("--up: unknown axis `" + up_axis + "`; expected y or z");
  }
  Mat3 body;
  body << posterior.cross(up), posterior, up;
  return body;
}

}  // namespace

ViewAxes view_axes(const std::string& view, const std::string& up_axis,
                   const Directions& directions) {
  static const std::map<std::string, Vec3> kDirections = {{"front", {0, -1, 0}},
                                                          {"back", {0, 1, 0}},
                                                          {"left", {1, 0, 0}},
                                                          {"right", {-1, 0, 0}},
                                                          {"top", {0, 0, 1}},
                                                          {"bottom", {0, 0, -1}},
                                                          {"three-quarter", {0.62, -0.80, 0.30}}};
  std::set<std::string> names;
  for (const auto& [name, direction] : kDirections) names.insert(name);
  const auto found = kDirections.find(view);
  if (found == kDirections.end())
    throw sim::InputError("--view: " + unknown_name("view", view, names));

  const Mat3 body = body_axes(up_axis, directions);
  const Vec3 to_eye = body * found->second.normalized();
  // From above and below the front of the body is at the top of the picture.
  const bool vertical = std::abs(found->second.z()) > 0.9;
  const Vec3 upwards = body * (vertical ? Vec3(0, -1, 0) : Vec3(0, 0, 1));
  const Vec3 right = upwards.cross(to_eye).normalized();
  return {right, to_eye.cross(right), to_eye};
}

void ViewBox::add(const Vec3& p) {
  const Vec3 seen(p.dot(axes_.right), p.dot(axes_.up), p.dot(axes_.to_eye));
  low_ = low_.cwiseMin(seen);
  high_ = high_.cwiseMax(seen);
}

void ViewBox::add(vtkPointSet& set) {
  for (vtkIdType i = 0; i < set.GetNumberOfPoints(); ++i) {
    Vec3 p;
    set.GetPoint(i, p.data());
    add(p);
  }
}

Vec3 ViewBox::middle() const {
  const Vec3 seen = 0.5 * (low_ + high_);
  return seen.x() * axes_.right + seen.y() * axes_.up + seen.z() * axes_.to_eye;
}

double half_height_for(const Vec3& size, double width_by_height) {
  constexpr double kMargin = 1.03;
  const double half = 0.5 * std::max(size.y(), size.x() / width_by_height);
  return kMargin * (half > 0 ? half : 1);  // a single point has no size
}

}  // namespace articular::tools
