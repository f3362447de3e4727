#include "tools/render/render_legend.hpp"

#include <fmt/format.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCoordinate.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace articular::tools {
namespace {

constexpr double kSmall = 0.9;  // text of labels, of the page's
constexpr double kBar = 0.9;    // thickness of colour bars, of the page's text
constexpr double kLine = 1.35;  // from one line of text to the next
constexpr const char* kNoValue = "no value";

void shape_text(vtkTextProperty& property, int size, bool bold) {
  property.SetFontFamilyToArial();
  property.SetFontSize(size);
  property.SetBold(bold ? 1 : 0);
  property.SetVerticalJustificationToCentered();
}

int font_size(double height) { return std::max(1, static_cast<int>(std::lround(height))); }

/// Points are in pixels of the page.
vtkPolyDataMapper2D& add_shape(const Sheet& sheet, vtkPolyData& shape, double line_width) {
  vtkNew<vtkCoordinate> pixels;
  pixels->SetCoordinateSystemToViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(&shape);
  mapper->SetTransformCoordinate(pixels);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(sheet.ink[0], sheet.ink[1], sheet.ink[2]);
  actor->GetProperty()->SetLineWidth(static_cast<float>(std::max(1.0, line_width)));
  sheet.renderer.AddActor2D(actor);
  return *mapper;
}

void add_line(const Sheet& sheet, const std::vector<std::array<double, 2>>& corners, double width) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(corners.size()));
  for (const auto& [x, y] : corners) lines->InsertCellPoint(points->InsertNextPoint(x, y, 0));
  vtkNew<vtkPolyData> line;
  line->SetPoints(points);
  line->SetLines(lines);
  add_shape(sheet, *line, width);
}

void add_frame(const Sheet& sheet, const Rect& r) {
  add_line(sheet,
           {{r.x, r.y},
            {r.x + r.width, r.y},
            {r.x + r.width, r.y + r.height},
            {r.x, r.y + r.height},
            {r.x, r.y}},
           0.06 * sheet.page.text);
}

/// The colours of a table, low at the bottom of an upright box, or at the left of a lying one.
void add_colour_bar(const Sheet& sheet, vtkLookupTable& colours, const Rect& box) {
  const bool upright = box.height > box.width;
  const auto count = static_cast<int>(colours.GetNumberOfTableValues());
  const double* const range = colours.GetRange();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> stripes;
  vtkNew<vtkDoubleArray> values;
  for (int i = 0; i <= count; ++i) {
    const double part = static_cast<double>(i) / count;
    for (const double side : {0.0, 1.0})
      points->InsertNextPoint(box.x + box.width * (upright ? side : part),
                              box.y + box.height * (upright ? part : side), 0);
    if (i == count) break;
    stripes->InsertNextCell({2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2});
    values->InsertNextValue(range[0] + (i + 0.5) / count * (range[1] - range[0]));
  }
  vtkNew<vtkPolyData> bar;
  bar->SetPoints(points);
  bar->SetPolys(stripes);
  bar->GetCellData()->SetScalars(values);
  vtkPolyDataMapper2D& mapper = add_shape(sheet, *bar, 1);
  mapper.SetLookupTable(&colours);
  mapper.UseLookupTableScalarRangeOn();
  add_frame(sheet, box);
}

void add_box(const Sheet& sheet, const Rect& r, const Rgb& colour) {
  vtkNew<vtkLookupTable> one;
  one->SetNumberOfTableValues(1);
  one->SetTableValue(0, colour[0], colour[1], colour[2]);
  one->SetRange(0, 1);
  add_colour_bar(sheet, *one, r);
}

/// A title in lines of some words.
std::vector<std::string> lines_of(const std::string& title) {
  constexpr std::size_t kLongest = 14;  // letters
  std::vector<std::string> lines;
  std::istringstream words(title);
  for (std::string word; words >> word;)
    if (!lines.empty() && lines.back().size() + 1 + word.size() <= kLongest)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  return lines;
}

/// "J/m^3" as "J/m³".
std::string written(std::string unit) {
  for (const auto& [plain, raised] : {std::pair("^2", "²"), std::pair("^3", "³")})
    if (const auto at = unit.find(plain); at != std::string::npos) unit.replace(at, 2, raised);
  return unit;
}

std::string label_of(double value) { return fmt::format("{:g}", value); }

/// The largest of 1, 2, 5 times a power of ten that is not above the value.
double round_down(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= value) return digit * power;
  return power;
}

}  // namespace

