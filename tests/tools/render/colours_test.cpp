// What colours a picture has, read from its pixels.
#include <vtkImageData.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/tools/render/drawing.hpp"
#include "tools/render/colour_map.hpp"

namespace articular::tools::render_test {

using Bytes = std::array<int, 3>;

std::vector<Bytes> pixels_of(vtkImageData& image) {
  const int channels = image.GetNumberOfScalarComponents();
  const auto* const bytes = static_cast<const unsigned char*>(image.GetScalarPointer());
  std::vector<Bytes> pixels;
  for (vtkIdType i = 0; i < image.GetNumberOfPoints(); ++i)
    pixels.push_back({bytes[channels * i], bytes[channels * i + 1], bytes[channels * i + 2]});
  return pixels;
}

/// As near as rounding to bytes, there and back, allows.
bool is_same(const Bytes& a, const Bytes& b) {
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(a[c] - b[c]) > 1) return false;
  return true;
}

Bytes bytes_of(vtkLookupTable& table, double value) {
  double c[3];
  table.GetColor(value, c);
  return {static_cast<int>(std::lround(255 * c[0])), static_cast<int>(std::lround(255 * c[1])),
          static_cast<int>(std::lround(255 * c[2]))};
}

long num_of(const std::vector<Bytes>& pixels, const Bytes& colour) {
  return std::count_if(pixels.begin(), pixels.end(),
                       [&](const Bytes& pixel) { return is_same(pixel, colour); });
}

class Colours : public Drawing {
 protected:
  void SetUp() override {
    Drawing::SetUp();
    options_.size = "640x400";
  }
  std::vector<Bytes> pixels(const std::string& file) {
    print_of(options_);
    return pixels_of(*read_png(run_ / ("render/" + file)));
  }
};

// The stress of the only element, 3 kPa, is the upper end of 0 to 3 kPa: its colour fills the
// element, and nothing lightens or darkens it. Halfway in a range of 0 to 6 kPa it is another one.
TEST_F(Colours, OfAFieldAreThoseOfItsScaleWhateverTheLight) {
  options_.only = {"disc"};
  const auto viridis = colour_table(colour_maps().at("viridis"), 0, 6);
  for (const std::string view : {"front", "left", "top", "bottom", "three-quarter"}) {
    options_.view = view;
    const std::string file = "tiny_von_mises_" + view + "_disc_000002.png";
    options_.range.reset();
    const long whole = num_of(pixels(file), bytes_of(*viridis, 6));
    EXPECT_GT(whole, 5000) << view;
    options_.range = {"0", "6 kPa"};
    const long half = num_of(pixels(file), bytes_of(*viridis, 3));
    // The legend has some of either colour.
    EXPECT_NEAR(static_cast<double>(half), static_cast<double>(whole),
                0.03 * static_cast<double>(whole))
        << view;
  }
}

/// A tetrahedron with a stress of 3 kPa, and a bone that hides it wholly from below.
void write_covered(const std::filesystem::path& folder) {
  sim::FrameWriter writer(folder, "covered", {1e-3, "mm"});
  Positions x(3, 4), plate(3, 3);
  x << -1, 1, 0, 0, -1, -1, 1, 0, 0, 0, 0, 2;
  plate << -4, 4, 0, -3, -3, 5, -1, -1, -1;
  const Eigen::MatrixXd stress = Eigen::MatrixXd::Constant(1, 1, 3000);
  writer.write_tissue(
      {"disc", x, Tetrahedra(Eigen::Vector4i(0, 1, 2, 3)), {}, {{"von_mises", "Pa", stress}}}, 0,
      0);
  writer.write_rigid_body({"plate", plate, Triangles(Eigen::Vector3i(0, 1, 2)), {}, {}}, 0, 0);
  writer.finish_frame(0, 0);
}

TEST_F(Colours, OfAFieldAreTheSameBehindATranslucentBone) {
  const TemporaryFolder run;
  write_covered(run.path());
  options_.runs = {run.path()};
  options_.view = "bottom";
  options_.focus = "disc";
  const auto count = [&] {
    print_of(options_);
    const auto viridis = colour_table(colour_maps().at("viridis"), 0, 3);
    const auto picture = read_png(run / "render/covered_von_mises_bottom_focus-disc_000000.png");
    return static_cast<double>(num_of(pixels_of(*picture), bytes_of(*viridis, 3)));
  };
  options_.opacity = {{"plate", 0.5}};
  const double behind = count();
  EXPECT_GT(behind, 5000);
  options_.opacity = {{"plate", 1}};
  EXPECT_LT(count(), 0.2 * behind) << "all but the legend is hidden by an opaque bone";
}

