// Whole collision queries by different programs on the same meshes.
//
//   build/release/bin/collision_peers [--quick]
//
// Two V-shapes pushed through each other and one V-shape whose legs cross, at 10 000, 100 000 and
// 1 000 000 tetrahedra a body (--quick: without the last). A query goes from new node positions to
// the list of pairs (surface triangle, tetrahedron); everybody's candidates get the same narrow
// test. One thread. First all must agree on the pairs; then they take turns. Prints medians of
// processor time, and memory (with the list of candidates, without meshes and result). Peers that
// need libcgal-dev, libembree-dev, libfcl-dev are left out where those are not installed.

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "tests/benchmarks/collision/peer_list.hpp"
#include "tests/benchmarks/collision/v_shapes.hpp"
#include "tests/benchmarks/support/timing.hpp"

namespace {

using namespace articular::benchmarks;

constexpr double kMotion = 0.1;  // of a node from frame to frame at most, in cell edges
constexpr double kBudget = 20;   // for the rounds of one column [s]
constexpr int kLeastRounds = 2;  // each is a whole cycle of frames
constexpr int kMostRounds = 25;

struct Workload {
  const VShapes& shapes;
  std::vector<Positions> frames;
  std::vector<MeshView> views(std::size_t frame) const { return shapes.views(frames[frame]); }
};

struct Column {
  std::string name;
  std::size_t num_pairs = 0;
  std::vector<double> milliseconds, megabytes;  // one a peer
  double narrow_milliseconds = 0;               // of them, in the test that all have in common
};

std::size_t heap_in_use() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// A line that the next one overwrites; only where somebody looks.
void show_progress(const std::string& text) {
  if (isatty(STDERR_FILENO)) std::fprintf(stderr, "\r%-60s\r", text.c_str());
}

Found sorted(Found found) {
  for (std::vector<Penetration>& pairs : found) std::sort(pairs.begin(), pairs.end());
  return found;
}

/// The answers to all frames, which must be those expected if there are any yet.
void check(const std::string& name, Peer& peer, const Workload& w, std::vector<Found>& expected) {
  for (std::size_t frame = 0; frame < w.frames.size(); ++frame) {
    Found found;
    peer.query(w.views(frame), found);
    found = sorted(std::move(found));
    if (frame == expected.size()) expected.push_back(found);
    if (found != expected[frame]) throw std::runtime_error(name + " finds other pairs");
  }
}

/// Makes all peers, each with the memory that a frame takes. They must agree.
std::vector<std::unique_ptr<Peer>> agreeing_peers(const Workload& w, Column& column) {
  std::vector<std::unique_ptr<Peer>> peers;
  std::vector<Found> expected;
  for (const PeerEntry& entry : all_peers()) {
    show_progress(column.name + ", check: " + entry.name);
    const std::size_t heap_before = heap_in_use();
    std::unique_ptr<Peer> peer = entry.make(w.views(0));
    peer->query(w.views(0), *std::make_unique<Found>());
    const std::size_t heap = heap_in_use() - heap_before;
    column.megabytes.push_back(1e-6 * static_cast<double>(peer->bytes().value_or(heap)));
    check(entry.name, *peer, w, expected);
    peers.push_back(std::move(peer));
  }
  column.num_pairs = expected[0][0].size() + expected[0][1].size();
  return peers;
}

/// Rounds in which every peer in turn goes through all frames.
void time_in_turns(const Workload& w, std::vector<std::unique_ptr<Peer>>& peers, Column& column) {
  std::vector<std::vector<double>> samples(peers.size());
  std::vector<double> narrow;
  Found found;
  const double begin = cpu_seconds();
  for (int round = 0;
       round < kMostRounds && (round < kLeastRounds || cpu_seconds() - begin < kBudget); ++round) {
    show_progress(column.name + ", round " + std::to_string(round + 1));
    for (std::size_t p = 0; p < peers.size(); ++p)
      for (std::size_t frame = 0; frame < w.frames.size(); ++frame) {
        const std::vector<MeshView> bodies = w.views(frame);
        const double start = cpu_seconds();
        peers[p]->query(bodies, found);
        samples[p].push_back(1e3 * (cpu_seconds() - start));
        if (p + 1 == peers.size()) narrow.push_back(1e3 * peers[p]->narrow_seconds());
      }
  }
  for (const std::vector<double>& s : samples) column.milliseconds.push_back(median(s));
  column.narrow_milliseconds = median(narrow);
}

Column measure(const std::string& name, const Workload& w) {
  Column column;
  column.name = name;
  std::vector<std::unique_ptr<Peer>> peers = agreeing_peers(w, column);
  time_in_turns(w, peers, column);
  return column;
}

void print_row(const std::string& name, const std::vector<std::string>& cells) {
  std::printf("| %s |", name.c_str());
  for (const std::string& cell : cells) std::printf(" %s |", cell.c_str());
  std::printf("\n");
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 10 ? "%.2f" : value < 100 ? "%.1f" : "%.0f", value);
  return text;
}

