#pragma once

#include <filesystem>

#include "tools/plot/figure.hpp"
#include "tools/plot/gnuplot_script.hpp"
#include "tools/plot/page_layout.hpp"

namespace articular::tools {

/// Somebody asked to stop while gnuplot was drawing; no file was written.
struct DrawingInterrupted {};

/// Draws a page with gnuplot. The file appears whole or not at all.
///
/// Why gnuplot: it writes text as text into SVG, embeds fonts into PDF, and the pictures of this
/// repository are drawn by it. cairo writes letters into SVG as outlines, and VTK's charts need a
/// display.
/// @throws sim::SystemError  where gnuplot is missing or fails, or the file can't be written
void draw_figure(const Figure& figure, const PageLayout& page, FigureFormat format,
                 const std::filesystem::path& file);

}  // namespace articular::tools
