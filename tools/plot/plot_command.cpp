#include "tools/plot/plot_command.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>
#include <optional>
#include <string_view>

#include "sim/base/message_text.hpp"
#include "tools/plot/plot.hpp"

namespace articular::tools {
namespace {

constexpr double kSmallestPage = 20, kLargestPage = 1000;  // [mm]

std::optional<double> millimetres(std::string_view text) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value >= kSmallestPage && value <= kLargestPage ? std::optional(value) : std::nullopt;
}

/// "85" or "85x60".
PageSize parse_size(const std::string& text) {
  const std::size_t at = text.find('x');
  const std::string_view all = text;
  PageSize size{millimetres(all.substr(0, at)), {}};
  if (at != std::string::npos) size.height = millimetres(all.substr(at + 1));
  if (!size.width || (at != std::string::npos && !size.height))
    throw CLI::ValidationError(
        "--size",
        "expected WIDTH or WIDTHxHEIGHT in mm, from 20 to 1000, such as 85 or 170x120, "
        "not " +
            sim::in_quotes(text));
  return size;
}

}  // namespace

void add_plot_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App& command = *app.add_subcommand("plot", "Draw curves of runs as SVG or PDF");
  command
      .add_option("runs", options->arguments,
                  "Folders of runs, then the probes to draw: a column of history.csv, the first "
                  "parts of its name, or a pattern with `*` (in quotes) [all]. Several runs share "
                  "a panel")
      ->required()
      ->type_name("DIR... [PROBE...]");
  command
      .add_option("--out", options->out,
                  "File to write, .svg or .pdf [DIR/plot/PROBES.svg; of several runs "
                  "plot/DIRS-PROBES.svg]")
      ->type_name("FILE");
  command
      .add_option("--x", options->x,
                  "Column for the x axis [the time; the load in a static analysis]")
      ->type_name("PROBE");
  command
      .add_option("--range", options->ranges,
                  "Limits of the y axes of one dimension, or of one probe; may be given often")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("\"[PROBE=]LO..HI UNIT\"");
  command.add_option("--x-range", options->x_range, "Limits of the x axis")
      ->type_name("\"LO..HI UNIT\"");
  command
      .add_option("--band", options->bands,
                  "A published range as a shaded band: two numbers, or a table with three columns, "
                  "x, low and high, each with its unit; may be given often")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("\"[PROBE=]LO..HI UNIT\"|[PROBE=]FILE.csv");
  command
      .add_option("--label", options->labels,
                  "Names of the runs for the legend, given once a run [their folders]")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("TEXT");
  command
      .add_option_function<std::string>(
          "--size", [options](const std::string& text) { options->size = parse_size(text); },
          "Size of the page in mm [85 wide for one panel, 170 for several]")
      ->type_name("W|WxH");
  command.footer(
      "Try: articular plot out/knee tibia.force --band \"tibia.force.z=900..1100 N\" --out f.pdf\n"
      "     articular plot out/intact out/cut knee.anterior --x tibia.force.y --label intact "
      "--label cut\n"
      "A unit of the limits and bands is any of the same dimension. Needs gnuplot (Debian: "
      "gnuplot-nox).");
  command.callback([options, &exit_code] { exit_code = plot(*options); });
}

}  // namespace articular::tools