void add_text(const Sheet& sheet, const std::string& text, double x, double y,
              const TextStyle& style) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  actor->SetPosition(x, y);
  vtkTextProperty& property = *actor->GetTextProperty();
  shape_text(property, font_size(style.size * sheet.page.text), style.bold);
  property.SetColor(sheet.ink[0], sheet.ink[1], sheet.ink[2]);
  if (style.ground) {
    property.SetBackgroundColor((*style.ground)[0], (*style.ground)[1], (*style.ground)[2]);
    property.SetBackgroundOpacity(0.75);
  }
  if (style.align == Align::Left) property.SetJustificationToLeft();
  if (style.align == Align::Centre) property.SetJustificationToCentered();
  if (style.align == Align::Right) property.SetJustificationToRight();
  sheet.renderer.AddActor2D(actor);
}

double text_width(const std::string& text, double height, bool bold) {
  vtkNew<vtkTextProperty> property;
  shape_text(*property, font_size(height), bold);
  constexpr int kDotsAnInch = 72;  // of a window
  int box[4] = {0, 0, 0, 0};
  vtkTextRenderer::GetInstance()->GetBoundingBox(property, text, box, kDotsAnInch);
  return box[1] - box[0] + 1;
}

void add_heading(const Sheet& sheet, const Rect& rect, const std::string& title,
                 const std::string& moment) {
  const double text = sheet.page.text, needed = text_width(title, 1.3 * text, true);
  const double size = 1.3 * std::min(1.0, rect.width / needed);
  add_text(sheet, title, rect.x, rect.y + rect.height - 1.3 * text, {size, true});
  add_text(sheet, moment, rect.x, rect.y + rect.height - 2.9 * text, {});
}

double legend_width(const Page& page, const ColourScale& scale) {
  double widest = 0;
  const auto add = [&](const std::string& text, double size, bool bold) {
    widest = std::max(widest, text_width(text, size * page.text, bold));
  };
  const double* const range = scale.colours->GetRange();
  for (const double value : round_labels(range[0], range[1])) add(label_of(value), kSmall, false);
  if (scale.has_blank) add(kNoValue, kSmall, false);
  widest += (kBar + 0.5) * page.text;
  for (const std::string& line : lines_of(scale.title)) add(line, 1, true);
  if (scale.highest_above) add(fmt::format("peak {:.3g}", *scale.highest_above), kSmall, false);
  if (scale.lowest_below) add(fmt::format("lowest {:.3g}", *scale.lowest_below), kSmall, false);
  return widest;
}

void add_field_legend(const Sheet& sheet, const Rect& rect, const ColourScale& scale) {
  const double text = sheet.page.text, line = kLine * text;
  double y = rect.y + rect.height - text;
  for (const std::string& words : lines_of(scale.title)) {
    add_text(sheet, words, rect.x, y, {1, true});
    y -= line;
  }
  if (!scale.unit.empty()) {
    add_text(sheet, "[" + written(scale.unit) + "]", rect.x, y, {});
    y -= line;
  }
  if (scale.highest_above) {  // else the scale would hide that it ends below the peak
    add_text(sheet, fmt::format("peak {:.3g}", *scale.highest_above), rect.x, y, {kSmall});
    y -= line;
  }
  const double top = y, bottom = rect.y + 0.42 * rect.height;
  const Rect bar = {rect.x, bottom, kBar * text, std::max(text, top - bottom)};
  add_colour_bar(sheet, *scale.colours, bar);
  const double* const range = scale.colours->GetRange();
  for (const double value : round_labels(range[0], range[1])) {
    const double at = bar.y + bar.height * (value - range[0]) / (range[1] - range[0]);
    add_line(sheet, {{bar.x + bar.width, at}, {bar.x + bar.width + 0.25 * text, at}}, 0.06 * text);
    add_text(sheet, label_of(value), bar.x + bar.width + 0.45 * text, at, {kSmall});
  }
  y = bottom - line;
  if (scale.lowest_below) {
    add_text(sheet, fmt::format("lowest {:.3g}", *scale.lowest_below), rect.x, y, {kSmall});
    y -= line;
  }
  if (scale.has_blank) {
    add_box(sheet, {rect.x, y - 0.5 * kBar * text, kBar * text, kBar * text}, kBlankColour);
    add_text(sheet, kNoValue, rect.x + (kBar + 0.45) * text, y, {kSmall});
  }
}

void add_line_legends(const Sheet& sheet, const Rect& foot,
                      const std::vector<ColourScale>& scales) {
  const double text = sheet.page.text, bar_height = 0.7 * kBar * text;
  double x = foot.x;
  for (const ColourScale& scale : scales) {
    const std::string title =
        scale.title + (scale.unit.empty() ? "" : " [" + written(scale.unit) + "]");
    const double width = std::max(8 * text, text_width(title, kSmall * text, false));
    add_text(sheet, title, x, foot.y + 3.4 * text, {kSmall});
    const Rect bar = {x, foot.y + 2.1 * text, width, bar_height};
    add_colour_bar(sheet, *scale.colours, bar);
    const double* const range = scale.colours->GetRange();
    add_text(sheet, label_of(range[0]), bar.x, foot.y + 1.2 * text, {kSmall});
    add_text(sheet, label_of(range[1]), bar.x + width, foot.y + 1.2 * text,
             {kSmall, false, Align::Right});
    x += width + 2 * text;
  }
}

