#include "sim/build/coincident_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

/// Of a body's extent: rounding of positions in files and of placements.
constexpr double kRounding = 1e-9;

/// Of the nodes of the surface, in the order of x [m].
std::vector<Vec3> surface_positions(const Collider& body) {
  std::vector<char> used(static_cast<std::size_t>(body.X.cols()), 0);
  for (const int i : body.surface.faces.reshaped()) used[static_cast<std::size_t>(i)] = 1;
  std::vector<Vec3> positions;
  for (Eigen::Index i = 0; i < body.X.cols(); ++i)
    if (used[static_cast<std::size_t>(i)] != 0) positions.emplace_back(body.X.col(i));
  std::sort(positions.begin(), positions.end(),
            [](const Vec3& p, const Vec3& q) { return p.x() < q.x(); });
  return positions;
}

bool holds(const std::vector<Vec3>& sorted, const Vec3& x, double tolerance) {
  auto p = std::lower_bound(sorted.begin(), sorted.end(), x.x() - tolerance,
                            [](const Vec3& q, double least) { return q.x() < least; });
  for (; p != sorted.end() && p->x() <= x.x() + tolerance; ++p)
    if ((*p - x).lpNorm<Eigen::Infinity>() <= tolerance) return true;
  return false;
}

bool coincide(const Collider& a, const Collider& b) {
  const Vec3 low = a.X.rowwise().minCoeff(), high = a.X.rowwise().maxCoeff();
  const double tolerance = kRounding * (high - low).norm();
  const std::vector<Vec3> of_a = surface_positions(a), of_b = surface_positions(b);
  return of_a.size() == of_b.size() && std::all_of(of_a.begin(), of_a.end(), [&](const Vec3& x) {
           return holds(of_b, x, tolerance);
         });
}

}  // namespace

bool are_tied(const Model& model, const ContactModel& contact) {
  const auto tied = [&](int tissue, int rigid) {
    const BodyModel& body = model.bodies[static_cast<std::size_t>(tissue)];
    const int index = model.bodies[static_cast<std::size_t>(rigid)].rigid;
    return body.tissue >= 0 && index >= 0 &&
           std::any_of(body.collider->nodes.begin(), body.collider->nodes.end(),
                       [&](const NodeRef& node) { return node.rigid == index; });
  };
  return tied(contact.a, contact.b) || tied(contact.b, contact.a);
}

void refuse_coincident_bodies(const Scenario& scenario, const Model& model) {
  for (const ContactModel& contact : model.contacts) {
    if (contact.a == contact.b || are_tied(model, contact)) continue;
    const auto a = static_cast<std::size_t>(contact.a), b = static_cast<std::size_t>(contact.b);
    if (!coincide(*model.bodies[a].collider, *model.bodies[b].collider)) continue;
    throw InputError(scenario.bodies[b].where,
                     fmt::format("bodies `{}` and `{}` are the same mesh at the same place; "
                                 "expected one of them, or another place",
                                 model.bodies[a].name, model.bodies[b].name));
  }
}

}  // namespace articular::sim
