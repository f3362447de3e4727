// `articular plot` as a user meets it: what is in the picture, where, and what is refused how.
#include "tools/plot/plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "tests/tools/plot/svg_page.hpp"
#include "tests/tools/support/program.hpp"

namespace articular::plot_test {

using tools::default_plot_file;

/// Where an axis has a value, from the places of two of its numbers.
struct Scale {
  double at0, per_unit;
  double operator()(double value) const { return at0 + per_unit * value; }
};

Scale scale(double value_a, double place_a, double value_b, double place_b) {
  const double per_unit = (place_b - place_a) / (value_b - value_a);
  return {place_a - per_unit * value_a, per_unit};
}

// Numbers along y are centred on their ticks; the baseline lies 2.8 px below (a third of 7 pt).
constexpr double kPixel = 1;

class Plot : public ::testing::Test {
 protected:
  /// Of a run in a folder of this name: y = 2 t in N, a vector, and a blank.
  void run(const std::string& name, double slope, const std::string& unit = "N",
           const std::string& header_end = "") const {
    std::filesystem::create_directories(folder_ / name);
    std::string text = "time [s],ramp.force [" + unit +
                       "],tip.position.x [mm],tip.position.y [mm],tip.position.z [mm]" +
                       header_end + "\n";
    for (int i = 0; i <= 100; ++i) {
      const double t = 0.005 * i;
      text += std::to_string(t) + "," + std::to_string(slope * t) + "," +
              std::to_string(10 * t * t) + ",1," + (i > 40 && i < 60 ? "" : std::to_string(-t)) +
              (header_end.empty() ? "" : ",0") + "\n";
    }
    folder_.file(name + "/history.csv", text);
    folder_.file(
        name + "/summary.json",
        R"({"outcome": "finished", "settings": {"analysis": "dynamic", "duration_s": 1}})");
  }

