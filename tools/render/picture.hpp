#pragma once

#include <filesystem>
#include <string>

#include "tools/render/render_series.hpp"

class vtkImageData;

/// What every picture needs: where the eye is, and where the file goes.
namespace articular::tools {

/// Where the eye is, seen from the scene: towards the body's left, back and top.
/// @param view  "front", "top", ... @param up  "y" or "z" @throws InputError for another one
ViewAxes view_axes(const std::string& view, const std::string& up);

/// @throws SystemError
void make_folder(const std::filesystem::path& folder);

/// Whole or not at all. @throws SystemError
void write_png(const std::filesystem::path& file, vtkImageData& image);

}  // namespace articular::tools
