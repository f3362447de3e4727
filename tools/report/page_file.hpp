#pragma once

#include <filesystem>
#include <string>

#include "tools/report/packed_numbers.hpp"

namespace articular::tools {

/// The page of report/page without data: share/articular/report/page.html, from the place where
/// the program lies. @throws SystemError  where it is missing: the program was built without npm
std::string empty_page();

/// The page with its data in it. @param title  as the browser shows it, any text
std::string page_with(const std::string& page, const std::string& title, const Json& data);

}  // namespace articular::tools