  ProgramResult plot(const std::string& arguments) const {
    return run_program(folder_, "plot " + arguments);
  }
  SvgPage page(const std::string& arguments) const {
    const ProgramResult result = plot(arguments + " --out page.svg");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_svg(content(folder_ / "page.svg"));
  }
  void expect_refused(const std::string& arguments, int exit_code, const std::string& words) const {
    const ProgramResult result = plot(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << arguments << "\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
  }

  const TemporaryFolder folder_;
};

/// The scales of a page with one panel, by numbers that stand along its axes.
struct Scales {
  Scale x, y;
};
Scales scales_of(const SvgPage& page, const std::string& x0, const std::string& x1,
                 const std::string& y0, const std::string& y1) {
  const auto number = [](std::string text) {
    if (text.starts_with("−")) text.replace(0, 3, "-");
    return std::atof(text.c_str());
  };
  // A number along y stands left of all along x; both axes may have a 0.
  const auto place = [&](const std::string& text, bool is_x) -> SvgPage::Text {
    const SvgPage::Text* found = nullptr;
    for (const SvgPage::Text& one : page.texts)
      if (one.text == text && (found == nullptr || (is_x ? one.y > found->y : one.y < found->y)))
        found = &one;
    if (found == nullptr) throw std::out_of_range("no number " + text);
    return *found;
  };
  const double baseline = 0.35 * 28.0 / 3;  // [px]
  return {
      scale(number(x0), place(x0, true).x, number(x1), place(x1, true).x),
      scale(number(y0), place(y0, false).y - baseline, number(y1), place(y1, false).y - baseline)};
}

TEST_F(Plot, PointsOfACurveLieWhereTheAxesSay) {
  run("a", 2);
  const SvgPage seen = page("a ramp.force");
  const SvgPage::Shape& curve = seen.shapes.at(0);
  ASSERT_EQ(curve.points.size(), 101U);
  // 0.5 s are shown as 500 ms.
  const Scales at = scales_of(seen, "100", "400", "0.2", "0.8");
  for (const int i : {0, 20, 50, 100}) {
    const double t = 0.005 * i;
    EXPECT_NEAR(curve.points[static_cast<std::size_t>(i)].x, at.x(1e3 * t), 0.5 * kPixel);
    EXPECT_NEAR(curve.points[static_cast<std::size_t>(i)].y, at.y(2 * t), kPixel);
  }
  for (const char* text : {"time [ms]", "force [N]", "ramp.force"})
    EXPECT_NE(seen.find(text), nullptr) << text;
  EXPECT_EQ(seen.width, "85.00mm");
}

TEST_F(Plot, AgainstAnotherProbePointsLieThere) {
  run("a", 2);
  const SvgPage seen = page("a ramp.force --x tip.position.x");
  const SvgPage::Shape& curve = seen.shapes.at(0);
  const Scales at = scales_of(seen, "0.5", "2.0", "0.2", "0.8");
  EXPECT_NEAR(curve.points[80].x, at.x(10 * 0.16), 0.5 * kPixel);
  EXPECT_NEAR(curve.points[80].y, at.y(0.8), kPixel);
  EXPECT_NE(seen.find("tip.position.x [mm]"), nullptr);
}

TEST_F(Plot, ABlankCellIsAGap) {
  run("a", 2);
  const SvgPage seen = page("a tip");
  const auto count = [&](std::size_t curve) {
    const auto& points = seen.shapes.at(curve).points;
    return std::count_if(points.begin(), points.end(), [](const auto& p) { return p.begins; });
  };
  EXPECT_EQ(count(2), 2);
  EXPECT_EQ(count(0), 1);
  for (const char* text : {"x", "y", "z", "tip.position"}) EXPECT_NE(seen.find(text), nullptr);
}

// The legend says which line is z, so a z alone has that line.
TEST_F(Plot, AComponentAloneHasTheLineThatTheLegendGivesIt) {
  run("a", 2, "N", ",tap.force.y [N]");
  const SvgPage seen = page("a tap tip ramp");
  const SvgPage::Shape &alone = seen.shapes.at(0), &x = seen.shapes.at(1), &y = seen.shapes.at(2),
                       &scalar = seen.shapes.at(4);
  EXPECT_EQ(alone.dashes, y.dashes);
  EXPECT_NE(alone.dashes, x.dashes);
  EXPECT_EQ(scalar.dashes, x.dashes);
  const SvgPage without = page("a tap ramp");  // no vector, and no legend
  EXPECT_EQ(without.shapes.at(0).dashes, x.dashes);
}

TEST_F(Plot, RunsShareAPanelAndDifferInDashes) {
  run("a", 2);
  run("b", 2000, "mN");  // the same force in another unit
  run("c", 1);
  const SvgPage seen = page("a b c ramp.force --label intact --label \"it's\" --label cut");
  const SvgPage::Shape &a = seen.shapes.at(0), &b = seen.shapes.at(1), &c = seen.shapes.at(2);
  EXPECT_NE(a.dashes, b.dashes);
  EXPECT_NE(b.dashes, c.dashes);
  EXPECT_NEAR(a.points[70].y, b.points[70].y, 0.02);
  EXPECT_GT(c.points[70].y, a.points[70].y + 10 * kPixel);  // y goes down the page
  for (const char* text : {"intact", "it's", "cut"}) EXPECT_NE(seen.find(text), nullptr);
}

TEST_F(Plot, ARunWithoutTheProbeIsTold) {
  run("a", 2);
  run("b", 2, "N", ",extra.area [mm^2]");
  const ProgramResult result = plot("a b extra --out page.svg");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("a has no `extra.area`"), std::string::npos) << result.err;
  EXPECT_EQ(read_svg(content(folder_ / "page.svg")).shapes.size(), 1U);
}

TEST_F(Plot, ABandLiesBetweenItsEndsInAnyUnit) {
  run("a", 2);
  folder_.file("published.csv", "time [ms],low [um],high [cm]\n0,500,0.1\n500,1000,0.2\n");
  const SvgPage seen =
      page("a tip.position.x --band tip.position.x=published.csv --range '0..2.5 mm'");
  const Scales at = scales_of(seen, "100", "400", "0.5", "2.0");
  double least = 1e9, most = 0;
  for (const auto& point : seen.shapes.at(0).points) {
    if (std::abs(point.x - at.x(500)) > kPixel) continue;
    least = std::min(least, point.y);
    most = std::max(most, point.y);
  }
  EXPECT_NEAR(most, at.y(1), kPixel);
  EXPECT_NEAR(least, at.y(2), kPixel);
  EXPECT_NE(seen.find("published"), nullptr);
  const SvgPage constant = page("a --band 'tip=1..2 mm' --x-range '0..0.4 s'");
  EXPECT_NE(constant.find("published range"), nullptr);
  EXPECT_EQ(constant.shapes.at(1).points.size(), 4U);
}

TEST_F(Plot, ABandOfAComponentLiesInThePanelOfItsVector) {
  run("a", 2);
  const SvgPage seen = page("a tip --band 'tip.position.z=-1..0 mm'");
  ASSERT_EQ(seen.shapes.size(), 4U);
  EXPECT_EQ(seen.shapes.at(0).points.size(), 4U);
  expect_refused("a tip --band 'tip.position.w=-1..0 mm'", 2, "no panel shows a probe");
}

TEST_F(Plot, ARangeBesideAllCurvesIsWarnedOf) {
  run("a", 2);  // ramp.force goes from 0 to 1 N in half a second
  const std::string warning = "no curve of `ramp.force` comes into the range";
  for (const char* beside : {"--range '5..9 N'", "--x-range '2..3 s'", "--range '-3..-1 N'"}) {
    const ProgramResult result = plot(std::string("a ramp ") + beside);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find(warning), std::string::npos) << beside << result.err;
  }
  // Between two points of the curve, too.
  for (const char* within : {"--range '0.501..0.502 N'", "--x-range '0.2..0.3 s'"})
    EXPECT_EQ(plot(std::string("a ramp ") + within).err.find("comes into"), std::string::npos)
        << within;
}

