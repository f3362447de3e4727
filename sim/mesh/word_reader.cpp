#include "sim/mesh/word_reader.hpp"

#include <algorithm>

#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/white_space.hpp"

namespace articular::sim {

bool WordReader::at_end() {
  skip_blanks();
  return at_ == text_.size();
}

std::string_view WordReader::word(const char* expected) {
  if (at_end()) throw InputError(where_, std::string("the file ends; expected ") + expected);
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

std::int64_t WordReader::integer(const char* expected) {
  const std::string_view text = word(expected);
  const std::optional<std::int64_t> value = parse_long(text);
  if (!value) throw InputError(where_, found(text) + " is not " + expected);
  has_number_ = true;
  return *value;
}

double WordReader::number(const char* expected) {
  const std::string_view text = word(expected);
  const std::optional<double> value = parse_number(text);
  if (!value)
    throw InputError(where_, found(text) + " is not a finite number: expected " + expected);
  has_number_ = true;
  return *value;
}

std::string WordReader::found(std::string_view text) const {
  return has_number_ ? in_ticks(text) : "the first word";
}

std::string_view WordReader::rest_of_line() {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  const std::string_view rest = text_.substr(at_, end - at_);
  at_ = end;
  return trimmed(rest);
}

void WordReader::skip_to(std::size_t position) {
  where_.line +=
      static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                  text_.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
  at_ = position;
}

void WordReader::skip_blanks() {
  while (at_ < text_.size()) {
    if (comment_ != 0 && text_[at_] == comment_)
      at_ = std::min(text_.find('\n', at_), text_.size());
    else if (!is_space(text_[at_]))
      return;
    else if (text_[at_++] == '\n')
      ++where_.line;
  }
}

}  // namespace articular::sim
