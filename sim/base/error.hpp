#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace articular::sim {

/// Where in a text file something stands; line and column count from 1, 0 = unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column: " as far as known, or "".
inline std::string prefix(const Location& where) {
  std::string text = where.file;
  if (text.empty()) return text;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  return text + ": ";
}

/// Bad input by the user (scenario, mesh, arguments): exit code 2. what() is one line for each
/// mistake, enough by itself: file:line:column, what is wrong, what was expected.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const Location& where, const std::string& message)
      : std::runtime_error(prefix(where) + message) {}
};

/// The system failed us (disk full, folder not writable, no display): exit code 4.
class SystemError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The simulation cannot go on (no step size makes it): exit code 3. Files written so far are
/// valid.
class SimulationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Somebody asked to stop in the middle of a step. No error: thrown through the solvers to where
/// the run ends in good order, with what was written valid.
class Interruption : public std::exception {};

}  // namespace articular::sim
