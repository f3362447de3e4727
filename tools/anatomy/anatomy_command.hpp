#pragma once

namespace CLI {
class App;
}

namespace articular::anatomy {

/// `articular anatomy mandible|knee [--size H] --out DIR`.
/// @param[out] exit_code  0; set when the command ran. Errors are thrown
void add_anatomy_command(CLI::App& app, int& exit_code);

}  // namespace articular::anatomy
