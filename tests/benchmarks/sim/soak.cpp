// Does a long run grow? A cube of tissue rests on a floor for very many steps.
//
//   build/release/bin/soak [STEPS] [FOLDER]      (default: 1e6, and a temporary folder)
//
// At each power of ten from 10⁴ steps on, and at the end: the resident memory of the process, the
// size of history.csv and of all results, and the bytes that the process has written until then
// (/proc/self/io). What is written again and again shows as more bytes written than there are. The
// results are left in FOLDER. The exit code is 1 if memory has grown by more than a megabyte since
// 10⁴ steps, or twice the bytes of the results were written.

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "sim/build/build_model.hpp"
#include "sim/run/run.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace {

using namespace articular;

constexpr double kStep = 1e-3;                // [s]
constexpr std::int64_t kFirstSample = 10000;  // until then buffers find their sizes

std::string scene(std::int64_t steps) {
  return fmt::format(R"(duration = "{} s"
[integrator]
step = "1 ms"
[output]
interval = "1 s"
[[body]]
name = "block"
kind = "tissue"
geometry = {{ box = {{ size = "10 10 10 mm", cells = [1, 1, 1], center = "0 0 5.1 mm" }} }}
density = "1 g/cm^3"
material = {{ law = "neo-hookean", young_modulus = "100 kPa", poisson_ratio = 0.3, element = "plain", mass_damping = "20 1/s" }}
[[body]]
name = "floor"
kind = "fixed"
geometry = {{ box = {{ size = "30 30 10 mm", cells = [1, 1, 1], center = "0 0 -5 mm" }} }}
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[probe]]
name = "corner"
kind = "point"
body = "block"
point = "5 5 10.1 mm"
[[probe]]
name = "energy"
kind = "energy"
[[probe]]
name = "floor"
kind = "contact"
bodies = ["block", "floor"]
)",
                     static_cast<double>(steps) * kStep);
}

/// [kB]
std::int64_t resident_memory() {
  std::ifstream in("/proc/self/statm");
  std::int64_t all = 0, resident = 0;
  in >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE) / 1024;
}

/// By this process, into files and to the terminal [bytes].
std::int64_t bytes_written() {
  std::ifstream in("/proc/self/io");
  std::string name;
  for (std::int64_t value = 0; in >> name >> value;)
    if (name == "wchar:") return value;
  return -1;
}

std::int64_t size_of(const std::filesystem::path& folder) {
  std::int64_t sum = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) sum += static_cast<std::int64_t>(entry.file_size());
  return sum;
}

/// A run, and what is seen of it.
class Soak {
 public:
  Soak(std::int64_t steps, std::filesystem::path folder)
      : steps_(steps), folder_(std::move(folder)) {}

  int run() {
    std::filesystem::create_directories(folder_);
    const std::filesystem::path file = folder_ / "soak.toml";
    std::ofstream(file) << scene(steps_);
    const sim::Scenario scenario = sim::read_scenario(file, {});
    const sim::Model model = sim::build_model(scenario);
    std::printf("%10s %12s %16s %16s %16s\n", "steps", "memory kB", "history bytes", "all results",
                "bytes written");
    written_before_ = bytes_written();
    sim::RunOptions options;
    options.directory = folder_ / "results";
    options.overwrite = true;
    options.after_step = [this](const sim::State& state, double) {
      if (state.counts.steps == next_ && next_ < steps_) sample(state.counts.steps);
      return false;
    };
    sim::run(scenario, model, options);
    sample(steps_);
    const bool is_calm = memory_ - first_memory_ <= 1024 && written_ <= 2 * size_;
    return is_calm ? EXIT_SUCCESS : EXIT_FAILURE;
  }

 private:
  void sample(std::int64_t steps) {
    next_ *= 10;
    const std::filesystem::path results = folder_ / "results";
    memory_ = resident_memory();
    if (first_memory_ == 0) first_memory_ = memory_;
    written_ = bytes_written() - written_before_;
    size_ = size_of(results);
    std::printf("%10lld %12lld %16lld %16lld %16lld\n", static_cast<long long>(steps),
                static_cast<long long>(memory_),
                static_cast<long long>(std::filesystem::file_size(results / "history.csv")),
                static_cast<long long>(size_), static_cast<long long>(written_));
    std::fflush(stdout);
  }

  std::int64_t steps_;
  std::filesystem::path folder_;
  std::int64_t next_ = kFirstSample;
  std::int64_t written_before_ = 0, memory_ = 0, first_memory_ = 0, written_ = 0, size_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const double steps = argc > 1 ? std::atof(argv[1]) : 1e6;
  if (argc > 3 || !(steps >= 1)) {
    std::fprintf(stderr, "usage: soak [STEPS] [FOLDER]\n");
    return 2;
  }
  try {
    const articular::TemporaryFolder temporary;
    return Soak(std::llround(steps), argc > 2 ? argv[2] : temporary.path()).run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "soak: %s\n", error.what());
    return 2;
  }
}
