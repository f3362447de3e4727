#pragma once

#include <optional>
#include <string>

#include "tools/process/child_process.hpp"

namespace articular::tools {

/// Sees to it that an X display can be drawn on while this object lives: the one that $DISPLAY
/// names if it answers, else an Xvfb of our own, which ends with the object. (VTK's windows need X,
/// also those that are never shown, and VTK ends the program when it finds none.)
class VirtualDisplay {
 public:
  /// @throws SystemError when there is no display and Xvfb is not installed or does not start
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

 private:
  bool started_ = false;
  std::optional<std::string> previous_;  // $DISPLAY before
  ChildProcess xvfb_;
};

}  // namespace articular::tools
