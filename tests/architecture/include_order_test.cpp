// Includes run one way: between modules, between the folders of a module in the order of the table
// in its README, and between headers without a circle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace articular::include_order_test {

namespace fs = std::filesystem;

using Includes = std::map<std::string, std::vector<std::string>>;  // of each file, by path
using Order = std::vector<std::string>;                            // folders, the lowest first

/// Modules, and those that each may include.
const std::map<std::string, std::set<std::string>> kModules = {
    {"parallel", {}},
    {"fem", {"parallel"}},
    {"collision", {"parallel"}},
    {"sim", {"parallel", "fem", "collision"}},
    {"tools", {"parallel", "fem", "collision", "sim"}}};

const fs::path kRoot = ARTICULAR_SOURCE_DIR;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The text between two marks, the first of which begins the line; empty: not such a line.
std::string between(const std::string& line, const std::string& begin, const std::string& end) {
  if (!line.starts_with(begin)) return {};
  const std::size_t stop = line.find(end, begin.size());
  return stop == std::string::npos ? "" : line.substr(begin.size(), stop - begin.size());
}

/// Rows "| `folder/` | ..." of a README.
Order order_in(const std::vector<std::string>& readme) {
  Order order;
  for (const std::string& line : readme)
    if (const std::string folder = between(line, "| `", "/` |"); !folder.empty())
      order.push_back(folder);
  return order;
}

Includes includes_of(const std::string& module) {
  Includes includes;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / module)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".hpp" && ending != ".cpp") continue;
    std::vector<std::string>& found =
        includes[entry.path().lexically_relative(kRoot).generic_string()];
    for (const std::string& line : lines_of(entry.path()))
      if (const std::string path = between(line, "#include \"", "\""); !path.empty())
        found.push_back(path);
  }
  return includes;
}

struct Place {
  std::string module, folder;
};

/// Of "module/folder/file"; without a folder, it is empty.
Place place_of(const std::string& path) {
  const std::size_t first = path.find('/'), second = path.find('/', first + 1);
  if (first == std::string::npos) return {path, ""};
  return {path.substr(0, first),
          second == std::string::npos ? "" : path.substr(first + 1, second - first - 1)};
}

/// What is wrong with one include; empty: nothing.
std::string fault(const std::string& file, const std::string& included, const Order& order) {
  const Place from = place_of(file), to = place_of(included);
  if (to.module != from.module)
    return kModules.at(from.module).contains(to.module)
               ? ""
               : fmt::format("{}: {} may not include {}", file, from.module, included);
  const auto rank = [&](const std::string& folder) {
    return std::find(order.begin(), order.end(), folder);
  };
  if (rank(to.folder) <= rank(from.folder)) return "";
  return fmt::format("{}: includes {}, which is above it", file, included);
}

std::vector<std::string> faults(const Includes& includes, const Order& order) {
  std::vector<std::string> all;
  for (const auto& [file, paths] : includes) {
    if (std::find(order.begin(), order.end(), place_of(file).folder) == order.end())
      all.push_back(fmt::format("{}: its folder is in no row of the README's table", file));
    for (const std::string& path : paths)
      if (std::string what = fault(file, path, order); !what.empty()) all.push_back(what);
  }
  return all;
}

/// A file that includes itself by way of others; empty: there is none.
std::string file_in_a_circle(const Includes& includes) {
  std::map<std::string, int> state;  // 1: on the way, 2: done
  const auto visit = [&](const auto& self, const std::string& file) -> bool {
    if (state[file] != 0) return state[file] == 1;
    state[file] = 1;
    if (const auto found = includes.find(file); found != includes.end())
      for (const std::string& next : found->second)
        if (self(self, next)) return true;
    state[file] = 2;
    return false;
  };
  for (const auto& [file, paths] : includes)
    if (visit(visit, file)) return file;
  return {};
}

class Module : public testing::TestWithParam<std::string> {};

TEST_P(Module, IncludesRunDownTheTableOfItsReadme) {
  const Order order = order_in(lines_of(kRoot / GetParam() / "README.md"));
  const Includes includes = includes_of(GetParam());
  ASSERT_GT(order.size(), 3U) << "no table of folders in the README";
  ASSERT_GT(includes.size(), 10U);
  for (const std::string& what : faults(includes, order)) ADD_FAILURE() << what;
}

TEST_P(Module, TheTableNamesTheFoldersThatThereAre) {
  for (const std::string& folder : order_in(lines_of(kRoot / GetParam() / "README.md")))
    EXPECT_TRUE(fs::is_directory(kRoot / GetParam() / folder)) << folder;
}

TEST_P(Module, HeadersIncludeEachOtherInNoCircle) {
  EXPECT_EQ(file_in_a_circle(includes_of(GetParam())), "");
}

INSTANTIATE_TEST_SUITE_P(All, Module, testing::Values("fem", "collision", "sim", "tools"),
                         [](const auto& module) { return module.param; });

TEST(IncludeOrder, ParallelHasNoFoldersAndIncludesNoOtherModule) {
  const Includes includes = includes_of("parallel");
  EXPECT_FALSE(includes.empty());
  EXPECT_EQ(faults(includes, {""}), std::vector<std::string>());
  EXPECT_EQ(file_in_a_circle(includes), "");
}

TEST(IncludeOrder, UpwardSidewardAndUnknownIncludesAreFaults) {
  const Order order = {"base", "model", "run"};
  const auto count = [&](const std::string& file, const std::string& path) {
    return faults({{file, {path}}}, order).size();
  };
  EXPECT_EQ(count("sim/model/a.hpp", "sim/base/b.hpp"), 0U);
  EXPECT_EQ(count("sim/model/a.hpp", "sim/model/b.hpp"), 0U);
  EXPECT_EQ(count("sim/model/a.hpp", "fem/base/b.hpp"), 0U);
  EXPECT_EQ(count("sim/model/a.hpp", "sim/run/b.hpp"), 1U);
  EXPECT_EQ(count("sim/model/a.hpp", "sim/elsewhere/b.hpp"), 1U);
  EXPECT_EQ(count("sim/model/a.hpp", "tools/run/b.hpp"), 1U);
  EXPECT_EQ(count("fem/base/a.hpp", "collision/mesh/b.hpp"), 1U);
  EXPECT_EQ(count("fem/base/a.hpp", "parallel/b.hpp"), 0U);
  EXPECT_EQ(count("sim/a.hpp", "sim/base/b.hpp"), 1U);  // lies in no folder
}

TEST(IncludeOrder, ACircleIsFoundAndAFanIsNone) {
  EXPECT_EQ(file_in_a_circle({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {}}}), "");
  EXPECT_NE(file_in_a_circle({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}), "");
}

TEST(IncludeOrder, TheOrderIsReadFromRowsOfFolders) {
  EXPECT_EQ(order_in({"| Folder | |", "| --- | --- |", "| `base/` | errors |", "text `x/` |",
                      "| `run.hpp` | no folder |", "| `run/` | runs |"}),
            (Order{"base", "run"}));
}

}  // namespace articular::include_order_test
