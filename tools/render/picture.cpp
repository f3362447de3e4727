#include "tools/render/picture.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U})
    bytes += static_cast<char>((value >> shift) & 0xFFU);
  return bytes;
}

/// Pixels a metre, each way. [PNG, 3rd edition, 11.3.4.3]
std::string resolution_chunk(double dpi) {
  constexpr double kInch = 0.0254;  // [m]
  const std::string pixels = big_endian(static_cast<std::uint32_t>(std::lround(dpi / kInch)));
  const std::string named = "pHYs" + pixels + pixels + '\1';
  const uLong sum =
      crc32(0, reinterpret_cast<const Bytef*>(named.data()), static_cast<uInt>(named.size()));
  return big_endian(static_cast<std::uint32_t>(named.size() - 4)) + named +
         big_endian(static_cast<std::uint32_t>(sum));
}

}  // namespace

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw sim::SystemError(folder.string() + ": the folder can't be made: " + error.message());
}

void write_png(const fs::path& file, vtkImageData& image, std::optional<double> dpi) {
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(&image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray& written = *writer->GetResult();
  std::string bytes(reinterpret_cast<const char*>(written.GetPointer(0)),
                    static_cast<std::size_t>(written.GetNumberOfValues()));
  constexpr std::size_t kAfterHeader = 33;  // signature, and the chunk IHDR, which is always first
  if (dpi) bytes.insert(kAfterHeader, resolution_chunk(*dpi));
  sim::write_text_file(file, bytes);
}

}  // namespace articular::tools
