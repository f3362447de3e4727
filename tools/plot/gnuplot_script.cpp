#include "tools/plot/gnuplot_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "tools/plot/line_style.hpp"

namespace articular::tools {
namespace {

// Widths of lines in points: journals ask for 0.5 at least.
constexpr double kCurve = 1.0, kFrame = 0.5;
// A unit of gnuplot's line width, in points. Its lengths of dashes differ by 2, and fonts in PDF
// are by 96 dots an inch.
constexpr double kSvgUnit = 0.75, kPdfUnit = 0.5;

/// Bytes of the UTF-8 character at the start, or 0 where there is none that XML allows.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return first < 0x20 || first == 0x7f ? 0 : 1;
  const std::size_t length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (length == 0 || first > 0xF4) return 0;
  unsigned code = first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const bool is_too_long = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool is_none = code < 0xA0 || (code >= 0xD800 && code < 0xE000) || code == 0xFFFE ||
                       code == 0xFFFF || code > 0x10FFFF;
  return is_too_long || is_none ? 0 : length;
}

class Script {
 public:
  Script(const PageLayout& page, FigureFormat format)
      : page_(page), unit_(format == FigureFormat::Svg ? kSvgUnit : kPdfUnit) {}

  template <class... Arguments>
  void add(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), text, std::forward<Arguments>(arguments)...);
  }

  /// Of a length on the page, as gnuplot counts it.
  double across(double x) const { return x / page_.width; }
  double up(double y) const { return y / page_.height; }

  std::string stroke(double points, const LineStyle& style) const {
    std::string text = fmt::format("lw {:.4g} lc rgb '{}'", points / unit_, style.colour);
    text += style.dashes.empty() ? " dt solid" : fmt::format(" dt ({})", style.dashes);
    return text;
  }
  double width(double points) const { return points / unit_; }

  std::string take() { return std::move(text_); }

 private:
  const PageLayout& page_;
  double unit_;
  std::string text_;
};

void add_terminal(Script& script, const PageLayout& page, FigureFormat format,
                  std::string_view file) {
  if (format == FigureFormat::Svg)
    script.add("set terminal svg size {},{} font 'sans-serif,{:.4g}' noenhanced dashlength 0.8\n",
               svg_pixels(page.width), svg_pixels(page.height), kFontPoints * 96 / 72);
  else
    script.add(
        "set terminal pdfcairo size {:.4f}cm,{:.4f}cm font 'Arial,{:g}' fontscale 0.75 noenhanced "
        "dashlength 1.6\n",
        page.width / 10, page.height / 10, kFontPoints);
  script.add("set encoding utf8\nset output {}\nset multiplot\nunset key\n", gnuplot_text(file));
  script.add("set border 3 lw {:.4g} lc rgb '#000000' back\n", script.width(kFrame));
}

/// What stands beside the panels is drawn with the first one.
void add_legend(Script& script, const Figure& figure, const PageLayout& page) {
  for (std::size_t i = 0; i < figure.legend.size(); ++i) {
    const LegendEntry& entry = figure.legend[i];
    const PlacedEntry& place = page.legend[i];
    const double right = place.left + kSampleLength;
    if (entry.kind == LegendEntry::Kind::Band)
      script.add(
          "set object {} rectangle from screen {:.6f},{:.6f} to screen {:.6f},{:.6f} front "
          "fc rgb '{}' fs transparent solid 0.7 noborder\n",
          i + 1, script.across(place.left), script.up(place.middle - 0.4 * kEm),
          script.across(right), script.up(place.middle + 0.4 * kEm), band_colour(entry.style));
    else
      script.add("set arrow {} from screen {:.6f},{:.6f} to screen {:.6f},{:.6f} nohead front {}\n",
                 i + 1, script.across(place.left), script.up(place.middle), script.across(right),
                 script.up(place.middle), script.stroke(kCurve, line_style(entry.style)));
    script.add("set label {} {} at screen {:.6f},{:.6f} left front\n", i + 10,
               gnuplot_text(fitting(entry.text, page.legend_text)),
               script.across(right + 0.4 * kEm), script.up(place.middle));
  }
}

void add_ticks(Script& script, char axis, const AxisRange& range, const Ticks& divided) {
  script.add("set {}range [{:.17g}:{:.17g}]\nset {}tics nomirror out scale 0.5 offset {} (", axis,
             range.low, range.high, axis, axis == 'x' ? "0,0.4" : "0.6,0");
  for (std::size_t i = 0; i < divided.at.size(); ++i)
    script.add("{}{} {:.17g}", i == 0 ? "" : ", ", gnuplot_text(divided.labels[i]), divided.at[i]);
  script.add(")\n");
}

