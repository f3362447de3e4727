#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace articular::tools {

using Rgb = std::array<double, 3>;

/// Colours at equal steps from the low to the high end.
using ColourMap = std::vector<Rgb>;

/// Perceptually uniform, from dark to bright, readable without colour vision:
///   "viridis"   dark blue over green to yellow [Smith, van der Walt 2015, public domain]
///   "magma"     black over purple to pale yellow [the same]
///   "cividis"   blue over grey to yellow [Nuñez, Anderton, Renslow 2018]
/// and for values on both sides of a rest value:
///   "blue-red"  blue over white to red, as dark at both ends [Brewer 2003]
const std::map<std::string, ColourMap>& colour_maps();

/// Dark at rest, bright when active.
ColourMap muscle_colours();
/// Pale without tension, dark teal under most.
ColourMap ligament_colours();

/// Where a value is blank (NaN): in none of the maps.
constexpr Rgb kBlankColour = {0.80, 0.80, 0.80};

/// 256 colours between, interpolated in CIELAB; light grey where a value is blank (NaN).
vtkSmartPointer<vtkLookupTable> colour_table(const ColourMap& map, double low, double high);

}  // namespace articular::tools
