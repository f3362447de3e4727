#include "tools/render/setup_picture.hpp"

#include "tests/tools/render/drawing.hpp"

namespace articular::tools::render_test {

/// Pixels where one channel stands out: of red, muscles, but neither background nor bones.
int num_pixels_of(int channel, vtkImageData& image) {
  const auto* const bytes = static_cast<const unsigned char*>(image.GetScalarPointer());
  int count = 0;
  for (vtkIdType i = 0; i < image.GetNumberOfPoints(); ++i) {
    const auto of = [&](int shift) { return bytes[3 * i + (channel + shift) % 3]; };
    count += of(0) > 2 * of(1) && of(0) > 2 * of(2) ? 1 : 0;
  }
  return count;
}
int num_red_pixels(vtkImageData& image) { return num_pixels_of(0, image); }
int num_green_pixels(vtkImageData& image) { return num_pixels_of(1, image); }
int num_blue_pixels(vtkImageData& image) { return num_pixels_of(2, image); }

/// A block that is attached below, and a muscle to its top.
constexpr const char* kSetup = R"(
duration = "1 ms"
[[body]]
name = "floor"
kind = "fixed"
geometry = { box = { size = "8 8 1 mm", cells = [1, 1, 1], center = "0 0 -2.6 mm" } }
[[body]]
name = "block"
kind = "tissue"
density = "1 g/cm^3"
material = { law = "linear", young_modulus = "5 MPa", poisson_ratio = 0.3, element = "plain" }
geometry = { box = { size = "4 4 4 mm", cells = [2, 2, 2] } }
[[body]]
name = "post"
kind = "fixed"
[[attach]]
body = "block"
to = "floor"
region = { box = ["-9 -9 -2.1 mm", "9 9 -1.9 mm"] }
[[muscle]]
name = "lip"
path = [{ body = "post", point = "0 0 8 mm" }, { body = "block", point = "0 0 2 mm", radius = "2.5 mm" }]
max_force = "3 N"
)";

TEST_F(Drawing, AScenarioIsDrawnBeforeAnyRunWithWhatIsAttached) {
  const TemporaryFolder folder;
  options_.size = "960x600";
  options_.out = folder.path();
  options_.runs = {folder.file("block.toml", kSetup)};
  EXPECT_EQ(print_of(options_),
            "wrote " + (folder / "block_setup_three-quarter.png").string() + "\n");
  const auto with = read_png(folder / "block_setup_three-quarter.png");
  std::string text = kSetup;
  text.erase(text.find("[[attach]]"), text.find("[[muscle]]") - text.find("[[attach]]"));
  text.erase(text.find("[[muscle]]"));
  options_.runs = {folder.file("bare.toml", text)};
  print_of(options_);
  const auto bare = read_png(folder / "bare_setup_three-quarter.png");
  EXPECT_GT(num_red_pixels(*with), num_red_pixels(*bare) + 20);
  EXPECT_GT(num_blue_pixels(*with), num_blue_pixels(*bare) + 5);
  text +=
      "[[support]]\nbody = \"block\"\nregion = { box = [\"-9 -9 -2.1 mm\", \"9 9 -1.9 "
      "mm\"] }\nfreedoms = [\"translation.z\"]\n";
  options_.runs = {folder.file("supported.toml", text)};
  print_of(options_);
  const auto supported = read_png(folder / "supported_setup_three-quarter.png");
  EXPECT_GT(num_green_pixels(*supported), num_green_pixels(*bare) + 20);
}

TEST_F(Drawing, AScenarioHasNoFrames) {
  const TemporaryFolder folder;
  options_.out = folder.path();
  options_.runs = {folder.file("block.toml", kSetup)};
  options_.frame = 0;
  EXPECT_THROW(render(options_), sim::InputError);
  options_.frame.reset();
  options_.focus = "blok";
  EXPECT_THROW(render(options_), sim::InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "block_setup_three-quarter.png"));
}

}  // namespace articular::tools::render_test
