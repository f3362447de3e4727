#pragma once

#include <string>
#include <string_view>

namespace articular::sim {

/// A text as XML and HTML have it, between tags or in double quotes.
std::string xml_text(std::string_view text);

}  // namespace articular::sim
