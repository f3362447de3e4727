#pragma once

#include <string>
#include <vector>

/// What gnuplot does not do by itself on the logarithmic axes of a picture of cases.
namespace articular::tools {

/// Numbers at an axis from `low` to `high`: powers of ten, and 2 and 5 of them where those are few.
/// @param axis  'x' or 'y'
std::string axis_numbers(char axis, double low, double high);

/// A point as shares of both axes, 0 to 1.
struct SharePoint {
  double x, y;
};

/// On which side of its point the number of each case stands, so that numbers cover neither each
/// other nor points, where there is room: "left offset 0.5,0.5". Cases are numbered from 1.
std::vector<std::string> number_places(const std::vector<SharePoint>& points);

}  // namespace articular::tools
