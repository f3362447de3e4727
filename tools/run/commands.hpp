#pragma once

namespace CLI {
class App;
}

/// The subcommands that work on scenario files. Each sets exit_code when it ran; errors are thrown.
namespace articular::tools {

void add_run_command(CLI::App& app, int& exit_code);
void add_check_command(CLI::App& app, int& exit_code);
void add_explain_command(CLI::App& app, int& exit_code);

}  // namespace articular::tools
