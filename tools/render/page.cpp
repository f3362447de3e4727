#include "tools/render/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

constexpr int kSmallest = 64, kLargest = 8192;          // [pixel]
constexpr double kInch = 25.4;                          // [mm]
constexpr double kTextPoints = 8, kPointsPerInch = 72;  // text of figures in journals
constexpr double kTextOfPicture = 0.025;                // of its smaller side
constexpr double kFewestLines = 18;                     // of text, each way
constexpr double kDefaultDpi = 300;                     // asked for by journals
constexpr double kLeastDpi = 30, kMostDpi = 2400;

struct Size {
  double width, height;
  bool in_print;  // [mm], else [pixel]
};

Size parse_size(const std::string& text) {
  Size size{0, 0, false};
  int end = 0;
  if (std::sscanf(text.c_str(), "%lfx%lf%n", &size.width, &size.height, &end) == 2) {
    std::string unit = text.substr(static_cast<std::size_t>(end));
    std::erase(unit, ' ');
    size.in_print = unit == "mm";
    const bool whole =
        size.width == std::floor(size.width) && size.height == std::floor(size.height);
    if (size.in_print || (unit.empty() && whole)) return size;
  }
  throw sim::InputError(
      "--size: expected WIDTHxHEIGHT in pixels or in print, e.g. 1600x1000 or 170x110mm, not `" +
      text + "`");
}

}  // namespace

Page page_of(const std::string& text, std::optional<double> dpi) {
  const Size size = parse_size(text);
  if (dpi && !(*dpi >= kLeastDpi && *dpi <= kMostDpi))
    throw sim::InputError(
        fmt::format("--dpi {:g}: expected {:g} to {:g} pixels an inch", *dpi, kLeastDpi, kMostDpi));
  if (size.in_print && !dpi) dpi = kDefaultDpi;
  const double pixels = size.in_print ? *dpi / kInch : 1;
  const double width = std::round(size.width * pixels), height = std::round(size.height * pixels);
  for (const double side : {width, height})
    if (!(side >= kSmallest && side <= kLargest))
      throw sim::InputError(fmt::format("--size {}: expected {} to {} pixels each way{}", text,
                                        kSmallest, kLargest,
                                        size.in_print ? fmt::format(", not {:g}", side) : ""));
  Page page{static_cast<int>(width), static_cast<int>(height), 0, dpi};
  const double smaller = std::min(width, height);
  page.text = dpi ? kTextPoints * *dpi / kPointsPerInch : kTextOfPicture * smaller;
  if (smaller < kFewestLines * page.text)
    throw sim::InputError(fmt::format(
        "--size {}: at {:g} dpi there is no room for text of {:g} points; expected {:.0f} pixels "
        "({:.0f} mm) each way at least, or a smaller --dpi",
        text, *dpi, kTextPoints, std::ceil(kFewestLines * page.text),
        std::ceil(kFewestLines * kTextPoints / kPointsPerInch * kInch)));
  return page;
}

Page finer(const Page& page, int n) {
  Page result = page;
  result.width *= n;
  result.height *= n;
  result.text *= n;
  return result;
}

PageLayout lay_out(const Page& page, int num_panels, double legend_width) {
  const double margin = page.text, top = 4.2 * page.text, bottom = 4.6 * page.text;
  const double right = legend_width > 0 ? legend_width + margin : margin;
  const double width = page.width - margin - right, height = page.height - top - bottom;
  PageLayout layout;
  const double step = (width + margin) / num_panels;
  for (int i = 0; i < num_panels; ++i) {
    const double x = margin + i * step;
    layout.panels.push_back({x, bottom, step - margin, height});
    layout.headings.push_back({x, bottom + height, step - margin, top});
  }
  layout.legend = {page.width - right + 0.5 * margin, 0.5 * margin, legend_width,
                   page.height - margin};
  layout.foot = {margin, 0, width, bottom};
  return layout;
}

}  // namespace articular::tools