TEST_F(Plot, TheLastValueHasItsErrorBar) {
  run("a", 2);
  folder_.file("a/error_bars.csv",
               "column,quantity,value,bar,verdict\nramp.force [N],end,1,0.2,asymptotic\n"
               "tip.position.x [mm],end,2.5,,not estimated (mesh)\n"
               "tip.position.y [mm],end,7,0.1,asymptotic\n");
  const SvgPage seen = page("a ramp --range '0..2 N'");
  const Scales at = scales_of(seen, "100", "400", "0.5", "1.5");
  double least = 1e9, most = 0;
  for (const auto& point : seen.shapes.at(1).points) {
    least = std::min(least, point.y);
    most = std::max(most, point.y);
  }
  EXPECT_NEAR(least, at.y(1.2), kPixel);
  EXPECT_NEAR(most, at.y(0.8), kPixel);
  const ProgramResult told = plot("a tip --out page.svg");
  EXPECT_NE(told.err.find("no error bar of `tip.position.x`: not estimated (mesh)"),
            std::string::npos)
      << told.err;
  EXPECT_NE(told.err.find("another last value"), std::string::npos) << told.err;
}

TEST_F(Plot, StaticsGoesOnWithTheLoad) {
  run("a", 2);
  folder_.file("a/summary.json",
               R"({"outcome": "finished", "settings": {"analysis": "static", "duration_s": 0.5}})");
  const SvgPage seen = page("a ramp");
  EXPECT_NE(seen.find("load [%]"), nullptr);
  EXPECT_NE(seen.find("100"), nullptr);
  run("b", 2);
  expect_refused("a b ramp", 2, "some of these runs are static");
}

TEST_F(Plot, WhatStaysZeroIsDrawnWhereItIsNamed) {
  run("a", 2, "N", ",nothing.force [N]");
  const ProgramResult all = plot("a --out page.svg");
  EXPECT_NE(all.err.find("0 in all rows, so drawn only where it is named: `nothing.force`"),
            std::string::npos)
      << all.err;
  EXPECT_EQ(read_svg(content(folder_ / "page.svg")).find("nothing.force"), nullptr);
  EXPECT_NE(page("a nothing").find("nothing.force"), nullptr);
}

TEST_F(Plot, TextsNeitherRunNorChange) {
  const std::string name = R"(p$(touch pwned)`touch pwned`'"%_^{x}\n@a<&>)";
  std::filesystem::create_directories(folder_ / "a");
  folder_.file("a/history.csv", "time [s]," + name + ".b [mm]\n0,1\n1,2\n");
  for (const char* file : {"page.svg", "page.pdf"})
    EXPECT_EQ(plot(std::string("a --size 170 --out ") + file).exit_code, 0) << file;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "pwned"));
  EXPECT_NE(read_svg(content(folder_ / "page.svg")).find(name + ".b"), nullptr);
}

TEST_F(Plot, APdfHasItsFontsInIt) {
  run("a", 2);
  EXPECT_EQ(plot("a --out page.pdf").exit_code, 0);
  const std::string pdf = content(folder_ / "page.pdf");
  EXPECT_TRUE(pdf.starts_with("%PDF"));
  EXPECT_NE(pdf.find("/FontFile"), std::string::npos);
}

TEST_F(Plot, SizeIsInMillimetres) {
  run("a", 2);
  const SvgPage seen = page("a --size 120x70");
  EXPECT_EQ(seen.width, "120.00mm");
  EXPECT_EQ(seen.height, "70.00mm");
}

TEST_F(Plot, DefaultNamesTellWhatIsInTheFile) {
  EXPECT_EQ(default_plot_file({"out/a"}, {}, ""), "out/a/plot/all.svg");
  EXPECT_EQ(default_plot_file({"out/a"}, {"tip", "b.x"}, "c"), "out/a/plot/tip+b.x-over-c.svg");
  EXPECT_EQ(default_plot_file({"out/a", "out/b"}, {"tip"}, ""), "plot/a+b-tip.svg");
  EXPECT_NE(default_plot_file({"a"}, {"t*p"}, ""), default_plot_file({"a"}, {"t_p"}, ""));
  EXPECT_EQ(default_plot_file({"a"}, {"../../x"}, "").parent_path(), "a/plot");
  EXPECT_LT(default_plot_file({"a"}, {std::string(1000, 'x')}, "").filename().string().size(),
            200U);
  run("a", 2);
  EXPECT_NE(plot("a ramp").out.find("wrote a/plot/ramp.svg (1 panel"), std::string::npos);
}

