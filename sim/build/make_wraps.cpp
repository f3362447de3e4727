#include "sim/build/make_wraps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sim/base/place_text.hpp"
#include "sim/mesh/triangle_distance.hpp"
#include "sim/mesh/winding_number.hpp"

namespace articular::sim {
namespace {

/// Points of lines that lie as near to a surface as this part of its size are taken to lie on it:
/// recorded points lie beside scanned bones.
constexpr double kOnWrap = 1e-3;
/// Deeper than this part of its size a point is inside of what the line wraps around.
constexpr double kDeepestInWrap = 0.05;

struct Nearest {
  int face = -1;
  double distance = std::numeric_limits<double>::infinity();  // [m]
};

Nearest nearest_face(const WrapBody& body, const Vec3& x) {
  Nearest nearest;
  for (int f = 0; f < static_cast<int>(body.surface.triangles.cols()); ++f) {
    const auto corner = body.surface.triangles.col(f);
    const double d = std::sqrt(
        squared_distance(x, body.X.col(corner[0]), body.X.col(corner[1]), body.X.col(corner[2])));
    if (d < nearest.distance) nearest = {f, d};
  }
  return nearest;
}

/// On which triangle of the bodies a point lies that moves with one of them.
StringEnd end_at(const std::vector<std::string>& names, const Vec3& x, const WeightedPoint& point,
                 const Location& where, const Model& model, const Line& line) {
  StringEnd end;
  end.x = x;
  for (std::size_t k = 0; k < line.wrap.bodies.size(); ++k) {
    const WrapBody& body = model.wrap_bodies[static_cast<std::size_t>(line.wrap.bodies[k])];
    const Vec3 local = x - model.rigid_bodies[static_cast<std::size_t>(body.rigid)].rest.p;
    const Nearest nearest = nearest_face(body, local);
    const bool inside = winding_number(body.X, body.surface.triangles, local) > 0.5;
    if (inside && nearest.distance > kDeepestInWrap * body.size) {
      throw InputError(where,
                       fmt::format("`{}` wraps around `{}`, but its point {} lies "
                                   "{:.3g} mm inside: expected at most {:.3g} mm",
                                   line.name, names[k], place_text(x), 1e3 * nearest.distance,
                                   1e3 * kDeepestInWrap * body.size));
    }
    const bool moves_along = std::all_of(point.nodes.begin(), point.nodes.end(),
                                         [&](const NodeRef& n) { return n.rigid == body.rigid; });
    if (moves_along && (inside || nearest.distance < kOnWrap * body.size)) {
      end.surface = static_cast<int>(k);
      end.face = nearest.face;
    }
  }
  return end;
}

/// The surface of a rigid or fixed body, made the first time that a line wraps around it.
/// @return its index into Model::wrap_bodies
int wrap_body(int body, Model& model) {
  const BodyModel& given = model.bodies[static_cast<std::size_t>(body)];
  for (std::size_t k = 0; k < model.wrap_bodies.size(); ++k)
    if (model.wrap_bodies[k].rigid == given.rigid) return static_cast<int>(k);
  WrapBody wrap;
  wrap.rigid = given.rigid;
  wrap.X = given.X;
  wrap.surface = make_wrap_surface(given.triangles);
  wrap.tree = TriangleTree(given.X, given.triangles);
  wrap.size = (given.X.rowwise().maxCoeff() - given.X.rowwise().minCoeff()).norm();
  model.wrap_bodies.push_back(std::move(wrap));
  return static_cast<int>(model.wrap_bodies.size()) - 1;
}

}  // namespace

void make_wrap(const std::vector<std::string>& names, const std::vector<int>& bodies,
               const std::vector<Vec3>& points, const Location& where, Model& model, Line& line) {
  for (const int body : bodies) line.wrap.bodies.push_back(wrap_body(body, model));
  std::vector<PlacedSurface> surfaces;
  for (const int b : line.wrap.bodies) {
    const WrapBody& body = model.wrap_bodies[static_cast<std::size_t>(b)];
    surfaces.push_back(body.at(model.rigid_bodies[static_cast<std::size_t>(body.rigid)].rest));
  }
  std::vector<StringEnd> ends;
  for (std::size_t i = 0; i < points.size(); ++i)
    ends.push_back(end_at(names, points[i], line.path[i], where, model, line));
  line.start_length = 0;
  WrapWork work;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    WrappedString string{ends[i], ends[i + 1], {}};
    if (!wrap(surfaces, string, work))
      throw InputError(where, fmt::format("no way was found for `{}` around {}: expected surfaces "
                                          "without holes near it, or via points that lead it",
                                          line.name, fmt::join(names, ", ")));
    line.start_length += work.shape.length;
    line.wrap.strings.push_back(std::move(string));
  }
}

}  // namespace articular::sim
