#pragma once

#include <string>

#include "sim/base/error.hpp"

namespace articular::sim {

/// Collects what is wrong with the parts of an input, so that a user is told of all at once.
class Mistakes {
 public:
  /// Reads a part; an InputError is kept for tell().
  template <class Read>
  void in(Read&& read) {
    try {
      read();
    } catch (const InputError& error) {
      lines_ += (lines_.empty() ? "" : "\n") + std::string(error.what());
    }
  }

  /// @throws InputError with a line for each that was kept, if any was
  void tell() const {
    if (!lines_.empty()) throw InputError(lines_);
  }

 private:
  std::string lines_;
};

/// Reads each item; then tells of all that are wrong. @throws InputError
template <class Items, class Read>
void read_each(const Items& items, Read&& read) {
  Mistakes mistakes;
  for (const auto& item : items) mistakes.in([&] { read(item); });
  mistakes.tell();
}

}  // namespace articular::sim
