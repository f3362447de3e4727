#pragma once

#include <string>
#include <string_view>

#include "tools/plot/figure.hpp"
#include "tools/plot/page_layout.hpp"

namespace articular::tools {

enum class FigureFormat { Svg, Pdf };

/// A text as gnuplot takes it without reading anything into it: in single quotes, where neither
/// backquotes nor `$` nor backslashes mean anything, on one line, in valid UTF-8 that may stand in
/// XML (what is not becomes U+FFFD).
std::string gnuplot_text(std::string_view text);

/// The commands that draw a page into a file. All that comes from elsewhere is numbers that were
/// read as such, and texts through gnuplot_text().
std::string gnuplot_script(const Figure& figure, const PageLayout& page, FigureFormat format,
                           std::string_view file);

/// Size of an SVG picture that gnuplot draws for a page, in its unit, 1/96 inch.
int svg_pixels(double millimetres);

}  // namespace articular::tools
