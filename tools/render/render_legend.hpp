#pragma once

#include <vtkLookupTable.h>
#include <vtkRenderer.h>

#include <string>
#include <vector>

/// What is read in a picture: text and colour scales, placed in fractions of the picture from its
/// lower left corner.
namespace articular::tools {

enum class Align { Left, Centre, Right };

struct TextStyle {
  int size;  // [pixel]
  bool bold = false;
  Align align = Align::Left;  // of x; y is the middle of the line
};

void add_text(vtkRenderer& renderer, const std::string& text, double x, double y, TextStyle style);

struct Box {
  double x, y, width, height;
};

/// The colours of a table, low at the bottom of an upright box, or at the left of a lying one.
void add_colour_bar(vtkRenderer& renderer, vtkLookupTable& colours, const Box& box);

/// Labels of a scale: 4 to 6 round numbers from its low to its high end.
std::vector<double> round_labels(double low, double high);

/// The next of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below the value.
double round_up(double value);

}  // namespace articular::tools
