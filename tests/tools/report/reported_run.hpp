#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/support/program.hpp"

namespace articular::tools::report_test {

/// A block on a floor, which a muscle pulls on, presses a plate: five frames in a second or two.
/// Its title is no HTML.
constexpr const char* kBlock = R"(
title = "A block <pulled> & </script> pressed"
duration = "40 ms"
[integrator]
step = "4 ms"
[output]
interval = "10 ms"
directions = ["left", "posterior", "superior"]
[[body]]
name = "floor"
kind = "fixed"
geometry = { box = { size = "8 8 1 mm", cells = [1, 1, 1], center = "0 0 -2.6 mm" } }
[[body]]
name = "plate"
kind = "fixed"
geometry = { box = { size = "8 2 1 mm", cells = [2, 2, 2], center = "0 0 2.6 mm" } }
[[body]]
name = "block"
kind = "tissue"
density = "1 g/cm^3"
material = { law = "neo-hookean", young_modulus = "50 kPa", poisson_ratio = 0.4 }
geometry = { box = { size = "4 4 4 mm", cells = [3, 3, 3] } }
[[attach]]
body = "block"
to = "floor"
region = { box = ["-9 -9 -2.1 mm", "9 9 -1.9 mm"] }
[[load]]
kind = "motion"
body = "plate"
time = ["0 s", "40 ms"]
translation = ["0 0 0 mm", "0 0 -1 mm"]
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[muscle]]
name = "puller"
path = [{ body = "floor", point = "-4 0 -2.6 mm" }, { body = "block", point = "-2 0 0 mm", radius = "2 mm" }]
max_force = "0.2 N"
excitation = { time = ["0 s", "10 ms"], value = [0, 1] }
[[probe]]
name = "plate"
kind = "contact"
bodies = ["plate", "block"]
[[probe]]
name = "middle"
kind = "point"
body = "block"
point = "0 0 0 mm"
)";

inline ProgramResult run_block(const TemporaryFolder& folder) {
  folder.file("block.toml", kBlock);
  return run_program(folder, "run block.toml --out block --quiet");
}

/// What the page of a report holds for its scripts.
inline nlohmann::json data_of(const std::filesystem::path& page) {
  const std::string html = content(page), begin = "<script id=\"data\" type=\"application/json\">";
  const std::size_t at = html.find(begin);
  EXPECT_NE(at, std::string::npos) << page;
  if (at == std::string::npos) return nullptr;
  const std::size_t first = at + begin.size();
  return nlohmann::json::parse(html.substr(first, html.find("</script>", first) - first), nullptr,
                               false);
}

}  // namespace articular::tools::report_test
