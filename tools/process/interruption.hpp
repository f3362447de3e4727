#pragma once

/// Ctrl-C, SIGTERM and a closed terminal (SIGHUP, but for nohup).
namespace articular::tools {

/// Exit code of a program that was asked to end and did: what is there is valid.
inline constexpr int kInterruptedExitCode = 130;

/// From here on any of them ends the program at once, with that exit code: reading, building and
/// printing leave nothing behind that must be put in order.
void end_at_interruption();

/// From here on the first one asks for the end, for commands that end their work in order. Where
/// nobody looks whether it was asked for within 0.6 s, as in a long factorization, or a second one
/// comes, the program ends at once all the same.
void listen_for_interruption();

/// True once the end was asked for; who hears it takes the time that it needs.
bool interruption_asked();

}  // namespace articular::tools
