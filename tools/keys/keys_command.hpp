#pragma once

namespace CLI {
class App;
}

namespace articular::tools {

/// `articular keys`: what scenario and study files may say.
void add_keys_command(CLI::App& app, int& exit_code);

}  // namespace articular::tools
