#include "tools/render/picture.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "tools/render/nearest.hpp"

namespace articular::tools {

namespace fs = std::filesystem;

ViewAxes view_axes(const std::string& view, const std::string& up_axis) {
  static const std::map<std::string, Vec3> kDirections = {{"front", {0, -1, 0}},
                                                          {"back", {0, 1, 0}},
                                                          {"left", {1, 0, 0}},
                                                          {"right", {-1, 0, 0}},
                                                          {"top", {0, 0, 1}},
                                                          {"bottom", {0, 0, -1}},
                                                          {"three-quarter", {0.62, -0.80, 0.30}}};
  std::set<std::string> names;
  for (const auto& [name, direction] : kDirections) names.insert(name);
  const auto found = kDirections.find(view);
  if (found == kDirections.end())
    throw sim::InputError("--view: " + unknown_name("view", view, names));
  if (up_axis != "y" && up_axis != "z")
    throw sim::InputError("--up: unknown axis `" + up_axis + "`; expected y or z");

  Mat3 body;  // columns: left, posterior, up
  if (up_axis == "z")
    body = Mat3::Identity();
  else
    body << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Vec3 to_eye = body * found->second.normalized();
  // From above and below the front of the body is at the top of the picture.
  const bool vertical = std::abs(found->second.z()) > 0.9;
  const Vec3 upwards = body * (vertical ? Vec3(0, -1, 0) : Vec3(0, 0, 1));
  const Vec3 right = upwards.cross(to_eye).normalized();
  return {right, to_eye.cross(right), to_eye};
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw sim::SystemError(folder.string() + ": the folder can't be made: " + error.message());
}

void write_png(const fs::path& file, vtkImageData& image) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(&image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray& bytes = *writer->GetResult();
  const auto* const start = reinterpret_cast<const char*>(bytes.GetPointer(0));
  sim::write_text_file(file,
                       std::string(start, static_cast<std::size_t>(bytes.GetNumberOfValues())));
}

}  // namespace articular::tools
