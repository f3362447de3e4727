#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/base/error.hpp"

namespace articular::sim {

/// Words of a text, of formats in which lines mean little: numbers may stand on one line or on
/// many.
class WordReader {
 public:
  /// @param comment  what begins a comment to the end of its line, or 0
  WordReader(std::string file, std::string_view text, char comment = 0)
      : where_{std::move(file), 1}, text_(text), comment_(comment) {}

  bool at_end();

  /// @param expected  "a node's number", for messages
  /// @throws InputError where the text ends
  std::string_view word(const char* expected);
  std::int64_t integer(const char* expected);
  double number(const char* expected);

  /// What is left of the line.
  std::string_view rest_of_line();

  /// How many bytes were read, and to go on after some more of them that are no words.
  std::size_t position() const { return at_; }
  void skip_to(std::size_t position);

  /// Of the last word.
  const Location& where() const { return where_; }

 private:
  void skip_blanks();

  /// A word for a message. Before its first number a file may be anything, and nothing of it is
  /// shown.
  std::string found(std::string_view text) const;

  Location where_;
  std::string_view text_;
  std::size_t at_ = 0;
  char comment_;
  bool has_number_ = false;
};

}  // namespace articular::sim
