#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// A folder of its own for each test, removed at its end.
class ScenarioTest : public ::testing::Test {
 protected:
  ScenarioTest() {
    std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    for (char& c : name)
      if (c == '/') c = '_';
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ("articular_" + std::to_string(::getpid()) + "_" + name);
    std::filesystem::create_directories(folder_);
  }
  ~ScenarioTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  Scenario read(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return read_scenario(write("jaw.toml", text), overrides);
  }

  /// The message with which a text is refused, without the folder of the files; "" if it is not.
  std::string refusal(const std::string& text,
                      const std::vector<std::string>& overrides = {}) const {
    try {
      read(text, overrides);
    } catch (const InputError& error) {
      std::string message = error.what();
      const std::string folder = folder_.string() + "/";
      for (std::size_t at; (at = message.find(folder)) != std::string::npos;)
        message.erase(at, folder.size());
      return message;
    }
    return "";
  }

  std::filesystem::path folder_;
};

/// A duration and one body of each kind, to which tests add what they are about.
inline const std::string kBodies = R"(
[[body]]
name = "skull"
kind = "fixed"
mesh = { file = "skull.vtp" }
[[body]]
name = "mandible"
kind = "rigid"
mesh = { file = "mandible.vtp" }
mass = "0.2 kg"
[[body]]
name = "disc_left"
kind = "tissue"
mesh = { file = "disc.vtu" }
density = "1100 kg/m^3"
material = { law = "linear", young_modulus = "5 MPa", poisson_ratio = 0.4 }
[[body]]
name = "stand"
kind = "fixed"
)";
inline const std::string kStart = "duration = \"1 s\"\n" + kBodies;

}  // namespace articular::sim
