#include "sim/scenario/data_path.hpp"

#include <cstdlib>

#include "sim/scenario/toml_reader.hpp"

namespace articular::sim {
namespace {

std::string variable(const Node& node, const std::string& name) {
  if (name.empty()) fail(node, "expected the name of an environment variable in `${}`");
  const char* value = std::getenv(name.c_str());
  if (value != nullptr && *value != '\0') return value;
  fail(node,
       fmt::format(
           "${{{0}}} is not set in the environment; set {0} to the folder that holds the data",
           one_line(name)));
}

}  // namespace

std::filesystem::path read_path(const Node& node, const std::filesystem::path& folder) {
  const std::string written = read_text(node);
  std::string text;
  std::size_t done = 0;
  for (std::size_t start; (start = written.find("${", done)) != std::string::npos;) {
    const std::size_t end = written.find('}', start);
    if (end == std::string::npos) fail(node, "`}` is missing after `${` in " + in_quotes(written));
    const std::string value = variable(node, written.substr(start + 2, end - start - 2));
    text += written.substr(done, start - done);
    text += start == 0 ? std::filesystem::absolute(value).string() : value;
    done = end + 1;
  }
  text += written.substr(done);
  return (folder / text).lexically_normal();
}

}  // namespace articular::sim
