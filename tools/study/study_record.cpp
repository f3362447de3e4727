#include "tools/study/study_record.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "sim/base/atomic_file.hpp"
#include "sim/output/frame_writer.hpp"

namespace articular::tools {
namespace {

using Json = nlohmann::ordered_json;
using End = ProgramUse::End;

template <class Take>
double median(const std::vector<ProgramUse>& runs, Take take) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const ProgramUse& run : runs) values.push_back(take(run));
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n == 0 ? 0 : 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

}  // namespace

bool CaseRecord::succeeded() const {
  return !runs.empty() && runs.back().end == End::Exited && runs.back().code == 0;
}

std::string CaseRecord::outcome() const {
  if (runs.empty()) return "not run";
  const ProgramUse& run = runs.back();
  if (run.end == End::TimeLimit) return "time limit";
  if (run.end == End::Lost) return "lost";
  if (run.end == End::Signalled) return "crashed, signal " + std::to_string(run.code);
  switch (run.code) {
    case 0:
      return "done";
    case 2:
      return "bad input";
    case 3:
      return "could not go on";
    case 4:
      return "system failed";
    default:
      return "exit code " + std::to_string(run.code);
  }
}

double CaseRecord::wall() const {
  return median(runs, [](const ProgramUse& run) { return run.wall_seconds; });
}

double CaseRecord::cpu() const {
  return median(runs, [](const ProgramUse& run) { return run.cpu_seconds; });
}

double CaseRecord::memory() const {
  double most = 0;
  for (const ProgramUse& run : runs) most = std::max(most, run.peak_megabytes);
  return most;
}

void write_record(const std::filesystem::path& file, const std::string& key,
                  const CaseRecord& record) {
  Json runs = Json::array();
  for (const ProgramUse& run : record.runs)
    runs.push_back({{"end", static_cast<int>(run.end)},
                    {"code", run.code},
                    {"wall_s", run.wall_seconds},
                    {"cpu_s", run.cpu_seconds},
                    {"memory_MB", run.peak_megabytes}});
  const Json json = {{"key", key}, {"runs", runs}, {"message", record.message}};
  sim::write_text_file(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

CaseRecord read_record(const std::filesystem::path& file, const std::string& key) {
  CaseRecord record;
  std::ifstream stream(file);
  const Json json = Json::parse(stream, nullptr, false);
  // Not get<int>(): what of 1e308?
  const auto whole = [](const Json& number) {
    return static_cast<int>(number.get_ref<const Json::number_integer_t&>());
  };
  try {
    if (json.at("key") != key) return {};
    for (const Json& run : json.at("runs"))
      record.runs.push_back({static_cast<End>(whole(run.at("end"))), whole(run.at("code")),
                             run.at("wall_s"), run.at("cpu_s"), run.at("memory_MB")});
    record.message = json.at("message");
  } catch (const Json::exception&) {
    return {};
  }
  return record;
}

}  // namespace articular::tools
