#include "tools/render/run_summary.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

namespace articular::tools {
namespace {

using nlohmann::json;

/// The value under these keys, or null.
json value_at(const json& root, std::initializer_list<const char*> keys) {
  json value = root;
  for (const char* const key : keys) {
    if (!value.is_object() || !value.contains(key)) return nullptr;
    value = json(value.at(key));
  }
  return value;
}

}  // namespace

RunSummary read_run_summary(const std::filesystem::path& folder) {
  std::ifstream in(folder / "summary.json");
  const json summary = json::parse(in, nullptr, false);
  RunSummary result;
  if (const json title = value_at(summary, {"settings", "title"}); title.is_string())
    result.title = title.get<std::string>();
  if (value_at(summary, {"settings", "analysis"}) == "static")
    if (const json time = value_at(summary, {"settings", "duration_s"}); time.is_number())
      result.whole_load = time.get<double>();
  const json directions = value_at(summary, {"settings", "output", "directions"});
  if (directions.is_array() && directions.size() == result.directions.size())
    for (std::size_t k = 0; k < directions.size(); ++k)
      if (directions[k].is_string()) result.directions[k] = directions[k].get<std::string>();
  return result;
}

}  // namespace articular::tools
