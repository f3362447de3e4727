#include "tests/benchmarks/collision/mapping_study.hpp"

#include "collision/article/bucket_tree.hpp"
#include "tests/benchmarks/collision/v_shapes.hpp"
#include "tests/benchmarks/support/csv.hpp"
#include "tests/benchmarks/support/timing.hpp"

namespace articular::benchmarks {
namespace {

using collision::BucketTree;
using collision::CoordinateSort;
using collision::Mapping;

constexpr double kMotions[] = {0.001, 0.01, 0.1, 1};  // in cell edges
constexpr double kApart = -0.3;                       // angle between the legs [rad]
constexpr int kCycles = 5;

BucketTree tree_of(const Mesh& mesh, Mapping mapping) {
  return {mesh.tets, mesh.surface, mesh.X, {.fixed_root = {}, .mapping = mapping}};
}

double seconds_of_update(BucketTree& tree, const Eigen::Matrix3Xd& x) {
  const double start = cpu_seconds();
  tree.update(x);
  return cpu_seconds() - start;
}

void measure(Csv& csv, const VShapes& shapes, double motion) {
  const Mesh& mesh = shapes.bodies()[0];
  const std::vector<Positions> frames = oscillation(shapes, kApart, motion);
  BucketTree direct = tree_of(mesh, Mapping::Direct);
  BucketTree sorting = tree_of(mesh, Mapping::CoordinateSorting);
  direct.update(frames.back()[0]);
  sorting.update(frames.back()[0]);  // sorts what is in no order yet: not what is asked here
  const CoordinateSort before = *sorting.coordinate_sort();
  std::vector<double> direct_times, sorting_times;
  for (int cycle = 0; cycle < kCycles; ++cycle)
    for (const Positions& x : frames) {
      direct_times.push_back(seconds_of_update(direct, x[0]));
      sorting_times.push_back(seconds_of_update(sorting, x[0]));
    }
  const CoordinateSort& after = *sorting.coordinate_sort();
  const double updates = static_cast<double>(direct_times.size());
  const double ends = 6.0 * shapes.num_tets();
  csv.line("%d,%g,%.4f,%.4f,%.3f,%.2f\n", shapes.num_tets(), motion, 1e3 * median(direct_times),
           1e3 * median(sorting_times),
           static_cast<double>(after.num_moves() - before.num_moves()) / (updates * ends),
           static_cast<double>(after.num_fallbacks() - before.num_fallbacks()) / updates);
}

}  // namespace

void mapping_study(const std::filesystem::path& out, std::span<const int> sizes) {
  Csv csv(out / "mapping.csv",
          "tetrahedra,motion_edges,direct_ms,sorting_ms,moves_per_end,general_sorts_per_update");
  for (const int size : sizes) {
    const CrossedVShape shapes(bar_with(size));
    for (const double motion : kMotions) measure(csv, shapes, motion);
  }
}

}  // namespace articular::benchmarks
