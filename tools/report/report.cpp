#include "tools/report/report.hpp"

#include <fmt/format.h>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/base/version.hpp"
#include "tools/report/page_file.hpp"
#include "tools/report/run_record.hpp"
#include "tools/report/run_scene.hpp"
#include "tools/report/setup_scene.hpp"
#include "tools/shipped/shipped_scenarios.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

// [bytes] With the programs of the page, under 1 MB, and bones that stays below 5 MB.
constexpr double kRoomForFrames = 3e6, kRoomForPictures = 1.2e6;

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::vector<fs::path> series_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".pvd") found.push_back(entry->path());
  if (error)
    throw sim::InputError({sim::one_line(folder.string())}, "cannot be read: " + error.message());
  return found;
}

std::string title_of(const Json& summary, const fs::path& folder) {
  std::string name = fs::weakly_canonical(folder).filename().string();
  if (!summary.is_object()) return name;
  const Json title = summary.value(Json::json_pointer("/settings/title"), Json(""));
  return title.is_string() && title != "" ? title.get<std::string>() : name;
}

/// What a report can do without: a remark takes its place.
template <class Read>
Json optional_part(Json& remarks, const Read& read) {
  try {
    return read();
  } catch (const sim::InputError& error) {
    remarks.push_back(sim::one_line(error.what()));
    return nullptr;
  }
}

Json run_data(const fs::path& folder) {
  const std::vector<fs::path> series = series_in(folder);
  if (series.empty() && !fs::exists(folder / "history.csv") && !fs::exists(folder / "summary.json"))
    throw sim::InputError({sim::one_line(folder.string())},
                          "no results here: expected the folder of an `articular run`");
  if (series.size() > 1)
    throw sim::InputError({sim::one_line(folder.string())},
                          "several .pvd in this folder: expected that of one run");
  Json data = {{"kind", "run"}, {"program", sim::kVersion}};
  Json remarks = Json::array();
  data["summary"] = optional_part(remarks, [&] { return summary_of(folder); });
  data["title"] = title_of(data["summary"], folder);
  data["error_bars"] = optional_part(remarks, [&] { return error_bars_of(folder); });
  data["history"] = optional_part(remarks, [&] { return history_of(folder); });
  Json pictures = pictures_of(folder, kRoomForPictures);
  data["pictures"] = pictures["pictures"];
  for (const Json& remark : pictures["remarks"]) remarks.push_back(remark);
  if (series.empty()) {
    data["scene"] = nullptr;
    remarks.push_back(
        "no frames to show in 3D: the run ended before the first, or `output.frames` is false");
  } else {
    data["scene"] = run_scene(series.front(), kRoomForFrames);
    for (const Json& remark : data["scene"]["remarks"]) remarks.push_back(remark);
  }
  data["remarks"] = remarks;
  return data;
}

}  // namespace

int report(const ReportOptions& options) {
  if (const std::string ending = options.out.extension().string();
      !options.out.empty() && ending != ".html" && ending != ".htm")
    throw sim::InputError({sim::one_line(options.out.string())},
                          "a report is a web page: expected a file name that ends in .html");
  const std::string page = empty_page();
  const bool is_run = is_folder(options.what);
  const fs::path scenario = is_run ? fs::path() : find_file_for("run", options.what);
  const Json data = is_run ? run_data(options.what) : setup_of(scenario);
  const fs::path file = !options.out.empty() ? options.out
                        : is_run             ? fs::path(options.what) / "report.html"
                                             : fs::path(scenario.stem().string() + "_setup.html");
  const std::string text = page_with(page, data["title"].get<std::string>(), data);
  sim::write_text_file(file, text);
  for (const Json& remark : data["remarks"])
    fmt::print(stderr, "articular: note: {}\n", remark.get<std::string>());
  fmt::print("wrote {} ({:.1f} MB)\n", sim::one_line(file.lexically_normal().string()),
             1e-6 * static_cast<double>(text.size()));
  return 0;
}

}  // namespace articular::tools
