#include "tools/run/override_files.hpp"

#include <fstream>

#include "sim/base/byte_order_mark.hpp"
#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

void append_lines(const std::string& file, std::vector<std::string>& overrides) {
  std::ifstream stream(file);
  if (!stream) throw sim::InputError({file}, "can't be read (from --set @" + file + ")");
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    if (++number == 1) line = sim::without_byte_order_mark(line);
    const std::size_t begin = line.find_first_not_of(" \t\r"), end = line.find_last_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    if (line.find('=') == std::string::npos)
      throw sim::InputError({file, number}, "expected PATH=VALUE, as --set takes it");
    overrides.push_back(line.substr(begin, end - begin + 1));
  }
}

}  // namespace

std::vector<std::string> with_override_files(const std::vector<std::string>& overrides) {
  std::vector<std::string> result;
  for (const std::string& text : overrides) {
    if (text.starts_with('@'))
      append_lines(text.substr(1), result);
    else
      result.push_back(text);
  }
  return result;
}

}  // namespace articular::tools
