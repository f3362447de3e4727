// The measurements of Fig. 1.5.4-1.5.7 and of the coordinate sorting.
//
//   build/release/bin/collision_study OUT [--quick]
//
// writes two tables into the folder OUT: queries.csv, the time of a query against the number of
// tetrahedra while the number of intersections stays in the band of the article, and against the
// number of intersections in one mesh, for two V-shapes and for one that intersects itself; and
// mapping.csv, the time of an update with direct mapping and with coordinate sorting.
// tools/figures/collision-figures makes the figures of them. Methods take turns and must find
// equally many pairs; medians of processor time, one thread.

#include <cstdio>
#include <cstring>
#include <exception>

#include "tests/benchmarks/collision/mapping_study.hpp"
#include "tests/benchmarks/collision/query_study.hpp"

namespace {

using namespace articular::benchmarks;

struct Extent {
  std::vector<int> sizes;  // tetrahedra a body, Fig. 1.5.4 and 1.5.6
  int num_points;          // along the path, Fig. 1.5.5 and 1.5.7
  int large;               // mesh in which those are repeated
  std::vector<int> mapping_sizes;
};

const Extent kFull{{600, 1000, 1500, 2000, 3000, 4000, 5000, 6000, 7000, 8000, 10000, 12000, 15000,
                    20000, 50000, 100000, 200000, 500000, 1000000},
                   25,
                   100000,
                   {1000, 10000, 100000, 1000000}};
const Extent kQuick{{1000, 3000, 6000, 10000}, 7, 10000, {1000, 10000}};

// The article: "800-1200 intersections", "3200-4800", meshes of "600-1400 tetrahedra".
constexpr Band kTwoFew{"two_1000", 800, 1200};
constexpr Band kTwoMany{"two_4000", 3200, 4800};
constexpr Band kSelfFew{"self_1000", 800, 1200};
constexpr int kSmall = 1000;

void run(const std::filesystem::path& out, const Extent& extent) {
  std::filesystem::create_directories(out);
  QueryStudy queries(out);
  for (const int size : extent.sizes) {
    const TwoVShapes two(bar_with(size));
    queries.measure_in_band(kTwoFew, two);
    queries.measure_in_band(kTwoMany, two);
    queries.measure_in_band(kSelfFew, CrossedVShape(bar_with(size)));
  }
  queries.measure_along_path("two_small", TwoVShapes(bar_with(kSmall)), extent.num_points);
  queries.measure_along_path("self_small", CrossedVShape(bar_with(kSmall)), extent.num_points);
  queries.measure_along_path("two_large", TwoVShapes(bar_with(extent.large)), extent.num_points);
  queries.measure_along_path("self_large", CrossedVShape(bar_with(extent.large)),
                             extent.num_points);
  mapping_study(out, extent.mapping_sizes);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc == 3 && std::strcmp(argv[2], "--quick") == 0;
  if (argc < 2 || argv[1][0] == '-' || (argc > 2 && !quick)) {
    std::fprintf(stderr, "usage: collision_study OUT [--quick]\n");
    return 2;
  }
  try {
    run(argv[1], quick ? kQuick : kFull);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "collision_study: %s\n", error.what());
    return 1;
  }
}
