#pragma once

#include <string>

namespace articular::tools {

struct RenderOptions;

/// The name of a picture without its number: scenario, field, view, and whatever else was asked for
/// that shows something else. So one picture replaces another only if it shows the same.
/// @param name  of the scenario
std::string picture_name(const std::string& name, const std::string& field,
                         const RenderOptions& options);

}  // namespace articular::tools
