#include "tools/plot/gnuplot_script.hpp"

#include <gtest/gtest.h>

namespace articular::tools::gnuplot_script_test {

// In single quotes nothing but the quote itself has a meaning to gnuplot; two stand for one.
TEST(GnuplotText, NothingInItHasAMeaning) {
  EXPECT_EQ(gnuplot_text("a.b_c^{2} 100% $(touch x) `touch x` \"q\" \\n @m"),
            "'a.b_c^{2} 100% $(touch x) `touch x` \"q\" \\n @m'");
  EXPECT_EQ(gnuplot_text("it's"), "'it''s'");
  EXPECT_EQ(gnuplot_text("''"), "''''''");
  EXPECT_EQ(gnuplot_text("\\'"), "'\\'''");
}

TEST(GnuplotText, IsOneLineOfUtf8ThatXmlAllows) {
  EXPECT_EQ(gnuplot_text("a\nsystem 'x'\r\t\x1b\x7f"), "'a system ''x''    '");
  EXPECT_EQ(gnuplot_text("µ − … 𝄞"), "'µ − … 𝄞'");
  const std::string unknown = "\xEF\xBF\xBD";
  EXPECT_EQ(gnuplot_text("\xff"), "'" + unknown + "'");
  EXPECT_EQ(gnuplot_text("\xC3'"), "'" + unknown + "'''");             // a character cut short
  EXPECT_EQ(gnuplot_text("\xC0\xA7"), "'" + unknown + unknown + "'");  // a quote written too long
  EXPECT_EQ(gnuplot_text("\xE0\x83\xA9").find('\xE0'), std::string::npos);  // an é too long
  EXPECT_EQ(gnuplot_text("\xED\xA0\x80").find('\xED'), std::string::npos);  // half of a pair
  EXPECT_EQ(gnuplot_text("\xEF\xBF\xBE").find('\xBE'), std::string::npos);  // no character
}

TEST(FittingText, KeepsBothEndsAndWholeCharacters) {
  EXPECT_EQ(fitting("short", 100), "short");
  const std::string text = fitting("tibial_cartilage_medial.max_face_pressure", 30);
  EXPECT_LE(text_width(text), 30);
  EXPECT_TRUE(text.starts_with("tibial")) << text;
  EXPECT_TRUE(text.ends_with("pressure")) << text;
  EXPECT_EQ(fitting("ééééééééééééééé", 3 * text_width("é")), "é…é");
}

TEST(PageLayout, FramesAreOnThePageAndApart) {
  for (const std::size_t n : {1U, 2U, 3U, 5U, 14U, 60U}) {
    Figure figure;
    figure.panels.resize(n);
    for (FigurePanel& panel : figure.panels) panel.x.range = panel.y.range = {0, 1};
    figure.legend.resize(5, {"a run with a name", LegendEntry::Kind::Curve, 0});
    const PageLayout page = page_layout(figure, {});
    EXPECT_EQ(page.width, n == 1 ? 85 : 170);
    for (std::size_t i = 0; i < n; ++i) {
      const Rectangle& a = page.frames[i];
      EXPECT_TRUE(a.left > 0 && a.right < page.width && a.bottom > 0 && a.top < page.height);
      for (const PlacedEntry& entry : page.legend) EXPECT_GT(entry.middle, a.top);
      for (std::size_t j = 0; j < i; ++j) {
        const Rectangle& b = page.frames[j];
        EXPECT_TRUE(a.left >= b.right || b.left >= a.right || a.top <= b.bottom);
      }
    }
  }
}

TEST(PageLayout, TakesTheSizeThatIsAskedFor) {
  Figure figure;
  figure.panels.resize(2);
  for (FigurePanel& panel : figure.panels) panel.x.range = panel.y.range = {0, 1};
  const PageLayout page = page_layout(figure, {120, 60});
  EXPECT_EQ(page.width, 120);
  EXPECT_EQ(page.height, 60);
  EXPECT_GT(page.frames[0].height(), 30);
  EXPECT_ANY_THROW(page_layout(figure, {120, 25}));
}

TEST(Ticks, NumbersAlongXAreApart) {
  for (const double width : {15.0, 30.0, 70.0, 150.0})
    for (const double high : {1.0, 37.0, 1234.0, 99999.0}) {
      const AxisRange range{-0.2 * high, high};
      const Ticks divided = x_ticks(range, {0, width, 0, 30});
      for (std::size_t i = 1; i < divided.at.size() && divided.at.size() > 2; ++i)
        EXPECT_GT((divided.at[i] - divided.at[i - 1]) / (1.2 * high) * width,
                  text_width(divided.labels[i]));
    }
}

}  // namespace articular::tools::gnuplot_script_test
