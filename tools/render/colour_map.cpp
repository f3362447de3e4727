#include "tools/render/colour_map.hpp"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

namespace articular::tools {
namespace {

/// Of 0xRRGGBB.
ColourMap of_bytes(std::initializer_list<unsigned> colours) {
  ColourMap map;
  for (const unsigned c : colours)
    map.push_back({((c >> 16) & 0xFF) / 255.0, ((c >> 8) & 0xFF) / 255.0, (c & 0xFF) / 255.0});
  return map;
}

}  // namespace

const std::map<std::string, ColourMap>& colour_maps() {
  static const std::map<std::string, ColourMap> kMaps = {
      {"viridis", of_bytes({0x440154, 0x482576, 0x414487, 0x35608D, 0x2A788E, 0x21908C, 0x22A884,
                            0x43BF71, 0x7AD151, 0xBBDF27, 0xFDE725})},
      {"magma", of_bytes({0x000004, 0x140E36, 0x3B0F70, 0x641A80, 0x8C2981, 0xB73779, 0xDE4968,
                          0xF7705C, 0xFE9F6D, 0xFECF92, 0xFCFDBF})},
      {"cividis", of_bytes({0x00204D, 0x00336F, 0x39486B, 0x575C6D, 0x707173, 0x8A8779, 0xA69D75,
                            0xC4B56C, 0xE4CF5B, 0xFFEA46})},
      {"blue-red", of_bytes({0x053061, 0x2166AC, 0x4393C3, 0x92C5DE, 0xD1E5F0, 0xF7F7F7, 0xFDDBC7,
                             0xF4A582, 0xD6604D, 0xB2182B, 0x67001F})}};
  return kMaps;
}

ColourMap muscle_colours() { return {{0.34, 0.09, 0.10}, {0.72, 0.13, 0.12}, {1.00, 0.42, 0.30}}; }

ColourMap ligament_colours() {
  return {{0.60, 0.84, 0.87}, {0.16, 0.55, 0.62}, {0.01, 0.20, 0.29}};
}

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
  table->SetNanColor(kBlankColour[0], kBlankColour[1], kBlankColour[2], 1);
  for (int i = 0; i < kNumColours; ++i) {
    Rgb c{};
    between->GetColor(static_cast<double>(i) / (kNumColours - 1), c.data());
    table->SetTableValue(i, c[0], c[1], c[2]);
  }
  return table;
}

}  // namespace articular::tools
