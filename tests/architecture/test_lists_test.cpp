// Every test source is in the list of a program: what is in none is never compiled, and never
// fails.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace articular::test_lists_test {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Lists are in the nearest folder above that has one, and name sources from there.
bool is_listed(const fs::path& source) {
  fs::path folder = source.parent_path();
  while (!fs::exists(folder / "CMakeLists.txt")) folder = folder.parent_path();
  const std::string list = text_of(folder / "CMakeLists.txt"),
                    name = source.lexically_relative(folder).generic_string();
  const std::size_t at = list.find(name);
  return at != std::string::npos && std::string(" \n(/").find(list[at - 1]) != std::string::npos;
}

TEST(TestLists, NameEveryTestSource) {
  int sources = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(ARTICULAR_SOURCE_DIR) / "tests"))
    if (entry.path().filename().string().ends_with("_test.cpp")) {
      ++sources;
      EXPECT_TRUE(is_listed(entry.path())) << entry.path();
    }
  EXPECT_GT(sources, 200);
}

}  // namespace articular::test_lists_test
