#include "tools/render/render_legend.hpp"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCoordinate.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <array>
#include <cmath>

namespace articular::tools {
namespace {

constexpr std::array<double, 3> kInk = {0.16, 0.19, 0.23};

}  // namespace

void add_text(vtkRenderer& renderer, const std::string& text, double x, double y, TextStyle style) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  vtkTextProperty& property = *actor->GetTextProperty();
  property.SetFontFamilyToArial();
  property.SetFontSize(style.size);
  property.SetBold(style.bold ? 1 : 0);
  property.SetColor(kInk[0], kInk[1], kInk[2]);
  property.SetVerticalJustificationToCentered();
  if (style.align == Align::Left) property.SetJustificationToLeft();
  if (style.align == Align::Centre) property.SetJustificationToCentered();
  if (style.align == Align::Right) property.SetJustificationToRight();
  renderer.AddActor2D(actor);
}

void add_colour_bar(vtkRenderer& renderer, vtkLookupTable& colours, const Box& box) {
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
  vtkNew<vtkCoordinate> fractions;
  fractions->SetCoordinateSystemToNormalizedViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(bar);
  mapper->SetTransformCoordinate(fractions);
  mapper->SetLookupTable(&colours);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  renderer.AddActor2D(actor);
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

double round_up(double value) {
  if (!(value > 0)) return 1;
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (factor * power >= value * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

}  // namespace articular::tools
