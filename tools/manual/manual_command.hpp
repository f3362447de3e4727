#pragma once

namespace CLI {
class App;
}

namespace articular::tools {

/// `articular manual`. It describes all subcommands of the app, those that are added later too.
/// Sets exit_code when it ran; errors are thrown.
void add_manual_command(CLI::App& app, int& exit_code);

}  // namespace articular::tools
