#pragma once

namespace CLI {
class App;
}

namespace articular::tools {

/// `articular scenarios`: what is shipped, a line each.
void add_scenarios_command(CLI::App& app, int& exit_code);

}  // namespace articular::tools
