#pragma once

namespace CLI {
class App;
}

namespace articular::tools {

/// `articular work DIR [CASE]... [--wait] [--quiet]`.
/// @param[out] exit_code  set when the command ran
void add_work_command(CLI::App& app, int& exit_code);

}  // namespace articular::tools
