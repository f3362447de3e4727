#pragma once

namespace CLI {
class App;
}

namespace articular::tools {

/// Adds `plot` to the program; when it is chosen, exit_code becomes what plot() returns.
void add_plot_command(CLI::App& app, int& exit_code);

}  // namespace articular::tools
