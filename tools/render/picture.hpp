#pragma once

#include <filesystem>
#include <optional>

class vtkImageData;

/// Where a picture goes.
namespace articular::tools {

/// @throws SystemError
void make_folder(const std::filesystem::path& folder);

/// RGB or RGBA, whole or not at all. @param dpi  of print, kept in the file @throws SystemError
void write_png(const std::filesystem::path& file, vtkImageData& image, std::optional<double> dpi);

}  // namespace articular::tools
