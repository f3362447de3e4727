#include "tools/render/colour_map.hpp"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

namespace articular::tools {

constexpr Rgb kBlank = {0.80, 0.80, 0.80};

ColourMap viridis() {
  return {{0.267, 0.005, 0.329}, {0.283, 0.141, 0.458}, {0.254, 0.265, 0.530},
          {0.207, 0.372, 0.553}, {0.164, 0.471, 0.558}, {0.128, 0.567, 0.551},
          {0.135, 0.659, 0.518}, {0.267, 0.749, 0.441}, {0.478, 0.821, 0.318},
          {0.741, 0.873, 0.150}, {0.993, 0.906, 0.144}};
}

ColourMap cool_to_warm() {
  return {{0.230, 0.299, 0.754},
          {0.552, 0.690, 0.996},
          {0.865, 0.865, 0.865},
          {0.956, 0.604, 0.486},
          {0.706, 0.016, 0.150}};
}

ColourMap muscle_colours() { return {{0.34, 0.09, 0.10}, {0.72, 0.13, 0.12}, {1.00, 0.42, 0.30}}; }

vtkSmartPointer<vtkLookupTable> colour_table(const ColourMap& map, double low, double high) {
  constexpr int kNumColours = 256;
  vtkNew<vtkColorTransferFunction> between;
  between->SetColorSpaceToLab();
  for (std::size_t i = 0; i < map.size(); ++i)
    between->AddRGBPoint(static_cast<double>(i) / static_cast<double>(map.size() - 1), map[i][0],
                         map[i][1], map[i][2]);
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kNumColours);
  table->SetRange(low, high);
  table->SetNanColor(kBlank[0], kBlank[1], kBlank[2], 1);
  for (int i = 0; i < kNumColours; ++i) {
    Rgb c{};
    between->GetColor(static_cast<double>(i) / (kNumColours - 1), c.data());
    table->SetTableValue(i, c[0], c[1], c[2]);
  }
  return table;
}

}  // namespace articular::tools
