// The page in a real browser: Debian's Chromium, without a display, as browser.mjs uses it.
#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <set>

#include "tests/tools/report/reported_run.hpp"

namespace articular::tools::report_test {

vtkSmartPointer<vtkImageData> read_picture(const std::filesystem::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::array<int, 3> colour_at(vtkImageData& picture, vtkIdType i) {
  const int channels = picture.GetNumberOfScalarComponents();
  const auto* const bytes = static_cast<const unsigned char*>(picture.GetScalarPointer());
  return {bytes[channels * i], bytes[channels * i + 1], bytes[channels * i + 2]};
}

/// The share of pixels that differ clearly.
double difference(vtkImageData& a, vtkImageData& b) {
  EXPECT_EQ(a.GetNumberOfPoints(), b.GetNumberOfPoints());
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < std::min(a.GetNumberOfPoints(), b.GetNumberOfPoints()); ++i) {
    const auto x = colour_at(a, i), y = colour_at(b, i);
    count += std::abs(x[0] - y[0]) + std::abs(x[1] - y[1]) + std::abs(x[2] - y[2]) > 40 ? 1 : 0;
  }
  return static_cast<double>(count) / static_cast<double>(a.GetNumberOfPoints());
}

/// Colours in a picture that are far from grey, in steps of 32: a scene has many of them.
std::size_t num_colours(vtkImageData& picture) {
  std::set<std::array<int, 3>> colours;
  for (vtkIdType i = 0; i < picture.GetNumberOfPoints(); ++i) {
    const auto [r, g, b] = colour_at(picture, i);
    if (std::max({r, g, b}) - std::min({r, g, b}) > 40) colours.insert({r / 32, g / 32, b / 32});
  }
  return colours.size();
}

/// Pixels of about this colour.
vtkIdType num_pixels_like(const std::array<int, 3>& colour, vtkImageData& picture) {
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < picture.GetNumberOfPoints(); ++i) {
    const auto found = colour_at(picture, i);
    count += std::abs(found[0] - colour[0]) <= 2 && std::abs(found[1] - colour[1]) <= 2 &&
                     std::abs(found[2] - colour[2]) <= 2
                 ? 1
                 : 0;
  }
  return count;
}

/// A page of a run, opened on a desk and on a phone.
class Browser : public ::testing::TestWithParam<std::pair<int, int>> {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const ProgramResult run = run_block(*folder_);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    std::filesystem::create_directories(*folder_ / "block/plot");
    folder_->file("block/plot/all.svg",
                  "<svg xmlns='http://www.w3.org/2000/svg' width='70' height='30'/>");
    const ProgramResult report =
        run_program(*folder_, "report block && \"$articular\" report block.toml");
    ASSERT_EQ(report.exit_code, 0) << report.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static nlohmann::json open(const std::string& page, std::pair<int, int> size) {
    const ProgramResult seen =
        run_shell(*folder_, fmt::format("node '" ARTICULAR_SOURCE_DIR
                                        "/tests/tools/report/browser.mjs' {} {} {} .",
                                        page, size.first, size.second));
    EXPECT_EQ(seen.exit_code, 0) << seen.err << seen.out;
    return nlohmann::json::parse(seen.out, nullptr, false);
  }

  static vtkSmartPointer<vtkImageData> picture(const std::string& name) {
    return read_picture(*folder_ / (name + ".png"));
  }

  static std::unique_ptr<TemporaryFolder> folder_;
};

std::unique_ptr<TemporaryFolder> Browser::folder_;

