#include "tools/track/track_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "sim/base/atomic_file.hpp"
#include "tools/fit/missed_target.hpp"
#include "tools/process/interruption.hpp"
#include "tools/process/status_line.hpp"
#include "tools/shipped/shipped_scenarios.hpp"
#include "tools/track/track_report.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kMostTrackThreads = 256, kMostTrackIterations = 1000;
/// The scenario could not go on, or a time did not converge: what is written is the best so far.
constexpr int kEndedEarly = 3;

struct TrackArguments {
  fs::path track, directory;
  std::vector<std::string> overrides;  // of the scenario, after those of the track
  TrackOptions options;
  bool quiet = false;
};

std::string progress_text(const TrackResult& result, double duration) {
  const TrackPoint& point = result.points.back();
  Eigen::Index most = 0;
  const double largest = point.excitation.maxCoeff(&most);
  return fmt::format(
      "articular: {:g} s of {:g} s: misfit {:.3g} spreads, {} run{}, most active `{}` {:.3f}{}",
      point.time, duration, point.misfit, point.trials, point.trials == 1 ? "" : "s",
      result.unknowns[static_cast<std::size_t>(most)].name, largest,
      point.converged ? "" : ", not converged");
}

std::string trial_text(double time, int trial, const std::optional<double>& sum) {
  return fmt::format("articular: {:g} s, run {}: ", time, trial) +
         (sum ? fmt::format("sum of squares and effort {:.4g}", *sum)
              : "failed, the next one is nearer to the best so far");
}

void write(const Track& track, const TrackResult& result, const fs::path& directory) {
  const fs::path table = fs::absolute(directory) / "excitations.csv";
  const std::pair<const char*, std::string> files[] = {
      {"track.md", track_text(track, result, directory / "excitations.txt")},
      {"excitations.csv", excitations_csv(result)},
      {"excitations.txt", excitation_overrides(track, table)},
      {"targets.csv", targets_csv(track, result)},
      {"muscles.csv", muscles_csv(result)}};
  for (const auto& [name, text] : files) {
    sim::write_text_file(directory / name, text);
    fmt::print("{}\n", (directory / name).string());
  }
}

int run_track(const TrackArguments& arguments) {
  Track track = read_track(find_file_for("track", arguments.track));
  track.overrides.insert(track.overrides.end(), arguments.overrides.begin(),
                         arguments.overrides.end());
  const fs::path directory =
      arguments.directory.empty() ? fs::path("out") / track.name : arguments.directory;
  TrackOptions options = arguments.options;
  options.warn = [](const std::string& warning) {
    fmt::print(stderr, "articular: warning: {}\n", warning);
  };
  StatusLine status;
  if (!arguments.quiet) {
    options.after_trial = [&](double time, int trial, const std::optional<double>& sum) {
      status.show(trial_text(time, trial, sum));
    };
    options.after_point = [&](const TrackResult& result, double duration) {
      status.show(progress_text(result, duration));
    };
  }
  listen_for_interruption();
  const TrackResult result = track_excitations(track, options);
  status.end();
  if (!result.points.empty()) {
    sim::make_folders(directory);
    write(track, result, directory);
    warn_of_missed(missed_targets(track, result));
  }
  if (result.interrupted) {
    fmt::print(stderr, "articular: interrupted; what is written ends before\n");
    return kInterruptedExitCode;
  }
  if (!result.failure.empty()) throw sim::SimulationError(result.failure);
  for (const TrackPoint& point : result.points)
    if (!point.converged) {
      fmt::print(stderr, "articular: not converged at {:g} s: see track.md\n", point.time);
      return kEndedEarly;
    }
  return 0;
}

const char* const kTrackHelp =
    R"(Finds excitations of muscles from what is known: ways of points, forces of a bite or on a joint,
EMG. TRACK.toml names the scenario, the targets with their spreads, and the muscles with their
bounds. Goes through the scenario once; at each time it tries a few excitations, each from the time
before, and follows how the state changes with them through Newton's matrix. Of excitations that
meet the targets alike it takes the least. Writes DIR/track.md (misfits, which muscles the targets
determine, what another cost would have given), DIR/excitations.csv, DIR/targets.csv,
DIR/muscles.csv, and DIR/excitations.txt for `articular run SCENARIO --set @DIR/excitations.txt`.
Exit code 3: it ended early, or some time did not converge; what is written says where. The format
of TRACK.toml and an example: tools/track/README.md.)";

}  // namespace

void add_track_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<TrackArguments>();
  CLI::App& command =
      *app.add_subcommand("track", "Excitations of muscles, found from motions and forces");
  command
      .add_option("track", arguments->track,
                  "Track file (.toml), or the name of a shipped one: see `articular scenarios`")
      ->required();
  command.add_option("--out", arguments->directory, "Folder of the results (default: out/NAME)")
      ->type_name("DIR");
  command
      .add_option("--set", arguments->overrides,
                  "Override a value of the scenario by its path, as of `articular run`")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  command.add_option("--threads", arguments->options.threads, "As of `articular run` [1]")
      ->check(CLI::Range(1, kMostTrackThreads));
  command
      .add_option("--iterations", arguments->options.most_iterations,
                  "At each time at most so many [10]")
      ->check(CLI::Range(1, kMostTrackIterations));
  command.add_flag("--quiet", arguments->quiet, "No progress on stderr");
  command.footer(kTrackHelp);
  command.callback([arguments, &exit_code] { exit_code = run_track(*arguments); });
}

}  // namespace articular::tools
