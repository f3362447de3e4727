#pragma once

#include <string>

namespace articular::tools {

/// What a command is at, on stderr: on a terminal one line that changes, elsewhere lines.
class StatusLine {
 public:
  StatusLine();
  bool is_terminal() const { return is_terminal_; }
  void show(const std::string& text);
  /// What was shown last stays; what comes next begins a line.
  void end();
  /// What was shown last goes, on a terminal.
  void erase();

 private:
  bool is_terminal_, is_open_ = false;
};

}  // namespace articular::tools
