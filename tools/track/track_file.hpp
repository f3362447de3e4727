#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/key_table.hpp"
#include "sim/scenario/scenario.hpp"

/// TRACK.toml: a scenario, what is known of its motion and forces, and whose excitations are
/// sought. tools/track/README.md has the format.
namespace articular::tools {

/// What counts as the least activation, of those that meet the targets equally well.
enum class TrackCost { Squares, Cubes, Largest };

/// A column of history.csv, or a sum of some, and what it should be.
struct TrackTarget {
  std::string name;
  std::vector<std::string> columns;  // of one unit
  sim::Curve value;                  // in that unit. It counts from its first to its last time;
                                     // with one time always
  double spread = 1;                 // in the same unit, > 0: a misfit of that much counts 1
  sim::Location where;
};

/// Muscles whose excitation is sought, and what is known of it.
struct TrackMuscle {
  std::string name;       // of one, or a pattern with `*`
  bool together = false;  // all that fit have one excitation
  double lowest = 0, highest = 1;
  sim::Curve emg;         // excitation as measured; empty: not measured
  double emg_spread = 1;  // > 0
  sim::Location where;
};

struct Track {
  std::filesystem::path file, scenario;
  std::string name, title;             // name: the file's, without its ending
  std::vector<std::string> overrides;  // PATH=VALUE of the scenario
  std::optional<double> duration;      // [s]; none: the scenario's
  std::optional<double> interval;      // [s] excitations are linear between its multiples
  std::optional<double> look_ahead;    // [s] dynamic: targets up to so far ahead count
  TrackCost cost = TrackCost::Squares;
  double effort = 0;  // what a muscle at full activation costs, in squared spreads
  std::vector<TrackMuscle> muscles;
  std::vector<TrackTarget> targets;
};

/// The keys of a track file.
const sim::KeyTable& track_keys();

/// @throws sim::InputError  with file, line and column
Track read_track(const std::filesystem::path& file);

}  // namespace articular::tools