template <class CellOf>
void print_row(const std::string& name, const std::vector<Column>& columns, CellOf&& cell_of) {
  std::vector<std::string> cells;
  cells.reserve(columns.size());
  for (const Column& column : columns) cells.push_back(cell_of(column));
  print_row(name, cells);
}

void print_table(const std::vector<Column>& columns) {
  show_progress("");
  print_row("whole query [ms]", columns, [](const Column& c) { return c.name; });
  print_row("---", columns, [](const Column&) { return std::string("---:"); });
  print_row("pairs", columns, [](const Column& c) { return std::to_string(c.num_pairs); });
  const std::vector<PeerEntry> peers = all_peers();
  for (std::size_t p = 0; p < peers.size(); ++p)
    print_row(peers[p].name, columns, [&](const Column& c) { return rounded(c.milliseconds[p]); });
  print_row("of it the narrow test", columns,
            [](const Column& c) { return rounded(c.narrow_milliseconds); });
  std::printf("\n");
  print_row("memory above the meshes [MB]", columns, [](const Column& c) { return c.name; });
  print_row("---", columns, [](const Column&) { return std::string("---:"); });
  for (std::size_t p = 0; p < peers.size(); ++p)
    print_row(peers[p].name, columns, [&](const Column& c) { return rounded(c.megabytes[p]); });
  for (const std::string& package : missing_packages())
    std::printf("\nNot measured: %s is not installed.\n", package.c_str());
}

/// A size and how far apart the shapes are there.
struct Case {
  const char* name;
  int num_tets;
  double two_apart;      // [m]
  double crossed_apart;  // [rad]
};
constexpr Case kCases[] = {
    {"10 k", 10000, 1, -0.5}, {"100 k", 100000, 1.2, -0.5}, {"1 M", 1000000, 1.15, -0.5}};

Column measure(const std::string& name, const VShapes& shapes, double apart) {
  return measure(name, {shapes, oscillation(shapes, apart, kMotion)});
}

void run(std::span<const Case> cases) {
  std::vector<Column> columns;
  for (const Case& c : cases)
    columns.push_back(measure(std::string("V through V, ") + c.name,
                              TwoVShapes(bar_with(c.num_tets)), c.two_apart));
  for (const Case& c : cases)
    columns.push_back(measure(std::string("V itself, ") + c.name,
                              CrossedVShape(bar_with(c.num_tets)), c.crossed_apart));
  print_table(columns);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc == 2 && std::strcmp(argv[1], "--quick") == 0;
  if (argc > 1 && !quick) {
    std::fprintf(stderr, "usage: collision_peers [--quick]\n");
    return 2;
  }
  try {
    run(std::span(kCases).first(quick ? 2 : 3));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "collision_peers: %s\n", error.what());
    return 1;
  }
}
