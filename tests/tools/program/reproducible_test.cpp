// The same bits on other processors: OpenBLAS and the C library are made to choose what they would
// choose there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/tools/support/program.hpp"

namespace articular::reproducible_test {

/// Cholesky's factors of blocks large enough for dense kernels, and fibres with exp in their law.
const std::string kScene = R"(
duration = "4 ms"
[integrator]
step = "1 ms"
solver = "cholesky"
[[body]]
name = "floor"
kind = "fixed"
geometry = { box = { size = "30 30 2 mm", cells = [2, 2, 1], center = "0 0 -1 mm" } }
[[body]]
name = "block"
kind = "tissue"
density = "1 g/cm^3"
geometry = { box = { size = "10 10 10 mm", cells = [5, 5, 5], center = "0 0 4.99 mm" } }
[body.material]
law = "muscle"
element = "plain"
fibres = { direction = [0.6, 0, 0.8] }
[[body]]
name = "weight"
kind = "rigid"
mass = "20 g"
geometry = { box = { size = "12 12 4 mm", cells = [3, 3, 1], center = "0 0 11.98 mm" } }
[[muscle]]
name = "fibres"
tissue = "block"
excitation = { time = ["0 s", "2 ms"], value = [0, 1] }
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[probe]]
name = "corner"
kind = "point"
body = "block"
point = "5 5 9.98 mm"
[[probe]]
name = "press"
kind = "contact"
bodies = ["block", "weight"]
)";

/// What libraries would choose on some processors that this one can stand for.
std::vector<std::string> processors() {
  const std::string no_fma = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4 ";
  std::vector<std::string> found = {no_fma + "OPENBLAS_CORETYPE=Prescott"};
  if (__builtin_cpu_supports("sse4.2")) found.push_back(no_fma + "OPENBLAS_CORETYPE=Nehalem");
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    for (const char* kernels : {"Haswell", "Zen"})
      found.push_back(std::string("OPENBLAS_CORETYPE=") + kernels);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    found.emplace_back("OPENBLAS_CORETYPE=SkylakeX");
  return found;
}

class Reproducible : public ::testing::Test {
 protected:
  void SetUp() override { folder_.file("scene.toml", kScene); }

  /// @return history.csv, of all digits that it has
  std::string history(const std::string& processor, const std::string& arguments) {
    const ProgramResult run = run_shell(
        folder_, "env " + processor +
                     " \"$articular\" run scene.toml --quiet --overwrite --out out " + arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return content(folder_ / "out/history.csv") + content(folder_ / "out/frames/block_000001.vtu");
  }
  nlohmann::json summary() const {
    return nlohmann::json::parse(content(folder_ / "out/summary.json"));
  }

  TemporaryFolder folder_;
};

TEST_F(Reproducible, RunsHaveTheSameBitsWhateverTheLibrariesWouldChoose) {
  const std::string expected = history("A=B", "--reproducible");
  for (const std::string& processor : processors()) {
    EXPECT_TRUE(history(processor, "--reproducible --threads 2") == expected) << processor;
    EXPECT_EQ(summary().at("processor").at("blas_kernels"), "Prescott");
    EXPECT_EQ(summary().at("processor").at("instruction_set"), "sse2");
    EXPECT_EQ(summary().at("processor").at("reproducible"), true);
  }
}

// Or the scene would show nothing.
TEST_F(Reproducible, WithoutTheFlagTheyHaveNot) {
  if (processors().size() < 3) GTEST_SKIP() << "this processor can stand for no other one";
  EXPECT_FALSE(history(processors()[0], "") == history(processors()[1], ""));
  EXPECT_EQ(summary().at("processor").at("reproducible"), false);
  EXPECT_FALSE(history(processors()[2], "") == history(processors()[0], ""));
}

TEST_F(Reproducible, ARunGoesOnInTheSameWayOnly) {
  history("A=B",
          "--reproducible --set output.checkpoint_interval='1 ms'"
          " --set output.interval='1 ms'");
  const std::string again =
      "run scene.toml --quiet --out out --resume --set output.checkpoint_interval='1 ms'"
      " --set output.interval='1 ms'";
  const ProgramResult otherwise = run_program(folder_, again);
  EXPECT_EQ(otherwise.exit_code, 2);
  EXPECT_NE(otherwise.err.find("belongs to another scenario, mesh or setting"), std::string::npos)
      << otherwise.err;
  EXPECT_EQ(run_program(folder_, again + " --reproducible").exit_code, 0);
}

TEST_F(Reproducible, WhatTheUserToldTheCLibraryStays) {
  history("GLIBC_TUNABLES=glibc.malloc.check=0:glibc.cpu.hwcaps=-AVX512F", "--reproducible");
  EXPECT_EQ(summary().at("processor").at("reproducible"), true);
}

}  // namespace articular::reproducible_test
