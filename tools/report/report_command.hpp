#pragma once

namespace CLI {
class App;
}

namespace articular::tools {

/// `articular report DIR|SCENARIO`.
void add_report_command(CLI::App& app, int& exit_code);

}  // namespace articular::tools