// It is drawn without its field, and then no part has one.
TEST_F(Colours, ATranslucentTissueNeedsNoLegend) {
  EXPECT_NE(print_of(options_).find("von_mises 0 to"), std::string::npos);
  options_.opacity = {{"disc", 0.5}};
  EXPECT_EQ(print_of(options_).find("von_mises 0 to"), std::string::npos);
}

// The pressure runs from 0 to 2 kPa between nodes: no pixel has a colour that the scale lacks, but
// for edges and text, whose pixels are mixed with ink and paper.
TEST_F(Colours, BetweenNodesAreThoseOfValuesNotMixturesOfColours) {
  options_.only = {"disc"};
  options_.field = "contact_pressure";
  options_.view = "bottom";
  options_.colour_map = "blue-red";  // halfway from blue to red it is white, and never purple
  options_.range = {"0", "2 kPa"};
  const auto table = colour_table(colour_maps().at("blue-red"), 0, 2);
  std::vector<Bytes> known;
  for (int i = 0; i < 256; ++i) known.push_back(bytes_of(*table, 2 * (i + 0.5) / 256));
  const std::vector<Bytes> all = pixels("tiny_contact_pressure_bottom_disc_000002.png");
  long coloured = 0, of_scale = 0;
  for (const Bytes& pixel : all) {
    const auto [low, high] = std::minmax_element(pixel.begin(), pixel.end());
    if (*high - *low < 40) continue;  // ink, paper and their mixtures
    ++coloured;
    of_scale += std::any_of(known.begin(), known.end(),
                            [&](const Bytes& colour) {
                              return std::abs(pixel[0] - colour[0]) <= 4 &&
                                     std::abs(pixel[1] - colour[1]) <= 4 &&
                                     std::abs(pixel[2] - colour[2]) <= 4;
                            })
                    ? 1
                    : 0;
  }
  EXPECT_GT(coloured, 5000);
  EXPECT_GT(static_cast<double>(of_scale), 0.97 * static_cast<double>(coloured));
}

// Muscles have a scale of their own: an activation of 1 has its brightest colour.
TEST_F(Colours, OfMusclesAreThoseOfTheirActivation) {
  options_.only = {"lines"};
  const auto red = colour_table(muscle_colours(), 0, 1);
  const auto active = num_of(pixels("tiny_three-quarter_lines_000002.png"), bytes_of(*red, 1));
  options_.frame = 0;
  const auto resting = num_of(pixels("tiny_three-quarter_lines_000000.png"), bytes_of(*red, 1));
  EXPECT_GT(active, resting + 500);
}

TEST_F(Colours, OfLinesAreThoseOfAFieldThatIsAskedFor) {
  options_.only = {"lines"};
  options_.field = "activation";
  options_.colour_map = "magma";
  const auto magma = colour_table(colour_maps().at("magma"), 0, 1);
  EXPECT_GT(num_of(pixels("tiny_activation_three-quarter_lines_000002.png"), bytes_of(*magma, 1)),
            500);
}

TEST_F(Colours, OfThePaperAreThoseAskedFor) {
  options_.only = {"disc"};
  const std::string file = "tiny_von_mises_three-quarter_disc_000002.png";
  EXPECT_GT(num_of(pixels(file), {255, 255, 255}), 640 * 400 / 2);
  options_.background = "black";
  const auto black = pixels(file);
  EXPECT_GT(num_of(black, {0, 0, 0}), 640 * 400 / 2);
  EXPECT_GT(num_of(black, {242, 242, 242}), 100) << "text that can be read";
  options_.background = "navy";
  EXPECT_GT(num_of(pixels(file), {0, 0, 128}), 640 * 400 / 2);
}

