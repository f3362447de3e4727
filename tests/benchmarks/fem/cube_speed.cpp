// Newton's method for a cube stretched by 30 %, beside CalculiX: same mesh, same law, same five
// load steps, each program for itself on one thread.
//
//   build/release/bin/cube_speed [CELLS]...      (default: 16 24 32, of six tetrahedra each)
//
// Processor time and peak of memory are those of whole processes, from the making or reading of
// the mesh until the end; medians of three rounds in which the programs take turns. CalculiX's
// reading (the same input without its analysis) is measured as well. Errors are those of the force
// on a plate, relative to Newton's method with a residual of 1e-10. Without `ccx` only ours.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/benchmarks/fem/stretched_cube.hpp"
#include "tests/benchmarks/support/measured_child.hpp"
#include "tests/benchmarks/support/timing.hpp"
#include "tests/fem/support/calculix_input.hpp"

namespace {

using namespace articular;
using namespace articular::benchmarks;

constexpr int kRounds = 3;
using Reactions = std::vector<double>;  // at the ends of the steps

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "cube-speed-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// One program on one cube, round after round.
struct Record {
  std::vector<double> seconds;
  double megabytes = 0;
  Reactions reactions;
  std::string details;

  void add(const ChildUse& use) {
    seconds.push_back(use.cpu_seconds);
    megabytes = std::max(megabytes, use.peak_megabytes);
  }
};

void stretch_and_print(int cells, const StretchedCube::Settings& settings) {
  StretchedCube cube(cells);
  const StretchedCube::Report r = cube.stretch(settings);
  for (const double reaction : r.reaction) std::printf("%.12g ", reaction);
  std::printf("%d Newton, %d CG; %.2f + %.2f + %.2f s", r.newton_iterations, r.linear_iterations,
              r.assembly, r.set_up, r.solution);
}

void run_ours(int cells, const StretchedCube::Settings& settings, Record& record) {
  const ChildUse use = measure_in_child([&] { stretch_and_print(cells, settings); });
  if (!use.succeeded) throw std::runtime_error("our own run failed");
  record.add(use);
  std::istringstream output(use.output);
  record.reactions.assign(StretchedCube::kSteps, 0);
  for (double& reaction : record.reactions) output >> reaction;
  std::getline(output >> std::ws, record.details);
}

void write_set(std::ostream& out, const char* name, const Positions& X, double z) {
  out << "*NSET, NSET=" << name << '\n';
  for (Eigen::Index a = 0; a < X.cols(); ++a) {
    if (X(2, a) == z) out << a + 1 << ",\n";
  }
}

/// @param step  the lines of the analysis
void write_input(const std::filesystem::path& file, int cells, const std::string& step) {
  const fem::TetMesh mesh = StretchedCube::make_mesh(cells);
  std::ofstream out(file);
  fem::write_calculix_mesh(out, mesh.X, mesh.tets);
  write_set(out, "LOWER", mesh.X, 0);
  write_set(out, "UPPER", mesh.X, 1);
  fem::write_calculix_neo_hooke(out, StretchedCube::shear_modulus(), StretchedCube::bulk_modulus());
  out << "*BOUNDARY\nLOWER, 1, 3, 0\nUPPER, 1, 2, 0\n" << step << "*END STEP\n";
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

/// Of each table of total forces in CalculiX's output: its third number.
Reactions reactions_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  Reactions reactions;
  for (std::string line; std::getline(in, line);) {
    std::istringstream numbers(line);
    double x = 0, y = 0, z = 0;
    if (numbers >> x >> y >> z) reactions.push_back(z);
  }
  if (reactions.size() != StretchedCube::kSteps)
    throw std::runtime_error("CalculiX has not done its steps: " + file.string());
  return reactions;
}

class CalculiX {
 public:
  static bool installed() { return std::system("command -v ccx > /dev/null 2>&1") == 0; }

