#include "tools/engine/task.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace articular::tools {
namespace {

using Json = nlohmann::ordered_json;
using End = ProgramUse::End;

constexpr std::array kEndWords = {"exited", "signalled", "time limit", "interrupted", "lost"};

std::string written(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<End> end_of(const std::string& word) {
  const auto* const found = std::find(kEndWords.begin(), kEndWords.end(), word);
  if (found == kEndWords.end()) return {};
  return static_cast<End>(found - kEndWords.begin());
}

}  // namespace

ProgramUse run_task(const Task& task, const std::function<bool()>& interrupted) {
  ProgramUse all;
  for (const std::vector<std::string>& command : task.commands) {
    std::optional<double> left = task.time_limit;
    if (left) left = std::max(0.0, *left - all.wall_seconds);
    const ProgramUse use = run_measured(command, task.environment, task.log, left, interrupted);
    all.end = use.end;
    all.code = use.code;
    all.wall_seconds += use.wall_seconds;
    all.cpu_seconds += use.cpu_seconds;
    all.peak_megabytes = std::max(all.peak_megabytes, use.peak_megabytes);
    if (use.end != End::Exited || use.code != 0) break;
  }
  return all;
}

std::string task_text(const Task& task) {
  Json json = {{"name", task.name},         {"key", task.key},
               {"commands", task.commands}, {"environment", task.environment},
               {"log", task.log.string()},  {"time_limit_s", nullptr}};
  if (task.time_limit) json["time_limit_s"] = *task.time_limit;
  return written(json);
}

std::optional<Task> read_task(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  try {
    Task task{json.at("name"), json.at("key"), json.at("commands"), json.at("environment"), "", {}};
    task.log = json.at("log").get<std::string>();
    if (!json.at("time_limit_s").is_null()) task.time_limit = json.at("time_limit_s").get<double>();
    const bool is_whole =
        !task.commands.empty() && std::none_of(task.commands.begin(), task.commands.end(),
                                               [](const auto& words) { return words.empty(); });
    if (is_whole) return task;
  } catch (const Json::exception&) {
  }
  return {};
}

std::string end_text(const TaskEnd& end) {
  return written({{"key", end.key},
                  {"end", kEndWords[static_cast<std::size_t>(end.use.end)]},
                  {"code", end.use.code},
                  {"wall_s", end.use.wall_seconds},
                  {"cpu_s", end.use.cpu_seconds},
                  {"memory_MB", end.use.peak_megabytes},
                  {"why", end.why}});
}

std::optional<TaskEnd> read_end(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  try {
    const std::optional<End> end = end_of(json.at("end").get<std::string>());
    // Not get<int>(): what of 1e308?
    const auto code = json.at("code").get_ref<const Json::number_integer_t&>();
    if (!end) return {};
    return TaskEnd{
        json.at("key"),
        {*end, static_cast<int>(code), json.at("wall_s"), json.at("cpu_s"), json.at("memory_MB")},
        json.value("why", "")};
  } catch (const Json::exception&) {
    return {};
  }
}

}  // namespace articular::tools
