#include "tests/benchmarks/extremes/extreme.hpp"

namespace articular::benchmarks {

std::vector<Extreme> all_extremes() {
  std::vector<Extreme> all;
  for (const auto& theme :
       {time_steps, materials, densities, dragged_spheres, meshes, squeezes, start_shapes,
        fast_motions, large_loads, overlaps, heaps, long_runs, missing_supports})
    for (Extreme& extreme : theme()) all.push_back(std::move(extreme));
  return all;
}

}  // namespace articular::benchmarks
