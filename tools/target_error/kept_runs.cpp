#include "tools/target_error/kept_runs.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "tools/study/study_prepare.hpp"
#include "tools/target_error/pilot_runs.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

bool is_finished_run(const fs::path& results) {
  const auto summary = nlohmann::json::parse(text_of(results / "summary.json"), nullptr, false);
  return summary.is_object() && summary.value("outcome", "") == "finished";
}

}  // namespace

void open_kept_runs(const fs::path& folder, const std::string& inputs) {
  if (fs::is_symlink(folder))
    throw sim::InputError({folder.string()},
                          "is a symbolic link; results are not written through one: remove it");
  if (text_of(folder / "inputs") != inputs)
    for (const char* const ours : {"cases", "prepared", "kept", "begun"})
      fs::remove_all(folder / ours);
  fs::create_directories(folder / "kept");
  sim::write_text_file(folder / "inputs", inputs);
}

KeptRun::KeptRun(const fs::path& folder, const std::vector<std::string>& overrides)
    : begun_(folder / "begun"),
      key_(fmt::format("{:016x}", std::hash<std::string>{}(joined(overrides)))) {
  folder_ = folder / "kept" / key_;
}

bool KeptRun::is_finished() const { return fs::exists(folder_ / "seconds"); }

bool KeptRun::is_begun() const { return text_of(begun_) == key_; }

void KeptRun::begin() const { sim::write_text_file(begun_, key_); }

void KeptRun::keep(const fs::path& results, double seconds) const {
  fs::create_directories(folder_);
  sim::write_text_file(folder_ / "history.csv", text_of(results / "history.csv"));
  sim::write_text_file(folder_ / "seconds", fmt::format("{:.6g}\n", seconds));
}

RunHistory KeptRun::history() const { return quoted_history(folder_); }

double KeptRun::seconds() const {
  return std::strtod(text_of(folder_ / "seconds").c_str(), nullptr);
}

bool KeptRun::is_in(const fs::path& results) const {
  return is_finished_run(results) &&
         text_of(results / "history.csv") == text_of(folder_ / "history.csv");
}

}  // namespace articular::tools
