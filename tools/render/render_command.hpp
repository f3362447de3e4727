#pragma once

namespace CLI {
class App;
}

namespace articular::tools {

/// Adds `render` to the program; when it is chosen, exit_code becomes what render() returns.
void add_render_command(CLI::App& app, int& exit_code);

}  // namespace articular::tools