void add_scale_bar(const Sheet& sheet, const Rect& foot, double pixel, const std::string& unit) {
  const double text = sheet.page.text, length = round_down(0.25 * foot.width * pixel);
  const double right = foot.x + foot.width, left = right - length / pixel, y = foot.y + 1.6 * text,
               tick = 0.3 * text;
  add_line(sheet, {{left, y + tick}, {left, y}, {right, y}, {right, y + tick}}, 0.12 * text);
  add_text(sheet, label_of(length) + " " + unit, 0.5 * (left + right), y + text,
           {kSmall, false, Align::Centre});
}

namespace {

/// One axis as it is drawn from the origin, with its name. [pixel]
struct DrawnAxis {
  double x, y;  // of its tip
  double label_x, label_y;
  Align align;
  std::string name;
  double left, right;  // how far line and name reach
};

std::vector<DrawnAxis> drawn_axes(const Page& page, const ViewAxes& axes,
                                  const Directions& directions) {
  constexpr double kLength = 2.6, kGap = 0.45, kAbove = 0.7;  // of the page's text
  constexpr double kTooShort = 0.1;                           // of its length
  std::vector<DrawnAxis> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 axis = Vec3::Unit(static_cast<int>(k));
    const double right = axis.dot(axes.right), up = axis.dot(axes.up);
    if (std::hypot(right, up) < kTooShort) continue;
    DrawnAxis drawn{};
    drawn.name = directions[k].empty() ? std::string(1, static_cast<char>('x' + k)) : directions[k];
    drawn.x = kLength * page.text * right;
    drawn.y = kLength * page.text * up;
    // Beside a steep axis a name would run over it: it stands above or below.
    const bool steep = std::abs(up) > std::abs(right);
    drawn.align = steep ? Align::Centre : (right > 0 ? Align::Left : Align::Right);
    drawn.label_x = drawn.x + (steep ? 0 : std::copysign(kGap * page.text, right));
    drawn.label_y = drawn.y + (steep ? std::copysign(kAbove * page.text, up) : 0);
    const double width = text_width(drawn.name, kSmall * page.text, false);
    const double before = steep ? 0.5 * width : (right > 0 ? 0 : width);
    drawn.left = std::min({0.0, drawn.x, drawn.label_x - before});
    drawn.right = std::max({0.0, drawn.x, drawn.label_x - before + width});
    result.push_back(std::move(drawn));
  }
  return result;
}

/// Of all of them.
std::pair<double, double> reach_of(const std::vector<DrawnAxis>& axes) {
  double left = 0, right = 0;
  for (const DrawnAxis& axis : axes) {
    left = std::min(left, axis.left);
    right = std::max(right, axis.right);
  }
  return {left, right};
}

}  // namespace

double axes_width(const Page& page, const ViewAxes& axes, const Directions& directions) {
  const auto [left, right] = reach_of(drawn_axes(page, axes, directions));
  return right - left;
}

void add_axes(const Sheet& sheet, const Rect& rect, const ViewAxes& axes,
              const Directions& directions) {
  const double text = sheet.page.text;
  const std::vector<DrawnAxis> drawn = drawn_axes(sheet.page, axes, directions);
  const auto [left, right] = reach_of(drawn);
  const double x = rect.x + 0.5 * (rect.width - (right - left)) - left, y = rect.y + 4.5 * text;
  for (const DrawnAxis& axis : drawn) {
    add_line(sheet, {{x, y}, {x + axis.x, y + axis.y}}, 0.12 * text);
    add_text(sheet, axis.name, x + axis.label_x, y + axis.label_y, {kSmall, false, axis.align});
  }
}

std::vector<double> round_labels(double low, double high) {
  const double power = std::pow(10, std::floor(std::log10((high - low) / 4)));
  double step = power;
  for (const double factor : {1.0, 2.0, 2.5, 5.0, 10.0, 20.0}) {
    step = factor * power;
    if ((high - low) / step < 6) break;
  }
  std::vector<double> labels;
  const double slack = 1e-6 * step;  // round-off of the multiples
  // Not ++first: where the range is round-off of its ends it would stay what it is, for ever.
  const double first = std::ceil((low - slack) / step);
  for (int k = 0; (first + k) * step <= high + slack; ++k)
    labels.push_back((first + k) * step + 0.0);  // no "-0"
  return labels;
}

}  // namespace articular::tools
