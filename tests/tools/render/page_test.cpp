#include "tools/render/page.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.hpp"

namespace articular::tools::render_test {

std::string page_error(const std::string& size, std::optional<double> dpi) {
  try {
    page_of(size, dpi);
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Page, MillimetresArePixelsAtTheResolutionOfPrint) {
  const Page page = page_of("170x110 mm", std::nullopt);
  EXPECT_EQ(page.width, std::lround(170 / 25.4 * 300));
  EXPECT_EQ(page.height, std::lround(110 / 25.4 * 300));
  EXPECT_EQ(page.dpi, 300);
  EXPECT_EQ(page_of("1600x1000", std::nullopt).width, 1600);
  EXPECT_FALSE(page_of("1600x1000", std::nullopt).dpi);
}

// In print text is 8 points high at any resolution: twice the dots, twice the pixels.
TEST(Page, PrintLooksTheSameAtAnyResolution) {
  const Page coarse = page_of("170x110mm", 150), fine = page_of("170x110mm", 600);
  EXPECT_DOUBLE_EQ(coarse.text / 150, 8 / 72.0);
  EXPECT_DOUBLE_EQ(fine.text, 4 * coarse.text);
  EXPECT_NEAR(fine.width, 4 * coarse.width, 4);
}

TEST(Page, WhatIsNoSizeIsRefused) {
  for (const char* const size :
       {"", "100", "1x2x3", "axb", "100x", "100.5x80", "100x80cm", "nanx80"})
    EXPECT_EQ(page_error(size, std::nullopt).rfind("--size: expected WIDTHxHEIGHT", 0), 0U) << size;
  EXPECT_EQ(page_error("1x1000", std::nullopt),
            "--size 1x1000: expected 64 to 8192 pixels each way");
  EXPECT_EQ(page_error("9000x100mm", std::nullopt).rfind("--size 9000x100mm: expected 64 to", 0),
            0U);
  EXPECT_EQ(page_error("300x300", 300).rfind("--size 300x300: at 300 dpi there is no room", 0), 0U);
  EXPECT_EQ(page_error("300x300", -1).rfind("--dpi -1: expected", 0), 0U);
}

TEST(Page, NothingStandsOverTheScene) {
  for (const char* const size : {"1600x1000", "64x64", "400x3000", "85x70mm"})
    for (const int panels : {1, 2, 4}) {
      const Page page = page_of(size, std::nullopt);
      const PageLayout layout = lay_out(page, panels, 8 * page.text);
      double right = 0;
      for (std::size_t i = 0; i < layout.panels.size(); ++i) {
        const Rect &panel = layout.panels[i], &heading = layout.headings[i];
        EXPECT_GT(panel.width, 0);
        EXPECT_GT(panel.height, 0.5 * page.height - page.text);
        EXPECT_GE(panel.x, right);
        right = panel.x + panel.width;
        EXPECT_GE(heading.y, panel.y + panel.height);
        EXPECT_LE(heading.y + heading.height, page.height + 1e-9);
        EXPECT_GE(panel.y, layout.foot.y + layout.foot.height);
      }
      EXPECT_LE(right, layout.legend.x);
      EXPECT_LE(layout.legend.x + layout.legend.width, page.width);
    }
}

}  // namespace articular::tools::render_test