// Four channels: nothing where there is paper, the same colours where there is the scene, and text
// with soft edges.
TEST_F(Colours, OfTransparentPaperAreNone) {
  options_.only = {"disc"};
  options_.background = "transparent";
  print_of(options_);
  const auto image = read_png(run_ / "render/tiny_von_mises_three-quarter_disc_000002.png");
  ASSERT_EQ(image->GetNumberOfScalarComponents(), 4);
  const auto* const bytes = static_cast<const unsigned char*>(image->GetScalarPointer());
  long clear = 0, opaque = 0, between = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i) {
    const int alpha = bytes[4 * i + 3];
    clear += alpha == 0 ? 1 : 0;
    opaque += alpha == 255 ? 1 : 0;
    between += alpha > 0 && alpha < 255 ? 1 : 0;
  }
  EXPECT_GT(clear, 640 * 400 / 2);
  EXPECT_GT(opaque, 5000);
  EXPECT_GT(between, 500);
  const auto viridis = colour_table(colour_maps().at("viridis"), 0, 3);
  EXPECT_GT(num_of(pixels_of(*image), bytes_of(*viridis, 3)), 5000);
}

/// Two triangles side by side of which each has a pressure of its own, or none.
void write_faces(const std::filesystem::path& folder) {
  sim::FrameWriter writer(folder, "faces", {1e-3, "mm"});
  Positions x(3, 4);
  x << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  Triangles faces(3, 2);
  faces << 0, 0, 1, 2, 2, 3;
  const double blank = std::numeric_limits<double>::quiet_NaN();
  const sim::Field nodal{.name = "contact_pressure",
                         .unit = "Pa",
                         .values = Eigen::RowVector4d(0, 1, 1, blank),
                         .may_be_blank = true};
  const sim::Field of_faces{
      .name = "contact_pressure", .unit = "Pa", .values = Eigen::RowVector2d(6, 8)};
  writer.write_contact_surface({"plate", x, faces, {nodal}, {of_faces}}, 0, 0);
  writer.write_rigid_body({"slab", x, faces, {nodal}, {}}, 0, 0);
  writer.finish_frame(0, 0);
}

// A contact surface shows the pressure of each face, in one colour without any step between.
TEST_F(Colours, OfFacesAreTheirOwn) {
  const TemporaryFolder run;
  write_faces(run.path());
  options_.runs = {run.path()};
  options_.only = {"plate:contact"};
  options_.view = "top";
  print_of(options_);
  const auto all =
      pixels_of(*read_png(run / "render/faces_contact_pressure_top_plate-contact_000000.png"));
  const auto viridis = colour_table(colour_maps().at("viridis"), 0, 8);
  const long low = num_of(all, bytes_of(*viridis, 6)), high = num_of(all, bytes_of(*viridis, 8));
  EXPECT_GT(low, 10000);
  EXPECT_NEAR(static_cast<double>(low), static_cast<double>(high), 0.05 * static_cast<double>(low));
}

// A face with a corner that has no value is grey as a whole: nothing is known between.
TEST_F(Colours, OfWhatIsBlankIsGrey) {
  const TemporaryFolder run;
  write_faces(run.path());
  options_.runs = {run.path()};
  options_.only = {"slab"};
  options_.view = "top";
  print_of(options_);
  const auto all = pixels_of(*read_png(run / "render/faces_contact_pressure_top_slab_000000.png"));
  EXPECT_GT(num_of(all, {204, 204, 204}), 10000);
}

// Lightness [CIE 1976] runs evenly through the maps of values on one side of rest, so that equal
// steps of the value look equal; of blue-red it is the same at both ends, and highest in the
// middle.
TEST(ColourMaps, RunEvenlyFromDarkToBright) {
  const auto lightness = [](vtkLookupTable& table, double value) {
    double c[3];
    table.GetColor(value, c);
    for (double& channel : c)
      channel = channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
    const double y = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
  };
  for (const std::string name : {"viridis", "magma", "cividis"}) {
    const auto table = colour_table(colour_maps().at(name), 0, 1);
    const double first = lightness(*table, 0), last = lightness(*table, 1);
    EXPECT_GT(last - first, 60) << name;
    for (double t = 0; t <= 1; t += 0.01)  // within 6 of 100: they are even in CAM02-UCS
      EXPECT_NEAR(lightness(*table, t), first + t * (last - first), 6) << name << " " << t;
  }
  const auto table = colour_table(colour_maps().at("blue-red"), -1, 1);
  EXPECT_NEAR(lightness(*table, -1), lightness(*table, 1), 5);
  EXPECT_GT(lightness(*table, 0), 95);
}

}  // namespace articular::tools::render_test
