#include "tools/plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/base/hash.hpp"
#include "sim/base/message_text.hpp"
#include "tools/plot/compose_figure.hpp"
#include "tools/plot/draw_figure.hpp"
#include "tools/process/interruption.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 100;  // [bytes], of a file without its ending

FigureFormat format_of(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".svg") return FigureFormat::Svg;
  if (ending == ".pdf") return FigureFormat::Pdf;
  throw sim::InputError({sim::one_line(file.string())},
                        "expected a file name that ends in .svg or .pdf");
}

/// The last `parts` of a path.
std::string tail(const fs::path& path, int parts) {
  fs::path result;
  for (auto part = path.end(); parts > 0 && part != path.begin(); --parts)
    result = result.empty() ? *--part : *--part / result;
  return result.string();
}

/// A text as part of a file name; what it loses there, its hash stands for.
std::string file_name(const std::string& text) {
  std::string name;
  for (const char c : text.substr(0, kLongestName)) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_' || c == '+';
    name += is_plain ? c : '_';
  }
  if (name.starts_with('.')) name[0] = '_';
  if (name != text) name += fmt::format("-{:08x}", sim::hash_bytes(text) & 0xffffffffU);
  return name;
}

std::string joined(const std::vector<std::string>& words, const char* by) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : by) + word;
  return text;
}

bool is_folder_of_a_run(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return false;
  // A folder that can't be looked into is told when it is opened.
  return fs::exists(path / "history.csv", error) || static_cast<bool>(error);
}

}  // namespace

std::size_t count_folders(const std::vector<std::string>& arguments) {
  std::size_t n = std::min<std::size_t>(1, arguments.size());
  for (; n < arguments.size(); ++n) {
    const bool is_path = arguments[n].find('/') != std::string::npos;
    std::error_code ignored;
    if (!(is_path && fs::exists(arguments[n], ignored)) && !is_folder_of_a_run(arguments[n])) break;
  }
  return n;
}

std::vector<std::string> folder_labels(const std::vector<fs::path>& folders) {
  std::vector<fs::path> whole;
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    const fs::path full = fs::weakly_canonical(folder, ignored);
    whole.push_back(full.empty() ? folder : full);
    if (!whole.back().has_filename()) whole.back() = whole.back().parent_path();  // "out/a/"
  }
  constexpr int kDeepest = 6;
  std::vector<std::string> labels;
  for (int parts = 1; parts <= kDeepest; ++parts) {
    labels.clear();
    for (const fs::path& path : whole) labels.push_back(tail(path, parts));
    if (std::set<std::string>(labels.begin(), labels.end()).size() == labels.size()) return labels;
  }
  labels.clear();
  for (const fs::path& path : folders) labels.push_back(path.string());
  return labels;
}

fs::path default_plot_file(const std::vector<fs::path>& folders,
                           const std::vector<std::string>& probes, const std::string& x) {
  std::string name = probes.empty() ? "all" : joined(probes, "+");
  if (!x.empty()) name += "-over-" + x;
  if (folders.size() == 1) return folders[0] / "plot" / (file_name(name) + ".svg");
  return fs::path("plot") / (file_name(joined(folder_labels(folders), "+") + "-" + name) + ".svg");
}

int plot(const PlotOptions& options) {
  // 1. What is asked for?
  const auto n = static_cast<std::ptrdiff_t>(count_folders(options.arguments));
  const std::vector<fs::path> folders(options.arguments.begin(), options.arguments.begin() + n);
  FigureRequest request;
  request.probes.assign(options.arguments.begin() + n, options.arguments.end());
  request.x = options.x;
  const fs::path file =
      options.out.empty() ? default_plot_file(folders, request.probes, options.x) : options.out;
  const FigureFormat format = format_of(file);
  if (!options.labels.empty() && options.labels.size() != folders.size())
    throw sim::InputError(fmt::format("--label: {} for {} runs: expected one for each",
                                      options.labels.size(), folders.size()));
  request.labels = options.labels.empty() ? folder_labels(folders) : options.labels;
  for (const std::string& text : options.ranges)
    request.ranges.push_back(parse_interval(text, "--range"));
  if (!options.x_range.empty()) {
    request.x_range = parse_interval(options.x_range, "--x-range");
    if (!request.x_range->probe.empty())
      throw sim::InputError("--x-range: all panels have one x axis, so it names no probe");
  }
  for (const std::string& text : options.bands) {
    if (is_band_table(text))
      request.band_tables.push_back(read_band(text));
    else
      request.bands.push_back(parse_interval(text, "--band"));
  }

  // 2. What is there?
  for (const fs::path& folder : folders) request.runs.push_back(open_run(folder));
  const ComposedFigure composed = compose_figure(request);
  const PageLayout page = page_layout(composed.figure, options.size);

  // 3. Draw.
  if (options.out.empty()) sim::make_folders(file.parent_path());
  try {
    draw_figure(composed.figure, page, format, file);
  } catch (const DrawingInterrupted&) {
    fmt::print(stderr, "articular: interrupted; nothing was written\n");
    return kInterruptedExitCode;
  }
  for (const std::string& remark : composed.remarks) fmt::print(stderr, "articular: {}\n", remark);
  fmt::print("wrote {} ({} panel{}, {:.4g} x {:.4g} mm)\n", sim::one_line(file.string()),
             composed.figure.panels.size(), composed.figure.panels.size() == 1 ? "" : "s",
             page.width, page.height);
  return 0;
}

}  // namespace articular::tools
