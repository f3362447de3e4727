#pragma once

namespace CLI {
class App;
}

namespace articular::tools {

/// `articular track`. Sets exit_code when it ran; errors are thrown.
void add_track_command(CLI::App& app, int& exit_code);

}  // namespace articular::tools
