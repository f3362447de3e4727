// Every link between pages of this tree leads to a file that is there, and to a heading of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace articular::links_test {

namespace fs = std::filesystem;

const fs::path kRoot = ARTICULAR_SOURCE_DIR;
const std::set<std::string> kFolders = {"parallel", "fem",   "collision", "sim",
                                        "tools",    "tests", "scenarios"};

std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  const auto look_at = [&](const fs::directory_entry& entry) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  };
  for (const fs::directory_entry& entry : fs::directory_iterator(kRoot)) look_at(entry);
  for (const std::string& folder : kFolders)
    for (auto entry = fs::recursive_directory_iterator(kRoot / folder);
         entry != fs::recursive_directory_iterator(); ++entry)
      if (entry->path().filename() == "node_modules")
        entry.disable_recursion_pending();
      else
        look_at(*entry);
  return found;
}

/// Its lines, without those of blocks of code.
std::vector<std::string> text_of(const fs::path& page) {
  std::ifstream in(page);
  std::vector<std::string> lines;
  bool is_code = false;
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("```"))
      is_code = !is_code;
    else if (!is_code && !line.starts_with("    "))
      lines.push_back(line);
  return lines;
}

/// "#the-same-bits" of "## The same bits": as pages on the web name their headings.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading.substr(heading.find(' ') + 1)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80)
      anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

bool has_heading(const fs::path& page, const std::string& anchor) {
  for (const std::string& line : text_of(page))
    if (line.starts_with("#") && anchor_of(line) == anchor) return true;
  return false;
}

/// What is wrong with a link of a page; empty: nothing.
std::string mistake_of(const fs::path& page, const std::string& link) {
  const std::size_t hash = link.find('#');
  const fs::path target =
      hash == 0 ? page : (page.parent_path() / link.substr(0, hash)).lexically_normal();
  if (!fs::exists(target)) return "no such file";
  if (hash != std::string::npos && !has_heading(target, link.substr(hash + 1)))
    return "no such heading";
  return "";
}

TEST(Links, FromPageToPageLeadToAFileAndAHeading) {
  static const std::regex kLink(R"(\]\(([^)\s]+)\))");
  int count = 0;
  for (const fs::path& page : pages())
    for (const std::string& line : text_of(page))
      for (std::sregex_iterator link(line.begin(), line.end(), kLink), end; link != end; ++link) {
        const std::string target = (*link)[1];
        if (target.find("://") != std::string::npos) continue;
        ++count;
        EXPECT_EQ(mistake_of(page, target), "")
            << page.lexically_relative(kRoot).string() << ": " << target;
      }
  EXPECT_GT(count, 100);
}

}  // namespace articular::links_test
