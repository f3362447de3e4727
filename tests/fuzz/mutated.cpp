// `mutated [SEED [SCENARIOS [MESHES]]]`: the program itself, fed with what authors and disks do to
// files. Scenarios and meshes are changed at random and given to `articular check`. It may refuse
// them, and nothing else: a crash, a hang, too much memory and exit code 1 are findings. Exit code
// 0: there were none. What was found is kept in build/mutated.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "tests/fuzz/toml_mutator.hpp"
#include "tests/sim/support/damaged_file.hpp"
#include "tools/process/measured_program.hpp"
#include "tools/process/temporary_folder.hpp"
#include "tools/process/this_program.hpp"

using namespace articular;
namespace fs = std::filesystem;

namespace {

constexpr double kMostSeconds = 60;
constexpr rlim_t kMostMemory = rlim_t{4} << 30;  // address space; the program alone takes 0.5 GB

const fs::path kRoot = ARTICULAR_SOURCE_DIR;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Files of a folder by name, so that a seed means the same everywhere.
std::vector<fs::path> files_in(const fs::path& folder, const std::set<std::string>& endings) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (endings.contains(entry.path().extension().string())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// A scenario whose one body has the mesh.
std::string scenario_with(const fs::path& mesh) {
  const std::set<std::string> with_tetrahedra = {".vtu", ".inp", ".msh", ".feb", ".bdf", ".mesh"};
  const bool is_tissue = with_tetrahedra.contains(mesh.extension().string()) ||
                         mesh.stem().string().ends_with("-grid");
  return fmt::format(
      "duration = \"1 s\"\n[[body]]\nname = \"body\"\nmesh = {{ file = \"{}\", unit = \"mm\" "
      "}}\n{}",
      mesh.filename().string(),
      is_tissue ? "kind = \"tissue\"\ndensity = \"1 g/cm^3\"\nmaterial = { law = \"neo-hookean\", "
                  "young_modulus = \"1 kPa\", poisson_ratio = 0.4 }\n"
                : "kind = \"fixed\"\n");
}

struct Outcome {
  std::string words;
  bool is_finding = false;
};

Outcome outcome_of(const tools::ProgramUse& use, const std::string& log) {
  using End = tools::ProgramUse::End;
  if (use.end == End::TimeLimit) return {"hangs", true};
  if (use.end == End::Signalled) return {fmt::format("crashes, signal {}", use.code), true};
  if (use.code == 4 && log.find("out of memory") != std::string::npos)
    return {"out of memory", true};
  const bool is_known = use.code == 0 || ((use.code == 2 || use.code == 3) && !log.empty());
  return {fmt::format("exit code {}", use.code), !is_known};
}

/// `articular check`, with what it says in the file `log` beside the scenario.
tools::ProgramUse run_check(const fs::path& scenario) {
  return tools::run_measured(
      {(tools::this_program().parent_path() / "articular").string(), "check", scenario.string()},
      {"OPENBLAS_NUM_THREADS=1"}, scenario.parent_path() / "log", kMostSeconds,
      [] { return false; });
}

class Trials {
 public:
  explicit Trials(std::string name) : name_(std::move(name)) {}

  /// Gives a scenario to the program. Its folder has all that it needs.
  void check(const fs::path& scenario) {
    const tools::ProgramUse use = run_check(scenario);
    const Outcome outcome = outcome_of(use, content(scenario.parent_path() / "log"));
    ++counts_[outcome.words];
    seconds_ = std::max(seconds_, use.wall_seconds);
    megabytes_ = std::max(megabytes_, use.peak_megabytes);
    if (!outcome.is_finding) return;
    const fs::path kept = kRoot / "build/mutated" / fmt::format("{}-{}", name_, findings_++);
    fs::create_directories(kept);
    fs::copy(scenario.parent_path(), kept, fs::copy_options::overwrite_existing);
    fmt::print("   {}: {}\n", outcome.words, kept.string());
  }

  /// @return whether nothing was found
  bool tell() const {
    fmt::print("{}:", name_);
    for (const auto& [words, count] : counts_) fmt::print(" {} {},", count, words);
    fmt::print(" at most {:.1f} s and {:.0f} MB\n", seconds_, megabytes_);
    std::fflush(stdout);
    return findings_ == 0;
  }

 private:
  std::string name_;
  std::map<std::string, int> counts_;
  double seconds_ = 0, megabytes_ = 0;
  int findings_ = 0;
};

/// Shipped scenarios that need no mesh to be made first.
std::vector<std::string> whole_scenarios(const fs::path& scenario) {
  std::vector<std::string> texts;
  for (const fs::path& file : files_in(kRoot / "scenarios", {".toml"})) {
    sim::write_text_file(scenario, content(file), sim::Durable::Later);
    if (run_check(scenario).code == 0) texts.push_back(content(file));
  }
  if (texts.empty()) throw sim::SystemError("no shipped scenario passes `articular check`");
  return texts;
}

/// One or two changes; in one of four also of bytes.
bool try_scenarios(int count, std::mt19937& random, const fs::path& folder) {
  Trials trials("scenarios");
  const fs::path scenario = folder / "scenario.toml";
  const std::vector<std::string> texts = whole_scenarios(scenario);
  for (int i = 0; i < count; ++i) {
    std::string text = texts[random() % texts.size()];
    for (unsigned k = 0; k <= random() % 2; ++k)
      text = fuzz::changed_toml(text, texts[random() % texts.size()], random);
    if (random() % 4 == 0 && !text.empty()) text = sim::damaged(text, random);
    sim::write_text_file(scenario, text, sim::Durable::Later);
    trials.check(scenario);
  }
  return trials.tell();
}

bool try_meshes(int count, std::mt19937& random, const fs::path& folder) {
  Trials trials("meshes");
  const std::vector<fs::path> meshes = files_in(
      kRoot / "tests/fuzz/seeds/files",
      {".vtu", ".vtp", ".vtk", ".stl", ".obj", ".ply", ".inp", ".msh", ".feb", ".bdf", ".mesh"});
  for (int i = 0; i < count; ++i) {
    const fs::path& mesh = meshes[random() % meshes.size()];
    const fs::path scenario = folder / "mesh.toml";
    sim::write_text_file(scenario, scenario_with(mesh), sim::Durable::Later);
    sim::write_text_file(folder / mesh.filename(), sim::damaged(content(mesh), random),
                         sim::Durable::Later);
    trials.check(scenario);
  }
  return trials.tell();
}

int number(int argc, char** argv, int at, int otherwise) {
  return argc > at ? std::atoi(argv[at]) : otherwise;
}

}  // namespace

int main(int argc, char** argv) {
  const int seed = number(argc, argv, 1, 1), scenarios = number(argc, argv, 2, 3000),
            meshes = number(argc, argv, 3, 1846);
  const rlimit memory{kMostMemory, kMostMemory};
  ::setrlimit(RLIMIT_AS, &memory);  // of the programs that it starts
  const rlimit core{0, 0};
  ::setrlimit(RLIMIT_CORE, &core);
  std::mt19937 random(static_cast<unsigned>(seed));
  const tools::TemporaryFolder folder;
  const bool all = try_scenarios(scenarios, random, folder.path());
  return try_meshes(meshes, random, folder.path()) && all ? 0 : 1;
}
