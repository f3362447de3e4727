#include "tools/render/paper.hpp"

#include <vtkNamedColors.h>
#include <vtkNew.h>

#include "sim/base/error.hpp"

namespace articular::tools {

Paper paper_of(const std::string& name) {
  Paper paper;
  if (name == "transparent") {
    paper.transparent = true;
    return paper;
  }
  vtkNew<vtkNamedColors> colours;
  if (!colours->ColorExists(name))
    throw sim::InputError("--background: unknown colour `" + name +
                          "`; expected white, black, transparent or another name of a colour in "
                          "CSS, e.g. lightgray");
  double c[4];
  colours->GetColor(name, c[0], c[1], c[2], c[3]);
  paper.ground = {c[0], c[1], c[2]};
  const double brightness = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];  // [ITU-R BT.601]
  if (brightness < 0.5) paper.ink = {0.95, 0.95, 0.95};
  return paper;
}

}  // namespace articular::tools
