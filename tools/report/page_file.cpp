#include "tools/report/page_file.hpp"

#include <string_view>

#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/base/xml_text.hpp"
#include "tools/process/this_program.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

// What page/bundle.mjs leaves for us to fill in.
constexpr std::string_view kTitle = "@ARTICULAR_TITLE@", kData = "@ARTICULAR_DATA@";

/// JSON that ends no <script>: it has `<` in strings only, where it may be written otherwise.
std::string script_text(const Json& data) {
  std::string result;
  for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  }
  return result;
}

void replace_once(std::string& text, std::string_view mark, const std::string& by) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos)
    throw sim::SystemError("the page of reports has no " + std::string(mark) +
                           ": it is of another version than this program");
  text.replace(at, mark.size(), by);
}

}  // namespace

std::string empty_page() {
  const fs::path file =
      (this_program().parent_path() / "../share/articular/report/page.html").lexically_normal();
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
    throw sim::SystemError(
        file.string() +
        ": the page that a report is made of is missing. It is built with node and npm, which "
        "fetches vtk.js: `tools/install-packages` installs them, then build again");
  return sim::file_bytes(file);
}

std::string page_with(const std::string& page, const std::string& title, const Json& data) {
  std::string result = page;
  replace_once(result, kTitle, sim::xml_text(title));
  replace_once(result, kData, script_text(data));
  return result;
}

}  // namespace articular::tools
