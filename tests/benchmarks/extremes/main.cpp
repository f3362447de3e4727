// Tries what breaks simulators: extremes of step, material, mesh, load and start, each by
// `articular run` in a process of its own, and says how each came out: right, degraded (stable, and
// warned of), refused (with a message), failed.
//
//     extremes [--only NAME] [--quick] [--jobs N] [--out DIR] [--program FILE]
//
// Prints a Markdown table; DIR has extremes.csv and what every run has left. Exit code 1 where
// something failed or came out otherwise than the code of this program expects.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <fstream>
#include <mutex>

#include "parallel/thread_pool.hpp"
#include "tests/benchmarks/extremes/extreme.hpp"
#include "tests/benchmarks/extremes/table.hpp"

namespace articular::benchmarks {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string only;
  bool quick = false;
  int jobs = 1;
  fs::path out = "out/extremes", program = ARTICULAR_PROGRAM;
};

std::vector<Extreme> chosen(const Arguments& arguments) {
  std::vector<Extreme> extremes = all_extremes();
  std::erase_if(extremes, [&](const Extreme& extreme) {
    return (arguments.quick && !extreme.quick) ||
           (extreme.name + " " + extreme.range).find(arguments.only) == std::string::npos;
  });
  return extremes;
}

Row row_of(const Extreme& extreme, const fs::path& program, const fs::path& folder) {
  const auto start = std::chrono::steady_clock::now();
  Row row{extreme.name, extreme.range, {}, extreme.expected, 0};
  try {
    row.finding = extreme.study(Bench(program, folder));
  } catch (const std::exception& error) {
    row.finding = {Outcome::Failed, error.what()};
  }
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return row;
}

int study(const Arguments& arguments) {
  const std::vector<Extreme> extremes = chosen(arguments);
  const fs::path out = fs::absolute(arguments.out);
  std::vector<Row> rows(extremes.size());
  std::mutex printing;
  ThreadPool pool(arguments.jobs);  // each thread waits for a program
  pool.run(static_cast<int>(extremes.size()), [&](int k, int) {
    const auto i = static_cast<std::size_t>(k);
    rows[i] = row_of(extremes[i], fs::absolute(arguments.program), out / fmt::format("{:02}", i));
    const std::scoped_lock lock(printing);
    fmt::print(stderr, "{} {}: {}\n", rows[i].name, rows[i].range,
               name_of(rows[i].finding.outcome));
  });
  fs::create_directories(out);
  std::ofstream(out / "extremes.csv") << csv(rows);
  fmt::print("{}", markdown(rows));
  const auto unexpected = [](const Row& row) {
    return row.finding.outcome != row.expected || row.finding.outcome == Outcome::Failed;
  };
  for (const Row& row : rows)
    if (row.finding.outcome != row.expected)
      fmt::print(stderr, "expected {}: {} {}\n", name_of(row.expected), row.name, row.range);
  return std::any_of(rows.begin(), rows.end(), unexpected) ? 1 : 0;
}

}  // namespace
}  // namespace articular::benchmarks

int main(int argc, char** argv) {
  articular::benchmarks::Arguments arguments;
  CLI::App app("How articular comes out of extremes: a table", "extremes");
  app.add_option("--only", arguments.only, "Rows whose extreme and range contain this");
  app.add_flag("--quick", arguments.quick, "Rows that take a few seconds at most");
  app.add_option("--jobs", arguments.jobs, "Rows at a time [1]")->check(CLI::Range(1, 64));
  app.add_option("--out", arguments.out, "Folder of extremes.csv and the runs [out/extremes]");
  app.add_option("--program", arguments.program, "articular, if not the one built beside this");
  CLI11_PARSE(app, argc, argv);
  return articular::benchmarks::study(arguments);
}
