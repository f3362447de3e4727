#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <array>
#include <vector>

namespace articular::tools {

using Rgb = std::array<double, 3>;

/// Colours at equal steps from the low to the high end.
using ColourMap = std::vector<Rgb>;

/// Perceptually uniform, dark blue to yellow, readable without colour vision. [Smith, van der Walt
/// 2015, matplotlib, public domain]
ColourMap viridis();
/// Blue over grey to red, for values on both sides of a rest value. [Moreland 2009]
ColourMap cool_to_warm();
/// Dark at rest, bright when active.
ColourMap muscle_colours();

/// 256 colours between, interpolated in CIELAB; light grey where a value is blank (NaN).
vtkSmartPointer<vtkLookupTable> colour_table(const ColourMap& map, double low, double high);

}  // namespace articular::tools
