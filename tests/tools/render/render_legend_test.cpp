#include "tools/render/render_legend.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace articular::tools::render_test {

// The longest names, in any view: as wide as axes and names reach, and no word is cut.
TEST(Legend, HasRoomForTheNamesOfItsAxes) {
  const Page page{1600, 1000, 25, std::nullopt};
  const Directions words = {"medial", "posterior", "superior"};
  for (const char* const view :
       {"front", "back", "left", "right", "top", "bottom", "three-quarter"}) {
    const ViewAxes axes = view_axes(view, "", words);
    EXPECT_GT(axes_width(page, axes, words), axes_width(page, axes, {})) << view;
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(axes.to_eye[static_cast<int>(k)]) < 0.9)
        longest = std::max(longest, text_width(words[k], 0.9 * page.text, false));
    EXPECT_GE(axes_width(page, axes, words), longest) << view;
  }
}

// Beside a short title and short numbers "no value" is the widest.
TEST(Legend, HasRoomForNoValue) {
  const Page page{1600, 1000, 25, std::nullopt};
  ColourScale scale;
  scale.title = "p";
  scale.colours = vtkSmartPointer<vtkLookupTable>::New();
  scale.colours->SetRange(0, 1);
  scale.has_blank = true;
  EXPECT_GE(legend_width(page, scale),
            (0.9 + 0.45) * page.text + text_width("no value", 0.9 * page.text, false));
}

TEST(Legend, LabelsAreRoundNumbersInside) {
  EXPECT_EQ(round_labels(0, 100), (std::vector<double>{0, 20, 40, 60, 80, 100}));
  for (int k = 0; k < 61; ++k) {
    const double high = 1e-7 * std::pow(1.7, k);  // to 1e7
    for (const double low : {0.0, -high, 1 - high}) {
      const double top = low == 1 - high ? 1 + high : high;
      const std::vector<double> labels = round_labels(low, top);
      EXPECT_GE(labels.size(), 3U) << low << " " << top;
      EXPECT_LE(labels.size(), 7U) << low << " " << top;
      const double slack = 1e-5 * (top - low);
      EXPECT_GE(labels.front(), low - slack);
      EXPECT_LE(labels.back(), top + slack);
    }
  }
}

// As of a ratio that is 1 but for round-off. Multiples of the step are beyond 2⁵³ there.
TEST(Legend, LabelsEndWhereTheScaleIsAsShortAsRoundOff) {
  const double below = std::nextafter(1.0, 0.0), above = std::nextafter(1.0, 2.0);
  EXPECT_LE(round_labels(1, above).size(), 12U);
  EXPECT_LE(round_labels(below, above).size(), 12U);
}

}  // namespace articular::tools::render_test
