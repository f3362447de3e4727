#include "tools/render/layers.hpp"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.hpp"
#include "sim/mesh/vtk_files.hpp"

namespace articular::tools {
namespace {

Image new_image(int width, int height, int channels) {
  auto image = Image::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  return image;
}

const unsigned char* bytes_of(vtkImageData& image) {
  return static_cast<const unsigned char*>(image.GetScalarPointer());
}

unsigned char* writable(vtkImageData& image) {
  return static_cast<unsigned char*>(image.GetScalarPointer());
}

}  // namespace

Image drawn(vtkRenderWindow& window) {
  const sim::QuietVtk vtk;
  window.Render();
  vtkNew<vtkWindowToImageFilter> capture;
  capture->SetInput(&window);
  capture->SetInputBufferTypeToRGB();
  capture->ReadFrontBufferOff();
  capture->ShouldRerenderOff();
  capture->Update();
  if (vtk.failed()) throw sim::SystemError("the display can't draw: " + vtk.message());
  Image image = Image::New();
  image->DeepCopy(capture->GetOutput());
  return image;
}

Image unveiled_where(vtkImageData& mask, vtkImageData& unveiled, vtkImageData& veiled) {
  const int* const size = mask.GetDimensions();
  Image image = new_image(size[0], size[1], 3);
  const auto *const is_white = bytes_of(mask), *const a = bytes_of(unveiled),
                    *const b = bytes_of(veiled);
  unsigned char* const to = writable(*image);
  for (vtkIdType i = 0; i < 3 * image->GetNumberOfPoints(); ++i)
    to[i] = is_white[i] > 127 ? a[i] : b[i];
  return image;
}

Image averaged(vtkImageData& large, int n) {
  const int* const size = large.GetDimensions();
  const int width = size[0] / n, height = size[1] / n;
  Image image = new_image(width, height, 3);
  const unsigned char* const from = bytes_of(large);
  unsigned char* to = writable(*image);
  const std::ptrdiff_t row = std::ptrdiff_t{3} * size[0];
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = n * n / 2;  // rounds
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) sum += from[(n * y + j) * row + 3 * (n * x + i) + c];
        *to++ = static_cast<unsigned char>(sum / (n * n));
      }
  return image;
}

Image with_opacity(vtkImageData& on_white, vtkImageData& on_black) {
  const int* const size = on_white.GetDimensions();
  Image image = new_image(size[0], size[1], 4);
  const auto *const white = bytes_of(on_white), *const black = bytes_of(on_black);
  unsigned char* const to = writable(*image);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i) {
    int see_through = 0;
    for (int c = 0; c < 3; ++c) see_through += white[3 * i + c] - black[3 * i + c];
    const double opacity = std::clamp(1 - see_through / (3 * 255.0), 0.0, 1.0);
    for (int c = 0; c < 3; ++c)
      to[4 * i + c] = static_cast<unsigned char>(
          opacity > 0 ? std::min(255L, std::lround(black[3 * i + c] / opacity)) : 255);
    to[4 * i + 3] = static_cast<unsigned char>(std::lround(255 * opacity));
  }
  return image;
}

}  // namespace articular::tools
