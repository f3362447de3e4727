#include "tests/benchmarks/collision/query_study.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "tests/benchmarks/support/timing.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kMotion = 0.05;  // of a node from frame to frame at most, in cell edges
constexpr int kLeastRounds = 3;   // each is a whole cycle of frames; the first one does not count
constexpr int kMostRounds = 8;
constexpr double kBudget = 1.2;       // for the rounds of one point [s]
constexpr double kLongestQuery = 20;  // who takes longer is left out of what follows [s]
constexpr int kMostHalvings = 40;     // of the path, to find a place

std::size_t num_pairs(const Found& found) { return found[0].size() + found[1].size(); }

/// Where the number of pairs is in the middle fifth of the band: motion does not leave the band,
/// and the points do not scatter by what they report.
std::optional<double> find_place(const VShapes& shapes, const Band& band) {
  const double margin = 0.4 * (band.most - band.least);
  double deep = shapes.deepest(), apart = shapes.separate();
  std::unique_ptr<Peer> counter = with_narrow_test(spatial_hash());
  Found found;
  for (int i = 0; i < kMostHalvings; ++i) {
    const double middle = 0.5 * (deep + apart);
    const Positions x = shapes.at(middle);
    counter->query(shapes.views(x), found);
    const double pairs = static_cast<double>(num_pairs(found));
    if (pairs >= band.least + margin && pairs <= band.most - margin) return middle;
    (pairs < band.least + margin ? apart : deep) = middle;
  }
  return {};
}

struct Samples {
  std::unique_ptr<Peer> peer;
  std::vector<double> seconds;  // of each query
  std::vector<Found> found;     // of each frame
};

void run_cycle(Samples& samples, const VShapes& shapes, const std::vector<Positions>& frames) {
  samples.found.resize(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::vector<MeshView> bodies = shapes.views(frames[i]);
    const double start = cpu_seconds();
    samples.peer->query(bodies, samples.found[i]);
    samples.seconds.push_back(cpu_seconds() - start);
  }
}

/// All methods in turns.
void run_rounds(std::vector<Samples>& all, const VShapes& shapes,
                const std::vector<Positions>& frames) {
  const double begin = cpu_seconds();
  for (int round = 0;
       round < kLeastRounds || (round < kMostRounds && cpu_seconds() - begin < kBudget); ++round)
    for (Samples& samples : all) {
      run_cycle(samples, shapes, frames);
      if (round == 0) samples.seconds.clear();
    }
}

double mean_num_pairs(const std::vector<Found>& frames) {
  double sum = 0;
  for (const Found& found : frames) sum += static_cast<double>(num_pairs(found));
  return sum / static_cast<double>(frames.size());
}

}  // namespace

QueryStudy::QueryStudy(const std::filesystem::path& out)
    : csv_(out / "queries.csv", "series,method,tetrahedra,pairs,query_ms") {
  methods_.push_back({"article", [](std::span<const MeshView>) {
                        return with_narrow_test(bucket_tree(), gjk_test);
                      }});
  methods_.push_back({"blocks", block_tree_peer});
}

void QueryStudy::measure_in_band(const Band& band, const VShapes& shapes) {
  if (const std::optional<double> apart = find_place(shapes, band))
    measure(band.series, shapes, *apart);
}

void QueryStudy::measure_along_path(const char* series, const VShapes& shapes, int num_points) {
  for (int i = 0; i < num_points; ++i) {
    const double way = static_cast<double>(i) / (num_points - 1);
    measure(series, shapes, shapes.separate() + way * (shapes.deepest() - shapes.separate()));
  }
}

void QueryStudy::measure(const char* series, const VShapes& shapes, double apart) {
  const std::vector<Positions> frames = oscillation(shapes, apart, kMotion);
  std::vector<Samples> all;
  std::vector<Method*> measured;
  for (Method& method : methods_) {
    if (method.longest_query > kLongestQuery) continue;
    measured.push_back(&method);
    all.push_back({method.make(shapes.views(frames[0])), {}, {}});
  }
  run_rounds(all, shapes, frames);
  const double pairs = mean_num_pairs(all[0].found);
  for (std::size_t m = 0; m < all.size(); ++m) {
    if (mean_num_pairs(all[m].found) != pairs)
      throw std::runtime_error(measured[m]->name + " finds another number of pairs");
    measured[m]->longest_query = std::ranges::max(all[m].seconds);
    csv_.line("%s,%s,%d,%.0f,%.4f\n", series, measured[m]->name.c_str(), shapes.num_tets(), pairs,
              1e3 * median(all[m].seconds));
  }
}

}  // namespace articular::benchmarks
