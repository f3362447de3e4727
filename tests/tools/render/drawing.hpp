#pragma once

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "sim/base/error.hpp"
#include "sim/output/frame_writer.hpp"
#include "tests/sim/support/temporary_folder.hpp"
#include "tools/render/render.hpp"
#include "tools/render/virtual_display.hpp"

/// What tests of pictures share.
namespace articular::tools::render_test {

/// Sets or (without a value) unsets a variable of the environment for the time of a test.
class Environment {
 public:
  Environment(std::string name, const std::optional<std::string>& value) : name_(std::move(name)) {
    if (const char* const before = std::getenv(name_.c_str())) before_ = before;
    set(value);
  }
  ~Environment() { set(before_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const std::optional<std::string>& value) const {
    if (value)
      ::setenv(name_.c_str(), value->c_str(), 1);
    else
      ::unsetenv(name_.c_str());
  }
  std::string name_;
  std::optional<std::string> before_;
};

/// A tetrahedron that sinks and is pressed, on a plate, with a muscle and a ligament: three frames.
inline void write_run(const std::filesystem::path& folder) {
  sim::FrameWriter writer(folder, "tiny", {1e-3, "mm"});
  const Tetrahedra tets = Eigen::Vector4i(0, 1, 2, 3);
  const Triangles triangles = Eigen::Vector3i(0, 1, 2);
  Positions plate(3, 3), rest(3, 4);
  plate << -1, 1, 0, -1, -1, 1, 0, 0, 0;
  rest << -1, 1, 0, 0, -1, -1, 1, 0, 0.5, 0.5, 0.5, 2;
  for (int i = 0; i < 3; ++i) {
    Positions x = rest;
    x.row(2).array() -= 0.1 * i;
    const double time = 0.01 * i;
    const Eigen::MatrixXd pressure = Eigen::RowVector4d(0, 1, 2, 0) * 1000 * i;
    const Eigen::MatrixXd stress = Eigen::MatrixXd::Constant(1, 1, 1500.0 * i);
    writer.write_tissue({"disc",
                         x,
                         tets,
                         {{"displacement", "m", x - rest}, {"contact_pressure", "Pa", pressure}},
                         {{"von_mises", "Pa", stress}}},
                        i, time);
    writer.write_contact_surface(
        {"disc", x, triangles, {{"contact_pressure", "Pa", 2 * pressure}}, {}}, i, time);
    writer.write_rigid_body({"skull", plate, triangles, {}, {}}, i, time);
    writer.write_rigid_body({"jaw", x, triangles, {}, {}}, i, time);
    Positions muscle(3, 3), ligament(3, 2);
    muscle << -1, -1.2, -1, 0, 0, 0, 0, 1, 2;
    ligament << 1, 1, 0, 0, 0, 2;
    writer.write_lines({{"masseter", "lateral"},
                        {muscle, ligament},
                        {{"activation", "-", Eigen::RowVector2d(0.5 * i, 0)},
                         {"kind", "-", Eigen::RowVector2d(0, 1)}}},
                       i, time);
    writer.finish_frame(i, time);
  }
}

/// render(), with what it prints.
inline std::string print_of(const RenderOptions& options) {
  testing::internal::CaptureStdout();
  render(options);
  return testing::internal::GetCapturedStdout();
}

inline std::string error_of(const RenderOptions& options) {
  try {
    render(options);
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "no error";
}

inline vtkSmartPointer<vtkImageData> read_png(const std::filesystem::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Drawing needs a display, or Xvfb to make one.
class Drawing : public testing::Test {
 protected:
  void SetUp() override {
    try {
      const VirtualDisplay display;
    } catch (const sim::SystemError& error) {
      GTEST_SKIP() << error.what();
    }
    write_run(run_.path());
    options_.runs = {run_.path()};
    options_.size = "320x200";
  }
  TemporaryFolder run_;
  RenderOptions options_;
};

}  // namespace articular::tools::render_test
