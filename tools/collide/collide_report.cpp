#include "tools/collide/collide_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

namespace articular::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongSeries = 25;  // from here on a summary in place of a table

std::string milliseconds(double seconds) { return fmt::format("{:.3f} ms", 1e3 * seconds); }

std::string frame_table(std::span<const FrameFigures> frames) {
  std::string text = fmt::format("{:>5} {:>12} {:>12} {:>12} {:>12} {:>11} {:>9}\n", "frame",
                                 "update", "traverse", "narrow", "total", "candidates", "pairs");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameFigures& f = frames[i];
    text += fmt::format("{:>5} {:>12} {:>12} {:>12} {:>12} {:>11} {:>9}\n", i,
                        milliseconds(f.update_seconds), milliseconds(f.traverse_seconds),
                        milliseconds(f.narrow_seconds), milliseconds(f.total_seconds), f.candidates,
                        f.pairs);
  }
  return text;
}

/// "mean 0.100 ms, longest 0.200 ms (frame 7)"
std::string time_summary(std::span<const FrameFigures> frames, double FrameFigures::*time) {
  double sum = 0;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    sum += frames[i].*time;
    if (frames[i].*time > frames[longest].*time) longest = i;
  }
  return fmt::format("mean {}, longest {} (frame {})",
                     milliseconds(sum / static_cast<double>(frames.size())),
                     milliseconds(frames[longest].*time), longest);
}

std::string pair_summary(std::span<const FrameFigures> frames) {
  std::size_t first = frames.size(), last = 0, most = 0, num = 0;
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].pairs == 0) continue;
    first = std::min(first, i);
    last = i;
    ++num;
    sum += frames[i].pairs;
    if (frames[i].pairs > frames[most].pairs) most = i;
  }
  if (num == 0) return "none in any frame";
  return fmt::format("{} in {} of {} frames, first in frame {}, last in {}, most in {}: {}", sum,
                     num, frames.size(), first, last, most, frames[most].pairs);
}

std::string summary(std::span<const FrameFigures> frames) {
  return fmt::format("pairs     {}\nupdate    {}\ntraverse  {}\nnarrow    {}\ntotal     {}\n",
                     pair_summary(frames), time_summary(frames, &FrameFigures::update_seconds),
                     time_summary(frames, &FrameFigures::traverse_seconds),
                     time_summary(frames, &FrameFigures::narrow_seconds),
                     time_summary(frames, &FrameFigures::total_seconds));
}

}  // namespace

std::string to_json(std::span<const MeshSeries> bodies, const CollideFigures& figures) {
  Json json = {{"bodies", Json::array()}, {"frames", Json::array()}};
  for (const MeshSeries& body : bodies)
    json["bodies"].push_back(
        {{"tetrahedra", body.tets.cols()}, {"surface_triangles", body.surface.faces.cols()}});
  for (std::size_t i = 0; i < figures.frames.size(); ++i) {
    const FrameFigures& f = figures.frames[i];
    json["frames"].push_back({{"frame", i},
                              {"update_s", f.update_seconds},
                              {"traverse_s", f.traverse_seconds},
                              {"narrow_s", f.narrow_seconds},
                              {"total_s", f.total_seconds},
                              {"candidates", f.candidates},
                              {"pairs", f.pairs}});
  }
  json["memory_bytes"] = figures.memory;
  return json.dump(2) + "\n";
}

std::string to_text(std::span<const MeshSeries> bodies, const CollideFigures& figures) {
  std::string text;
  for (std::size_t body = 0; body < bodies.size(); ++body)
    text +=
        fmt::format("body {}: {}: {} tetrahedra, {} surface triangles, {} frame{}\n", body,
                    bodies[body].name, bodies[body].tets.cols(), bodies[body].surface.faces.cols(),
                    bodies[body].frames.size(), bodies[body].moves() ? "s" : "");
  const bool table = figures.frames.size() < kLongSeries;
  return text + "\n" + (table ? frame_table(figures.frames) : summary(figures.frames));
}

void PairTable::add(std::span<const PairRow> rows) {
  for (const PairRow& row : rows)
    fmt::format_to(std::back_inserter(csv_), "{},{},{},{},{},{}\n", row.frame, row.triangle_body,
                   row.triangle_tet, row.triangle_face, row.tet_body, row.tet);
}

}  // namespace articular::tools
