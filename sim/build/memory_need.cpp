#include "sim/build/memory_need.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/available_memory.hpp"

namespace articular::sim {
namespace {

// Bytes a tetrahedron, as `articular explain` measures them on boxes of 12 to 40 cells an edge.
constexpr double kRigidModel = 80, kPlainModel = 180, kSmoothedModel = 2000;
constexpr double kPlainMatrices = 450, kSmoothedMatrices = 2100;

constexpr double kTetsOfACell = 6;
/// Four corners of each are counted by an int.
constexpr double kMostTetrahedra = std::numeric_limits<int>::max() / 4.0;

bool is_smoothed(const Body& body) {
  return body.material->element == TissueMaterial::Element::Smoothed;
}

struct CountTetrahedra {
  double operator()(std::monostate) const { return 0; }
  double operator()(const MeshFile&) const { return 0; }
  double operator()(const BoxGeometry& box) const { return of_cells(box.cells.cast<double>()); }
  double operator()(const HexahedronGeometry& block) const {
    return of_cells(block.cells.cast<double>());
  }
  double operator()(const SphereGeometry& sphere) const {
    const double half = std::max(1.0, std::round(sphere.radius / sphere.element_size));
    return of_cells(Vec3::Constant(2 * half));
  }
  double operator()(const VShapeGeometry& shape) const {
    const auto cells = shape.cells.cast<double>();
    return of_cells({2 * cells.x(), cells.y(), cells.y()});
  }
  static double of_cells(const Vec3& cells) { return kTetsOfACell * cells.prod(); }
};

}  // namespace

double num_shape_tetrahedra(const Body& body) {
  return std::visit(CountTetrahedra{}, body.geometry);
}

MemoryNeed memory_need(const Scenario& scenario, const std::vector<double>& num_tets) {
  const bool has_matrix = scenario.analysis == Scenario::Analysis::Static ||
                          scenario.integrator.scheme != Integrator::Scheme::Explicit;
  MemoryNeed need;
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
    const Body& body = scenario.bodies[b];
    if (body.kind != Body::Kind::Tissue) {
      need.model += kRigidModel * num_tets[b];
      continue;
    }
    need.model += (is_smoothed(body) ? kSmoothedModel : kPlainModel) * num_tets[b];
    if (has_matrix)
      need.matrices += (is_smoothed(body) ? kSmoothedMatrices : kPlainMatrices) * num_tets[b];
  }
  return need;
}

void refuse_more_memory(const Scenario& scenario, const std::vector<double>& num_tets,
                        double available) {
  if (num_tets.empty()) return;
  const auto largest = static_cast<std::size_t>(std::max_element(num_tets.begin(), num_tets.end()) -
                                                num_tets.begin());
  const Body& body = scenario.bodies[largest];
  if (num_tets[largest] > kMostTetrahedra)
    throw InputError(body.where,
                     fmt::format("`{}` would have {:.3g} tetrahedra; a mesh has at most {:.3g}",
                                 body.name, num_tets[largest], kMostTetrahedra));
  const double need = memory_need(scenario, num_tets).total();
  if (need <= available) return;
  throw InputError(
      body.where,
      fmt::format("the scene would take at least {} of memory, and {} are available: `{}` alone "
                  "has {:.3g} tetrahedra; give it fewer cells{}",
                  size_text(need), size_text(available), body.name, num_tets[largest],
                  body.kind == Body::Kind::Tissue && is_smoothed(body)
                      ? ", or plain elements, which take a sixth"
                      : ""));
}

}  // namespace articular::sim
