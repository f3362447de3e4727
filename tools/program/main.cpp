// The `articular` program: one subcommand a file. Exit codes: 0 done; 1 a bug of ours; 2 bad input;
// 3 the simulation could not go on; 4 the system failed; 130 interrupted.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/base/version.hpp"
#include "tools/anatomy/anatomy_command.hpp"
#include "tools/collide/collide_command.hpp"
#include "tools/engine/work_command.hpp"
#include "tools/fit/fit_command.hpp"
#include "tools/import/import_command.hpp"
#include "tools/keys/keys_command.hpp"
#include "tools/manual/manual_command.hpp"
#include "tools/mesh/mesh_command.hpp"
#include "tools/plot/plot_command.hpp"
#include "tools/process/interruption.hpp"
#include "tools/process/source_excerpt.hpp"
#include "tools/process/standard_streams.hpp"
#include "tools/render/render_command.hpp"
#include "tools/report/report_command.hpp"
#include "tools/run/commands.hpp"
#include "tools/shipped/scenarios_command.hpp"
#include "tools/study/study_command.hpp"
#include "tools/track/track_command.hpp"
#include "tools/verify/verify_command.hpp"

namespace {

constexpr int kBug = 1, kBadInput = 2, kCannotGoOn = 3, kSystemFailed = 4;

/// A line for each mistake; on a terminal with the line of the file that it points at.
int report(const char* message, int exit_code) {
  std::istringstream lines(message);
  const bool is_terminal = isatty(STDERR_FILENO) != 0;
  for (std::string line; std::getline(lines, line);) {
    std::fprintf(stderr, "articular: %s\n", articular::sim::one_line(line).c_str());
    if (is_terminal) std::fputs(articular::tools::source_excerpt(line).c_str(), stderr);
  }
  return exit_code;
}

/// A first word that is no subcommand: CLI11 only says that one is missing.
std::string unknown_subcommand(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "";
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands({}))
    names.push_back(subcommand->get_name());
  const std::string word = articular::sim::one_line(argv[1]);
  if (std::find(names.begin(), names.end(), word) != names.end()) return "";
  return "no subcommand `" + word + "`" + articular::sim::suggestion(word, names);
}

int run_program(int argc, char** argv) {
  CLI::App app(
      "articular simulates the soft tissue of jaw and knee: tetrahedral tissues and rigid bones\n"
      "moved by muscles and kept apart by contact. A scenario file goes in; frames for ParaView,\n"
      "a table of probes and a summary come out.",
      "articular");
  app.set_version_flag("--version", articular::sim::kVersion);
  app.require_subcommand(1);
  app.footer(
      "Try: articular run mandible/opening --out out/opening\n"
      "     articular render out/opening\n"
      "     articular plot out/opening\n"
      "     articular report out/opening\n"
      "Exit codes: 0 done, 2 bad input, 3 the simulation could not go on (results until then are\n"
      "valid), 4 the system failed (disk, display), 130 interrupted, 1 a bug in articular.");
  int exit_code = 0;
  articular::tools::add_run_command(app, exit_code);
  articular::tools::add_scenarios_command(app, exit_code);
  articular::tools::add_keys_command(app, exit_code);
  articular::tools::add_check_command(app, exit_code);
  articular::tools::add_explain_command(app, exit_code);
  articular::tools::add_render_command(app, exit_code);
  articular::tools::add_plot_command(app, exit_code);
  articular::tools::add_report_command(app, exit_code);
  articular::tools::add_study_command(app, exit_code);
  articular::tools::add_work_command(app, exit_code);
  articular::tools::add_fit_command(app, exit_code);
  articular::tools::add_track_command(app, exit_code);
  articular::tools::add_verify_command(app, exit_code);
  articular::tools::add_collide_command(app, exit_code);
  articular::tools::add_mesh_command(app, exit_code);
  articular::anatomy::add_anatomy_command(app, exit_code);
  articular::tools::add_import_command(app, exit_code);
  articular::tools::add_manual_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    const std::string unknown = unknown_subcommand(app, argc, argv);
    std::fprintf(stderr, "articular: %s (see --help)\n",
                 unknown.empty() ? error.what() : unknown.c_str());
    return kBadInput;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace articular::tools;
  try {
    open_closed_streams();
    end_at_interruption();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large: the write fails and says why
    const int exit_code = run_program(argc, argv);
    if (exit_code == 0) flush_streams();
    return exit_code;
  } catch (const articular::sim::InputError& error) {
    return report(error.what(), kBadInput);
  } catch (const articular::sim::SimulationError& error) {
    return report(error.what(), kCannotGoOn);
  } catch (const articular::sim::SystemError& error) {
    return report(error.what(), kSystemFailed);
  } catch (const std::bad_alloc&) {
    return report("out of memory", kSystemFailed);
  } catch (const std::exception& error) {
    if (is_text_lost()) return report("standard output or error can't be written", kSystemFailed);
    std::fprintf(stderr, "articular: internal error: %s (please report this)\n", error.what());
    return kBug;
  }
}
