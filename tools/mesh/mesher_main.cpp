// articular-mesher: one closed surface to tetrahedra with CGAL Mesh_3 (Delaunay refinement, then
// perturbation and exudation of slivers). `articular mesh` starts it; CGAL is under the GPL, and so
// is this program, which shares no code with `articular` but the format of their exchange.
//
// The same surface gives the same nodes inside and out, but CGAL's removal of slivers may join them
// otherwise in a few tetrahedra of a thousand, from one time to the next.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/mesh/mesher_exchange.hpp"

namespace {

using articular::tools::kMesherSocket;
using articular::tools::MesherReply;
using articular::tools::MesherRequest;
using articular::tools::ReceivedBytes;
using articular::tools::send_list;
using articular::tools::send_value;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Surface>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index,
                                                        Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

constexpr double kLeastFacetAngle = 25;      // [deg]; refinement is sure to end below 30
constexpr double kRadiusToShortestEdge = 2;  // of tetrahedra; likewise above 2
/// CGAL bounds circumradii, and refinement leaves them well below: with this part of the size the
/// mean edge of a mesh comes out as the size (measured on a ball and on menisci and cartilage).
constexpr double kRadiusPerSize = 0.8;

std::string read_to_end(int socket) {
  std::string bytes;
  char block[1 << 16];
  for (ssize_t count = 0; (count = ::read(socket, block, sizeof block)) != 0;) {
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;
    bytes.append(block, static_cast<std::size_t>(count));
  }
  return bytes;
}

Surface make_surface(const std::vector<double>& points, const std::vector<std::int32_t>& corners) {
  Surface surface;
  for (std::size_t i = 0; i + 2 < points.size(); i += 3)
    surface.add_vertex({points[i], points[i + 1], points[i + 2]});
  const auto vertex = [](std::int32_t a) {
    return Surface::Vertex_index(static_cast<Surface::size_type>(a));
  };
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    if (surface.add_face(vertex(corners[i]), vertex(corners[i + 1]), vertex(corners[i + 2])) ==
        Surface::null_face())
      throw std::runtime_error("CGAL doesn't take triangle " + std::to_string(i / 3));
  return surface;
}

/// Pairs of triangles, sorted.
std::vector<std::int32_t> crossings(const Surface& surface) {
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const auto& [a, b] : found) {
    const auto i = static_cast<std::int32_t>(a.idx()), j = static_cast<std::int32_t>(b.idx());
    pairs.emplace_back(std::min(i, j), std::max(i, j));
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::int32_t> flat;
  for (const auto& [i, j] : pairs) flat.insert(flat.end(), {i, j});
  return flat;
}

/// Refinement does not end where sheets of the surface cross at small angles. Meshes of whole
/// surfaces have 2 to 5 nodes an element's volume or its share of the surface.
std::size_t most_nodes(const Surface& surface, double size) {
  constexpr double kMostPerElement = 50;
  const double volume = std::abs(CGAL::Polygon_mesh_processing::volume(surface));
  const double area = CGAL::Polygon_mesh_processing::area(surface);
  return 1000 + static_cast<std::size_t>(kMostPerElement *
                                         (volume / (size * size * size) + area / (size * size)));
}

Complex mesh(const Surface& surface, const MesherRequest& request) {
  using namespace CGAL::parameters;
  Domain domain(surface);
  if (request.sharp_edges_deg > 0) domain.detect_features(request.sharp_edges_deg);
  const double radius = kRadiusPerSize * request.size;
  const Criteria criteria(edge_size = request.size, facet_angle = kLeastFacetAngle,
                          facet_size = radius, facet_distance = request.distance,
                          cell_radius_edge_ratio = kRadiusToShortestEdge, cell_size = radius);
  auto bound = mesh_3_options();
  CGAL::Mesh_error_code code = CGAL::CGAL_MESH_3_NO_ERROR;
  bound.maximal_number_of_vertices = most_nodes(surface, request.size);
  bound.pointer_to_error_code = &code;
  const Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria, manifold(), no_lloyd(),
                                                     no_odt(), perturb(), exude(), bound);
  if (code != CGAL::CGAL_MESH_3_NO_ERROR)
    throw std::runtime_error(
        "it doesn't come to an end: the surface crosses itself, or has sharp "
        "edges where it is folded");
  return complex;
}

bool send_mesh(const Complex& complex) {
  std::unordered_map<Triangulation::Vertex_handle, std::int32_t> numbers;
  std::vector<double> points;
  std::vector<std::int32_t> tets;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
    for (int k = 0; k < 4; ++k) {
      const auto vertex = cell->vertex(k);
      const auto [number, is_new] =
          numbers.emplace(vertex, static_cast<std::int32_t>(numbers.size()));
      if (is_new) {
        const auto& p = complex.triangulation().point(vertex);
        points.insert(points.end(), {p.x(), p.y(), p.z()});
      }
      tets.push_back(number->second);
    }
  return send_value(kMesherSocket, MesherReply::Mesh) && send_list(kMesherSocket, points) &&
         send_list(kMesherSocket, tets);
}

bool answer() {
  const std::string bytes = read_to_end(kMesherSocket);
  ReceivedBytes received(bytes);
  MesherRequest request;
  std::vector<double> points;
  std::vector<std::int32_t> corners;
  if (!received.take(request) || !received.take(points) || !received.take(corners))
    throw std::runtime_error("the surface did not arrive whole");
  const Surface surface = make_surface(points, corners);
  if (request.crossings == 0) {
    const std::vector<std::int32_t> pairs = crossings(surface);
    if (!pairs.empty())
      return send_value(kMesherSocket, MesherReply::Crossings) && send_list(kMesherSocket, pairs);
  }
  return send_mesh(mesh(surface, request));
}

}  // namespace

int main() {
  try {
    return answer() ? 0 : 1;
  } catch (const std::exception& error) {
    const std::string text = error.what();
    const bool sent = send_value(kMesherSocket, MesherReply::Failed) &&
                      send_list(kMesherSocket, std::vector<char>(text.begin(), text.end()));
    return sent ? 0 : 1;
  }
}