TEST_F(Plot, TheLabelsOfFoldersTellThemApart) {
  EXPECT_EQ(tools::folder_labels({"out/a/", "out/b"}), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(tools::folder_labels({"x/run", "y/run"}), (std::vector<std::string>{"x/run", "y/run"}));
}

TEST_F(Plot, BadInputIsOneLineAndWritesNothing) {
  run("a", 2);
  run("metres", 2, "m");
  std::filesystem::create_directories(folder_ / "empty");
  expect_refused("none", 2, "none: no such folder");
  expect_refused("empty", 2, "empty: no history.csv here");
  expect_refused("a a/history.csv", 2, "expected the folder of a run");
  expect_refused("a rampp", 2, "no run has a probe \"rampp\"; did you mean `ramp`?");
  expect_refused("a $'x\\x1b'", 2, "no run has a probe");
  expect_refused("a ramp --x tip.position", 2, "did you mean `tip.position.x`?");
  expect_refused("a ramp --band '1..2 mm'", 2, "--band: a length is given, and no panel shows one");
  expect_refused("a ramp --range 0..1", 2,
                 "--range: numbers without a unit are given, and no panel shows such: `ramp.force` "
                 "is in N");
  expect_refused("a ramp --band 'ramp=1..2 mm'", 2, "expected a force, found a length");
  expect_refused("a --band 'tap=1..2 mm'", 2, "no panel shows a probe \"tap\"");
  expect_refused("a ramp --x-range '1..2 mm'", 2, "--x-range: expected a time, found a length");
  expect_refused("a metres ramp", 2, "metres: column `ramp.force`: expected a force");
  expect_refused("a ramp --size 3", 2, "--size");
  expect_refused("a ramp --label x --label y", 2, "--label: 2 for 1 runs");
  expect_refused("a ramp --out page.jpg", 2, "expected a file name that ends in .svg or .pdf");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "page.jpg"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a/plot"));
}

TEST_F(Plot, WhatTheSystemRefusesIsOneLine) {
  run("a", 2);
  expect_refused("a ramp --out none/page.svg", 4, "none/page.svg: can't be written");
  const ProgramResult missing = run_shell(folder_, "PATH=/none \"$articular\" plot a ramp");
  EXPECT_EQ(missing.exit_code, 4);
  EXPECT_NE(missing.err.find("apt install gnuplot-nox"), std::string::npos) << missing.err;
}

TEST_F(Plot, AnInterruptedOneWritesNothingAndLeavesNothing) {
  run("a", 2);
  std::filesystem::create_directories(folder_ / "bin");
  std::filesystem::create_directories(folder_ / "tmp");
  folder_.file("bin/gnuplot", "#!/bin/sh\ntouch started\nexec sleep 20\n");
  std::filesystem::permissions(folder_ / "bin/gnuplot", std::filesystem::perms::owner_all);
  const ProgramResult result = run_shell(
      folder_,
      "export TMPDIR=$PWD/tmp PATH=$PWD/bin:$PATH; \"$articular\" plot a ramp --out page.svg & "
      "while [ ! -e started ]; do sleep 0.05; done; kill -TERM $!; wait $!");
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "page.svg"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp"));
}

TEST_F(Plot, ARealRunIsDrawn) {
  folder_.file("scene.toml", R"(
duration = "2 ms"
[integrator]
step = "0.5 ms"
[[body]]
name = "ball"
kind = "rigid"
density = "1 g/cm^3"
velocity = "1 0 0 m/s"
geometry = { box = { size = "4 4 4 mm", cells = [1, 1, 1] } }
[[probe]]
name = "centre"
kind = "point"
body = "ball"
point = "0 0 0 mm"
)");
  ASSERT_EQ(run_program(folder_, "run scene.toml --out out --quiet").exit_code, 0);
  const ProgramResult result = plot("out centre.position.x --out page.svg");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const SvgPage seen = read_svg(content(folder_ / "page.svg"));
  const auto& points = seen.shapes.at(0).points;
  ASSERT_EQ(points.size(), 5U);
  // Free flight at 1 m/s: 2 mm in 2 ms, along a straight line.
  const Scales at = scales_of(seen, "0.5", "2.0", "0.5", "2.0");
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(points[i].x, at.x(0.5 * static_cast<double>(i)), 0.5 * kPixel);
    EXPECT_NEAR(points[i].y, at.y(0.5 * static_cast<double>(i)), kPixel);
  }
}

}  // namespace articular::plot_test