  explicit CalculiX(int cells) {
    std::ostringstream analysis;
    analysis << "*STEP, NLGEOM\n*STATIC, SOLVER=ITERATIVE CHOLESKY, DIRECT\n"
             << 1.0 / StretchedCube::kSteps << ", 1\n*BOUNDARY\nUPPER, 3, 3, "
             << StretchedCube::kStretch << "\n*NODE PRINT, NSET=UPPER, TOTALS=ONLY\nRF\n";
    // In a child: this process stays small, as its memory is the floor of what it measures.
    const ChildUse written = measure_in_child([&] {
      write_input(folder_.path() / "cube.inp", cells, analysis.str());
      write_input(folder_.path() / "reading.inp", cells, "*STEP\n*NO ANALYSIS\n");
    });
    if (!written.succeeded) throw std::runtime_error("no input for CalculiX");
  }

  void run(Record& record, Record& reading) const {
    const ChildUse use = measure_program("ccx", {"cube"}, folder_.path().string());
    if (!use.succeeded) throw std::runtime_error("ccx failed");
    record.add(use);
    record.reactions = reactions_in(folder_.path() / "cube.dat");
    record.details =
        lines_of_log(" iteration ") + " Newton, " + lines_of_log("iteration= ") + " CG";
    // Without an analysis it ends with a code of its own.
    reading.add(measure_program("ccx", {"reading"}, folder_.path().string()));
  }

 private:
  std::string lines_of_log(const std::string& start) const {
    std::ifstream in(folder_.path() / "log");
    int count = 0;
    for (std::string line; std::getline(in, line);) count += line.starts_with(start) ? 1 : 0;
    return std::to_string(count);
  }

  TemporaryFolder folder_;
};

double relative_error(double value, double exact) { return std::abs(value / exact - 1); }

void print_row(int cells, const char* name, const Record& record, const Reactions& exact) {
  double worst = 0;
  for (std::size_t k = 0; k < exact.size(); ++k)
    worst = std::max(worst, relative_error(record.reactions[k], exact[k]));
  std::printf("| %d | %s | %.2f | %.0f | %.8f | %.0e | %.0e | %s |", 6 * cells * cells * cells,
              name, median(record.seconds), record.megabytes, record.reactions.back(), worst,
              relative_error(record.reactions.back(), exact.back()), record.details.c_str());
}

void measure(int cells) {
  const StretchedCube::Settings loose, tight{.residual = 1e-5, .linear_residual = 1e-3};
  Record ours, ours_tight, theirs, reading, exact;
  run_ours(cells, {.residual = 1e-10, .linear_residual = 1e-3}, exact);
  if (CalculiX::installed()) {
    const CalculiX calculix(cells);
    for (int round = 0; round < kRounds; ++round) {
      run_ours(cells, loose, ours);
      run_ours(cells, tight, ours_tight);
      calculix.run(theirs, reading);
    }
    char text[32];
    std::snprintf(text, sizeof text, "; reading %.2f s", median(reading.seconds));
    theirs.details += text;
  } else {
    for (int round = 0; round < kRounds; ++round) {
      run_ours(cells, loose, ours);
      run_ours(cells, tight, ours_tight);
    }
  }
  const auto print_ours = [&](const char* name, const Record& record) {
    print_row(cells, name, record, exact.reactions);
    const double ratio = median(record.seconds);
    if (theirs.seconds.empty()) {
      std::printf(" – | – |\n");
    } else {
      const double all = median(theirs.seconds), analysis = all - median(reading.seconds);
      std::printf(" %.1f | %.1f |\n", all / ratio, analysis / ratio);
    }
  };
  print_ours("**residual 1e-4**", ours);
  print_ours("residual 1e-5", ours_tight);
  if (!theirs.seconds.empty()) {
    print_row(cells, "CalculiX", theirs, exact.reactions);
    std::printf(" | |\n");
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  for (int k = 1; k < argc; ++k) {
    const int cells = std::atoi(argv[k]);
    if (cells < 1) {
      std::fprintf(stderr, "usage: cube_speed [CELLS]...\n");
      return 2;
    }
    sizes.push_back(cells);
  }
  if (sizes.empty()) sizes = {16, 24, 32};
  std::printf(
      "| tetrahedra | | CPU s | MB | force | its error, worst step | last | iterations; time "
      "| CalculiX / this | without its reading |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  try {
    for (const int cells : sizes) measure(cells);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cube_speed: %s\n", error.what());
    return 1;
  }
}