TEST_P(Browser, ShowsARunWithoutAnErrorAndWithoutAnyRequest) {
  const nlohmann::json seen = open("block/report.html", GetParam());
  ASSERT_TRUE(seen.is_object());
  EXPECT_EQ(seen["state"], "ready");
  EXPECT_EQ(seen["errors"], nlohmann::json::array());
  EXPECT_EQ(seen["requests"], nlohmann::json::array());
  EXPECT_EQ(seen["sections"], (nlohmann::json{"summary", "view", "curves", "pictures", "trust",
                                              "settings", "timings", "provenance"}));
  EXPECT_EQ(seen["widthsOfPictures"], nlohmann::json::array({70}));
  const std::string text = seen["text"];
  for (const char* const words : {"A block <pulled> & </script> pressed", "The run finished."})
    EXPECT_NE(text.find(words), std::string::npos) << words;
  // Nothing sticks out to the right.
  EXPECT_LE(seen["width"][0], seen["width"][1]);

  // Curves: each plot has a line in colour.
  EXPECT_EQ(seen["inkOfPlots"].size(), 4U);
  for (const nlohmann::json& ink : seen["inkOfPlots"]) EXPECT_GT(ink, 100);

  // The 3D view: many shades of tissue, which another moment and a cut change. What is clicked on
  // tells its name and value.
  const auto last = picture("last");
  EXPECT_GT(num_colours(*last), 8U);
  EXPECT_GT(difference(*last, *picture("first")), 0.01);
  EXPECT_GT(difference(*picture("first"), *picture("cut")), 0.01);
  // Without shading a value beyond the upper end has the colour that ends the legend, #fde725.
  constexpr std::array<int, 3> kHighest = {253, 231, 37};
  EXPECT_GT(num_pixels_like(kHighest, *picture("above")),
            5 * num_pixels_like(kHighest, *last) + last->GetNumberOfPoints() / 100);
  EXPECT_NE(seen["legend"].get<std::string>().find("von Mises stress [kPa]"), std::string::npos);
  const std::string readout = seen["readout"];
  EXPECT_EQ(readout.find("block von Mises stress "), 0U) << readout;
  EXPECT_NE(readout.find(" kPa, at ("), std::string::npos) << readout;
}

INSTANTIATE_TEST_SUITE_P(OnADeskAndOnAPhone, Browser,
                         ::testing::Values(std::pair(1280, 800), std::pair(390, 844)));

TEST_F(Browser, ShowsAScenarioBeforeAnyRun) {
  const nlohmann::json seen = open("block_setup.html", {1280, 800});
  ASSERT_TRUE(seen.is_object());
  EXPECT_EQ(seen["state"], "ready");
  EXPECT_EQ(seen["errors"], nlohmann::json::array());
  EXPECT_EQ(seen["sections"], (nlohmann::json{"summary", "view", "settings"}));
  EXPECT_GT(num_colours(*picture("last")), 3U);
  const std::string readout = seen["readout"];
  EXPECT_NE(readout.find("material.young_modulus: 50 kPa"), std::string::npos) << readout;
}

TEST_F(Browser, TellsPressuresOfAPopulationInMegapascal) {
  folder_->file("press.toml", R"(
title = "Presses"
command = ["sh", "-c", "printf 'time [s],p [Pa],f [N]\\n0,{p}e6,{p}e6\\n' > history.csv"]
[population]
samples = 4
[[parameter]]
name = "p"
distribution = "uniform"
lowest = 1
highest = 2
[[output]]
name = "pressure"
column = "p [Pa]"
[[output]]
name = "force"
column = "f [N]"
)");
  const ProgramResult study = run_program(*folder_, "study press.toml --quiet");
  ASSERT_EQ(study.exit_code, 0) << study.err;
  const nlohmann::json seen = open("out/press/population.html", {1280, 800});
  ASSERT_TRUE(seen.is_object());
  EXPECT_EQ(seen["errors"], nlohmann::json::array());
  EXPECT_EQ(seen["sections"], (nlohmann::json{"output-1", "output-2", "parameters", "program"}));
  const std::string text = seen["text"];
  EXPECT_NE(text.find(" MPa"), std::string::npos) << text;
  EXPECT_EQ(text.find("e+6 Pa"), std::string::npos) << text;
  EXPECT_NE(text.find("e+6 N"), std::string::npos) << text;
}

}  // namespace articular::tools::report_test
