#include "tools/collide/collide_frames.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>

#include "sim/base/error.hpp"
#include "sim/base/stopwatch.hpp"

namespace articular::tools {
namespace {

std::int64_t heap_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

/// Adds what the heap grows during its life to a sum [byte].
class HeapGrowth {
 public:
  explicit HeapGrowth(std::int64_t& sum) : sum_(sum), before_(heap_in_use()) {}
  ~HeapGrowth() { sum_ += heap_in_use() - before_; }
  HeapGrowth(const HeapGrowth&) = delete;
  HeapGrowth& operator=(const HeapGrowth&) = delete;

 private:
  std::int64_t& sum_;
  std::int64_t before_;
};

/// @param passes  the same frame in each of them
FrameFigures median_of(std::span<const FrameFigures> passes) {
  const auto median = [&](double FrameFigures::*time) {
    std::vector<double> values;
    for (const FrameFigures& pass : passes) values.push_back(pass.*time);
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  };
  FrameFigures figures = passes[0];
  for (double FrameFigures::*time : {&FrameFigures::update_seconds, &FrameFigures::traverse_seconds,
                                     &FrameFigures::narrow_seconds, &FrameFigures::total_seconds})
    figures.*time = median(time);
  return figures;
}

/// The local node that a face of a tetrahedron does not have.
int local_face(const MeshSeries& body, int face) {
  const auto nodes = body.surface.faces.col(face);
  const int tet = body.surface.face_tet[static_cast<std::size_t>(face)];
  int local = 0;
  while ((nodes.array() == body.tets(local, tet)).any()) ++local;
  return local;
}

std::vector<PairRow> sorted_rows(std::span<const MeshSeries> bodies, std::size_t frame,
                                 const FoundPairs& found) {
  std::vector<PairRow> rows;
  for (std::size_t f = 0; f < bodies.size(); ++f)
    for (std::size_t w = 0; w < bodies.size(); ++w)
      for (const collision::Penetration& pair : found.in[f][w])
        rows.push_back({static_cast<int>(frame), static_cast<int>(f),
                        bodies[f].surface.face_tet[static_cast<std::size_t>(pair.face)],
                        local_face(bodies[f], pair.face), static_cast<int>(w), pair.tetrahedron});
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// One or two bodies in their trees, from frame to frame.
class Searcher {
 public:
  Searcher(std::span<const MeshSeries> bodies, const SearchSettings& search, bool self)
      : bodies_(bodies), self_(self || bodies.size() == 1) {
    const HeapGrowth growth(memory_);
    search_ = make_search(bodies, search);
  }

  /// From new positions to all pairs.
  FrameFigures run(std::size_t frame) {
    const HeapGrowth growth(memory_);
    FrameFigures figures;
    SearchCost cost;
    {
      const sim::Stopwatch total(figures.total_seconds);
      {
        const sim::Stopwatch update(figures.update_seconds);
        update_trees(frame);
      }
      if (bodies_.size() == 2) search_->between(found_, cost);
      for (std::size_t body = 0; self_ && body < bodies_.size(); ++body)
        search_->within(body, found_, cost);
    }
    figures.traverse_seconds = cost.traverse_seconds;
    figures.narrow_seconds = cost.narrow_seconds;
    figures.candidates = cost.candidates;
    for (const auto& of_body : found_.in)
      for (const auto& pairs : of_body) figures.pairs += static_cast<std::int64_t>(pairs.size());
    return figures;
  }

  const FoundPairs& found() const { return found_; }
  std::size_t memory() const {
    return static_cast<std::size_t>(std::max<std::int64_t>(memory_, 0));
  }

 private:
  void update_trees(std::size_t frame) {
    for (std::size_t body = 0; body < bodies_.size(); ++body) {
      if (frame > 0 && !bodies_[body].moves()) continue;
      try {
        search_->update(body, bodies_[body].frame(frame));
      } catch (const std::invalid_argument& error) {
        throw sim::InputError({bodies_[body].file(frame).string()}, error.what());
      }
    }
  }

  std::span<const MeshSeries> bodies_;
  bool self_;
  std::unique_ptr<CollideSearch> search_;
  FoundPairs found_;
  std::int64_t memory_ = 0;
};

}  // namespace

CollideFigures collide_frames(std::span<const MeshSeries> bodies, const SearchSettings& search,
                              const PassSettings& passes) {
  std::vector<std::vector<FrameFigures>> measured(count_frames(bodies));
  CollideFigures figures;
  Searcher searcher(bodies, search, passes.self);
  std::size_t done = 0;
  for (int repetition = 0; repetition < passes.repeat; ++repetition)
    for (std::size_t i = 0; i < measured.size(); ++i) {
      measured[i].push_back(searcher.run(i));
      if (repetition == 0 && passes.take_pairs)
        passes.take_pairs(sorted_rows(bodies, i, searcher.found()));
      if (passes.after_frame && passes.after_frame(++done)) {
        figures.interrupted = true;
        return figures;
      }
    }
  for (const std::vector<FrameFigures>& frame : measured)
    figures.frames.push_back(median_of(frame));
  figures.memory = searcher.memory();
  return figures;
}

std::size_t count_frames(std::span<const MeshSeries> bodies) {
  const std::size_t num_a = bodies[0].frames.size(), num_b = bodies.back().frames.size();
  if (num_a != num_b && bodies[0].moves() && bodies.back().moves())
    throw sim::InputError(fmt::format(
        "{} has {} frames and {} has {}; expected the same number, or one mesh that stands still",
        bodies[0].name, num_a, bodies.back().name, num_b));
  return std::max(num_a, num_b);
}

}  // namespace articular::tools
