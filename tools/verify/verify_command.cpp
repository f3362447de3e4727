#include "tools/verify/verify_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>

#include "sim/base/error.hpp"
#include "tools/process/interruption.hpp"
#include "tools/process/status_line.hpp"
#include "tools/verify/problems.hpp"
#include "tools/verify/verify_report.hpp"

namespace articular::tools {
namespace {

struct VerifyArguments {
  std::string only;
  bool quick = false, json = false, quiet = false;
};

/// To stdout at once. @throws sim::SystemError  so that a closed pipe leaves no temporary folder
void put(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw sim::SystemError("stdout can't be written");
}

int verify_here(const VerifyArguments& arguments) {
  const std::vector<Problem> problems = chosen(all_problems(), arguments.only, arguments.quick);
  const sim::Provenance by = sim::provenance();
  StatusLine status;
  VerifyWatch watch;
  watch.is_to_stop = interruption_asked;
  watch.before = [&](const std::string& problem, std::size_t number) {
    if (!arguments.quiet)
      status.show(fmt::format("{} of {}: {}", number + 1, problems.size(), problem));
  };
  watch.after = [&](const Outcome& outcome) {
    status.erase();
    if (!arguments.json) put(table_rows(outcome));
  };
  if (!arguments.json) put(table_head(by));
  try {
    const std::vector<Outcome> outcomes = verify(problems, watch);
    put(arguments.json ? outcomes_json(by, outcomes) : table_end(outcomes));
    return exit_code_of(outcomes);
  } catch (const sim::Interruption&) {
    status.erase();
    fmt::print(stderr, "articular: interrupted; problems without a row were not solved\n");
    return kInterruptedExitCode;
  }
}

const char* const kVerifyHelp =
    R"(Solves problems whose answers are known, with this program on this machine: material laws, patch
tests, cantilevers, torsion, contact, friction, oscillations, momentum, muscles, ligaments. It also
resumes a run and repeats others on more threads, which must leave the same bits. Takes about three
minutes on two cores, needs no other file, and leaves none. Stdout has a table: expected, got, their
relative deviation and its tolerance. Exit code 0: all passed; 1: one failed.)";

}  // namespace

void add_verify_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<VerifyArguments>();
  CLI::App& command = *app.add_subcommand(
      "verify", "Solve problems with known answers on this machine, and compare");
  command
      .add_option("--only", arguments->only,
                  "Problems whose names have this in them, e.g. law, friction/, 'cantilever/*'")
      ->type_name("PATTERN");
  command.add_flag("--quick", arguments->quick, "Only problems that take a second or two each");
  command.add_flag("--json", arguments->json, "Machine-readable, at the end");
  command.add_flag("--quiet", arguments->quiet, "No progress on stderr");
  command.footer(kVerifyHelp);
  command.callback([arguments, &exit_code] {
    listen_for_interruption();
    std::signal(SIGPIPE, SIG_IGN);  // the write that it is about fails and says so
    exit_code = verify_here(*arguments);
  });
}

}  // namespace articular::tools
