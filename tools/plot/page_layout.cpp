#include "tools/plot/page_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

constexpr double kLetter = 0.58 * kEm;  // [mm], mean width of letters in a wide font
constexpr double kLine = 1.35 * kEm;    // [mm], from one line of text to the next
constexpr double kTick = 1.0;           // [mm]
constexpr double kGap = 0.8;            // [mm], between tick, number and label
constexpr double kSide = 3.2;           // [mm], free at the right of a panel: half a number
constexpr double kLeastPanel = 12;      // [mm], below this axes are a blot
constexpr double kAspect = 0.68, kLowest = 24, kHighest = 55;  // of a panel that may choose, [mm]
constexpr double kTickEvery = 5.5;                             // [mm], of numbers along y

std::size_t columns_for(std::size_t panels, double width) {
  const std::size_t wanted = panels == 1 ? 1 : panels == 2 || panels == 4 ? 2 : 3;
  const auto most = static_cast<std::size_t>(std::max(1.0, std::floor(width / 40)));
  return std::min(wanted, most);
}

double widest(const std::vector<std::string>& labels) {
  double most = 0;
  for (const std::string& label : labels) most = std::max(most, text_width(label));
  return most;
}

/// Room for the numbers along the y axes, however many ticks these get.
double numbers_width(const Figure& figure) {
  constexpr int kMostTicks = 12;
  double most = 0;
  for (const FigurePanel& panel : figure.panels)
    for (int n = 2; n <= kMostTicks; ++n)
      most = std::max(most, widest(ticks(panel.y.range, n).labels));
  return most;
}

/// The legend stands in rows above all panels, so that it covers no curve.
struct LegendGrid {
  std::size_t columns = 1, rows = 0;
  double cell = 0;
};

LegendGrid legend_grid(const Figure& figure, double width) {
  LegendGrid grid;
  for (const LegendEntry& entry : figure.legend)
    grid.cell = std::max(grid.cell, kSampleLength + 2 * kGap + text_width(entry.text) + kEm);
  if (figure.legend.empty()) return grid;
  grid.cell = std::min(grid.cell, width);
  grid.columns =
      std::clamp<std::size_t>(static_cast<std::size_t>(width / grid.cell), 1, figure.legend.size());
  grid.rows = (figure.legend.size() + grid.columns - 1) / grid.columns;
  return grid;
}

}  // namespace

double text_width(std::string_view text) {
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  });
  return static_cast<double>(letters) * kLetter;
}

std::string fitting(std::string_view text, double width) {
  if (text_width(text) <= width) return std::string(text);
  const auto is_inside = [&](std::size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80;
  };
  std::size_t begin = text.size() / 2, end = begin;  // of what is left out
  const auto whole = [&] {
    while (begin > 0 && is_inside(begin)) --begin;
    while (is_inside(end)) ++end;
  };
  std::string shorter;
  do {
    if (begin > 0) --begin;
    if (end < text.size()) ++end;
    whole();
    shorter = std::string(text.substr(0, begin)) + "…" + std::string(text.substr(end));
  } while (text_width(shorter) > width && (begin > 0 || end < text.size()));
  return shorter;
}

PageLayout page_layout(const Figure& figure, const PageSize& size) {
  const std::size_t n = figure.panels.size();
  PageLayout page;
  page.width = size.width.value_or(n == 1 ? kOneColumn : kTwoColumns);
  const std::size_t columns = columns_for(n, page.width), rows = (n + columns - 1) / columns;

  // 1. What stands around a frame.
  const double left = kLine + kGap + numbers_width(figure) + kGap + kTick;
  const double title = kLine, numbers = kTick + kGap + kEm, label = kLine;
  const LegendGrid grid = legend_grid(figure, page.width - left);
  const double legend = static_cast<double>(grid.rows) * kLine + (grid.rows > 0 ? kGap : 0);

  // 2. What is left for the frames.
  const double cell = page.width / static_cast<double>(columns);
  const double width = cell - left - kSide;
  const double free = (size.height.value_or(0) - legend - label - kGap) / static_cast<double>(rows);
  const double height = size.height ? free - title - numbers - 2 * kGap
                                    : std::clamp(kAspect * width, kLowest, kHighest);
  if (width < kLeastPanel || height < kLeastPanel)
    throw sim::InputError(fmt::format(
        "--size {:g}x{:g}: it leaves {:.0f} x {:.0f} mm for each of {} panels; expected {:g} mm "
        "or more each way: choose fewer probes or a larger page",
        page.width, size.height.value_or(0), std::max(0.0, width), std::max(0.0, height), n,
        kLeastPanel));
  const double row = title + height + numbers + 2 * kGap;
  page.height = size.height.value_or(legend + static_cast<double>(rows) * row + label + kGap);

  // 3. The places.
  page.title_width = width + kSide;
  page.y_label = left - 0.5 * kLine;
  page.x_label = numbers + 0.5 * kLine;
  page.legend_text = std::max(0.0, grid.cell - kSampleLength - 2 * kGap);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t row_above = i / columns;
    const auto r = static_cast<double>(row_above), c = static_cast<double>(i % columns);
    const double top = page.height - legend - r * row - title;
    page.frames.push_back({c * cell + left, c * cell + left + width, top - height, top});
    page.shows_x_label.push_back(i + columns >= n);
  }
  for (std::size_t i = 0; i < figure.legend.size(); ++i) {
    const std::size_t line = i / grid.columns;
    page.legend.push_back({left + static_cast<double>(i % grid.columns) * grid.cell,
                           page.height - kGap - (static_cast<double>(line) + 0.5) * kLine});
  }
  return page;
}

Ticks x_ticks(const AxisRange& range, const Rectangle& frame) {
  constexpr int kMostTicks = 10;
  const double scale = frame.width() / (range.high - range.low);
  for (int n = kMostTicks; n > 2; --n) {
    Ticks divided = ticks(range, n);
    if (divided.at.size() < 2) break;
    if ((divided.at[1] - divided.at[0]) * scale > widest(divided.labels) + kEm) return divided;
  }
  return ticks(range, 2);
}

Ticks y_ticks(const AxisRange& range, const Rectangle& frame) {
  return ticks(range, std::max(2, static_cast<int>(frame.height() / kTickEvery)));
}

}  // namespace articular::tools
