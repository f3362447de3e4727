#include "sim/base/file_bytes.hpp"

#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::file_bytes_test {

/// Why a file can't be read.
std::string refusal(const std::filesystem::path& path) {
  try {
    file_bytes(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FileBytes, AreThoseOfTheFileWhateverTheyAreAndHoweverMany) {
  const TemporaryFolder folder;
  const std::string odd("\0\r\n\x1a\xff\0", 6);
  for (const std::size_t count : {0U, 1U, (1U << 16) - 1, 1U << 16, (1U << 16) + 1}) {
    std::string bytes;
    while (bytes.size() < count) bytes += odd[bytes.size() % odd.size()];
    EXPECT_EQ(file_bytes(folder.file("f", bytes)), bytes) << count;
  }
}

TEST(FileBytes, WhatIsNotThereAndWhatIsAFolderIsRefusedWithTheReason) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder.path() / "none").find("No such file"), std::string::npos);
  EXPECT_NE(refusal(folder.path()).find("Is a directory"), std::string::npos);
}

}  // namespace articular::sim::file_bytes_test