void add_axes(Script& script, const FigurePanel& panel, const PageLayout& page, std::size_t i) {
  const Rectangle& frame = page.frames[i];
  const bool shows_x_label = page.shows_x_label[i];
  script.add("set lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\n",
             script.across(frame.left), script.across(frame.right));
  script.add("set bmargin at screen {:.6f}\nset tmargin at screen {:.6f}\n",
             script.up(frame.bottom), script.up(frame.top));
  add_ticks(script, 'x', panel.x.range, x_ticks(panel.x.range, frame));
  add_ticks(script, 'y', panel.y.range, y_ticks(panel.y.range, frame));
  // Placed by us: gnuplot would leave room by its own idea of the numbers' widths.
  const double room = frame.height() + 2 * kEm;
  const bool is_long = text_width(panel.y.label) > room;
  script.add("set label 1 {} at screen {:.6f},{:.6f} left front\n",
             gnuplot_text(fitting(panel.title, page.title_width)), script.across(frame.left),
             script.up(frame.top + 0.7 * kEm));
  script.add("set label 2 {} at screen {:.6f},{:.6f} center rotate by 90 front\n",
             gnuplot_text(is_long ? panel.y.short_label : panel.y.label),
             script.across(frame.left - page.y_label),
             script.up(frame.bottom + 0.5 * frame.height()));
  if (shows_x_label)
    script.add("set label 3 {} at screen {:.6f},{:.6f} center front\n", gnuplot_text(panel.x.label),
               script.across(frame.left + 0.5 * frame.width()),
               script.up(frame.bottom - page.x_label));
  else
    script.add("unset label 3\n");
}

/// Curves, and points that stand alone, which are no line.
void add_data(Script& script, const FigurePanel& panel) {
  for (std::size_t i = 0; i < panel.bands.size(); ++i) {
    const FigureBand& band = panel.bands[i];
    script.add("$band{} << END\n", i);
    for (std::size_t j = 0; j < band.x.size(); ++j)
      script.add("{:.9g} {:.9g} {:.9g}\n", band.x[j], band.low[j], band.high[j]);
    script.add("END\n");
  }
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    script.add("$curve{} << END\n", i);
    for (const auto& piece : panel.curves[i].pieces) {
      for (const PlotPoint& point : piece) script.add("{:.9g} {:.9g}\n", point.x, point.y);
      script.add("\n");  // a gap
    }
    script.add("END\n$alone{} << END\n", i);
    for (const auto& piece : panel.curves[i].pieces)
      if (piece.size() == 1) script.add("{:.9g} {:.9g}\n", piece[0].x, piece[0].y);
    script.add("END\n");
  }
  for (std::size_t i = 0; i < panel.bars.size(); ++i)
    script.add("$bar{} << END\n{:.9g} {:.9g} {:.9g}\nEND\n", i, panel.bars[i].x, panel.bars[i].y,
               panel.bars[i].half);
}

void add_plot(Script& script, const FigurePanel& panel) {
  const auto has_lone_points = [](const FigureCurve& curve) {
    for (const auto& piece : curve.pieces)
      if (piece.size() == 1) return true;
    return false;
  };
  script.add("plot");
  const char* comma = " ";
  for (std::size_t i = 0; i < panel.bands.size(); ++i) {
    script.add(
        "{}$band{} using 1:2:3 with filledcurves fc rgb '{}' fs transparent solid 0.7 noborder "
        "notitle",
        comma, i, band_colour(panel.bands[i].shade));
    comma = ", ";
  }
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const LineStyle style = line_style(panel.curves[i].style);
    if (panel.curves[i].pieces.empty()) continue;
    script.add("{}$curve{} using 1:2 with lines {} notitle", comma, i,
               script.stroke(kCurve, style));
    comma = ", ";
    if (has_lone_points(panel.curves[i]))
      script.add(", $alone{} using 1:2 with points pt 7 ps 0.25 lc rgb '{}' notitle", i,
                 style.colour);
  }
  for (std::size_t i = 0; i < panel.bars.size(); ++i) {
    const LineStyle style = line_style(panel.bars[i].style);
    // gnuplot's own error bars have a white patch around the point, which cuts the curve.
    script.add(
        "{}$bar{} using 1:($2-$3):(0):(2*$3) with vectors heads size graph 0.01,90 nofilled {} "
        "notitle, $bar{} using 1:2 with points pt 7 ps 0.25 lc rgb '{}' notitle",
        comma, i, script.stroke(kCurve, {style.colour, ""}), i, style.colour);
    comma = ", ";
  }
  // A panel in which no run has a value is still drawn, empty.
  if (std::string_view(comma) == " ") script.add(" NaN");
  script.add("\n");
}

}  // namespace

std::string gnuplot_text(std::string_view text) {
  std::string result = "'";
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0)
      result += static_cast<unsigned char>(text[0]) < 0x80 ? " " : "\xEF\xBF\xBD";
    else
      result += text.substr(0, length);
    if (text[0] == '\'') result += '\'';
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return result + "'";
}

int svg_pixels(double millimetres) {
  return static_cast<int>(std::lround(millimetres * 96 / 25.4));
}

std::string gnuplot_script(const Figure& figure, const PageLayout& page, FigureFormat format,
                           std::string_view file) {
  Script script(page, format);
  add_terminal(script, page, format, file);
  // White paper, also where the picture stands on a dark page.
  script.add(
      "set object 1000 rectangle from screen 0,0 to screen 1,1 behind fc rgb '#FFFFFF' "
      "fs solid noborder\n");
  add_legend(script, figure, page);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    if (i == 1) {
      script.add("unset object 1000\n");
      for (std::size_t k = 0; k < figure.legend.size(); ++k)
        script.add("unset {} {}\nunset label {}\n",
                   figure.legend[k].kind == LegendEntry::Kind::Band ? "object" : "arrow", k + 1,
                   k + 10);
    }
    add_axes(script, figure.panels[i], page, i);
    add_data(script, figure.panels[i]);
    add_plot(script, figure.panels[i]);
  }
  script.add("unset multiplot\nset output\n");
  return script.take();
}

}  // namespace articular::tools
