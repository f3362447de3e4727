#pragma once

/// Ctrl-C, SIGTERM and a closed terminal for commands that end their work in order.
namespace articular::tools {

/// Exit code of a command that was asked to end and did: what is there is valid.
inline constexpr int kInterruptedExitCode = 130;

/// From here on the first SIGINT, SIGTERM or SIGHUP asks for the end, a second one ends the program
/// at once.
void listen_for_interruption();

/// True once the end was asked for.
bool interruption_asked();

}  // namespace articular::tools
