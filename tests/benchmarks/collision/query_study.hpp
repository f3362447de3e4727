#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tests/benchmarks/collision/peer.hpp"
#include "tests/benchmarks/collision/v_shapes.hpp"
#include "tests/benchmarks/support/csv.hpp"

namespace articular::benchmarks {

/// A number of intersections that the article keeps to while the mesh grows.
struct Band {
  const char* series;  // for the table
  double least, most;
};

/// Time of the whole query, by the article's method and ours (Fig. 1.5.4-1.5.7). Table:
/// series, method, tetrahedra of a body, pairs, milliseconds of a query.
class QueryStudy {
 public:
  explicit QueryStudy(const std::filesystem::path& out);

  /// Against size: one point where the number of pairs is in the band, or none where the mesh is
  /// too coarse for that.
  void measure_in_band(const Band& band, const VShapes& shapes);

  /// Against number of pairs: one mesh, num_points places from apart to deepest.
  void measure_along_path(const char* series, const VShapes& shapes, int num_points);

 private:
  struct Method {
    std::string name;
    std::function<std::unique_ptr<Peer>(std::span<const MeshView>)> make;
    double longest_query = 0;  // [s]
  };

  void measure(const char* series, const VShapes& shapes, double apart);

  Csv csv_;
  std::vector<Method> methods_;
};

}  // namespace articular::benchmarks
