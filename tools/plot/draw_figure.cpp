#include "tools/plot/draw_figure.hpp"

#include <fmt/format.h>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/base/message_text.hpp"
#include "tools/process/interruption.hpp"
#include "tools/process/measured_program.hpp"
#include "tools/process/temporary_folder.hpp"

namespace articular::tools {
namespace {

constexpr double kTimeLimit = 120;  // [s]; a page of thinned curves takes less than one

ProgramUse run_gnuplot(const std::filesystem::path& script, const std::filesystem::path& log) {
  try {
    // -d: not what a user's own .gnuplot says. PostScript fonts and locales are its own business.
    return run_measured({"gnuplot", "-d", script.string()}, {"LC_ALL=C.UTF-8"}, log, kTimeLimit,
                        interruption_asked);
  } catch (const sim::SystemError&) {
    throw sim::SystemError(
        "the program gnuplot can't be started: is it there? "
        "(Debian: apt install gnuplot-nox)");
  }
}

/// gnuplot counts in pixels; a journal measures in millimetres.
void set_millimetres(std::string& svg, const PageLayout& page) {
  const std::string pixels =
      fmt::format(" width=\"{}\" height=\"{}\"", svg_pixels(page.width), svg_pixels(page.height));
  const std::size_t at = svg.find(pixels);
  if (at == std::string::npos) throw sim::SystemError("gnuplot wrote an SVG of another kind");
  svg.replace(at, pixels.size(),
              fmt::format(" width=\"{:.2f}mm\" height=\"{:.2f}mm\"", page.width, page.height));
}

}  // namespace

void draw_figure(const Figure& figure, const PageLayout& page, FigureFormat format,
                 const std::filesystem::path& file) {
  listen_for_interruption();  // the temporary folder is removed in any case
  const TemporaryFolder folder;
  const std::filesystem::path script = folder.path() / "page.gnuplot";
  const std::filesystem::path picture = folder.path() / "page", log = folder.path() / "log";
  sim::write_text_file(script, gnuplot_script(figure, page, format, picture.string()),
                       sim::Durable::Later);
  const ProgramUse use = run_gnuplot(script, log);
  if (interruption_asked()) throw DrawingInterrupted{};
  std::error_code error;
  const bool is_there = std::filesystem::file_size(picture, error) > 0 && !error;
  if (use.end != ProgramUse::End::Exited || use.code != 0 || !is_there)
    throw sim::SystemError("gnuplot failed: " + sim::in_quotes(sim::file_bytes(log)));
  std::string bytes = sim::file_bytes(picture);
  if (format == FigureFormat::Svg) set_millimetres(bytes, page);
  sim::write_text_file(file, bytes);
}

}  // namespace articular::tools
