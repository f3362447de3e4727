#include "tools/engine/workers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <fstream>
#include <vector>

#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/base/message_text.hpp"
#include "tools/process/measured_program.hpp"
#include "tools/process/started_program.hpp"
#include "tools/process/this_program.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using End = ProgramUse::End;

/// As one word of a shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'')
      result += "'\\''";
    else
      result += c;
  }
  return result + "'";
}

std::string work_command(const fs::path& queue) {
  return fmt::format("exec {} work {} --quiet", quoted(this_program().string()),
                     quoted(queue.string()));
}

/// Runs a short command of an engine. @return what it printed
std::string output_of(const std::vector<std::string>& command, const fs::path& log,
                      const char* package) {
  try {
    const ProgramUse use = run_measured(command, {}, log, {}, [] { return false; });
    std::string text = sim::file_bytes(log);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    if (use.end == End::Exited && use.code == 0) return text;
    throw sim::SystemError(fmt::format("{} failed: {}", command[0], sim::one_line(text)));
  } catch (const sim::SystemError& error) {
    const std::string what = error.what();
    if (what.starts_with("can't start"))
      throw sim::SystemError(fmt::format("{} (Debian: {})", what, package));
    throw;
  }
}

Workers slurm_workers(const fs::path& queue, int count, int threads) {
  struct Job {
    std::string id;
    fs::path log;
    Clock::time_point next_look = Clock::now();
    bool is_there = true;
    Job() = default;
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;
    ~Job() {
      try {
        output_of({"scancel", "--quiet", id}, log, "slurm-client");
      } catch (const std::exception&) {  // it has ended, or Slurm has
      }
    }
    bool look() {
      constexpr std::chrono::seconds kEvery{2};
      if (Clock::now() < next_look) return is_there;
      next_look = Clock::now() + kEvery;
      try {
        is_there = !output_of({"squeue", "--noheader", "--jobs", id}, log, "slurm-client").empty();
      } catch (const sim::SystemError&) {
        // An unknown job has ended; a controller that does not answer may come back, and the job
        // with it.
        is_there = sim::file_bytes(log).find("Invalid job id") == std::string::npos;
      }
      return is_there;
    }
  };
  auto job = std::make_shared<Job>();
  job->log = queue / "slurm.log";
  std::string id =
      output_of({"sbatch", "--parsable", "--job-name=articular",
                 "--array=1-" + std::to_string(count), "--cpus-per-task=" + std::to_string(threads),
                 "--output=" + (queue / "worker-%a.log").string(), "--wrap=" + work_command(queue)},
                job->log, "slurm-client");
  job->id = id.substr(0, id.find(';'));  // "ID;CLUSTER"
  return {[job] { return job->look(); },
          fmt::format("Slurm, job array {} of {} workers", job->id, count), job};
}

/// Programs that this one starts, as `ssh`.
struct Started {
  std::vector<std::unique_ptr<StartedProgram>> programs;
  bool look() {
    bool any = false;
    for (const auto& program : programs) any = program->is_running() || any;
    return any;
  }
};

Workers parallel_workers(const EngineOptions& options, const fs::path& queue, int count) {
  std::vector<std::string> command{"parallel", "--will-cite", "-N0", "--jobs",
                                   std::to_string(count)};
  if (!options.machines.empty()) {
    command.emplace_back("--sshloginfile");
    command.push_back(fs::absolute(options.machines).string());
  }
  command.push_back(work_command(queue));
  command.emplace_back(":::");
  for (int i = 1; i <= count; ++i) command.push_back(std::to_string(i));
  const auto started = std::make_shared<Started>();
  try {
    started->programs.push_back(std::make_unique<StartedProgram>(command, queue / "parallel.log"));
  } catch (const sim::SystemError& error) {
    throw sim::SystemError(std::string(error.what()) + " (Debian: parallel)");
  }
  return {[started] { return started->look(); }, fmt::format("GNU parallel, {} workers", count),
          started};
}

struct Machine {
  std::string name;
  int workers = 0;
};

/// Lines "NAME [WORKERS]"; empty ones and those that begin with # don't count.
std::vector<Machine> read_machines(const fs::path& file, int workers) {
  std::ifstream stream(file);
  if (!stream)
    throw sim::InputError({file.string()},
                          "can't be read; expected a file with a machine a line, for `--machines`");
  std::vector<Machine> machines;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    Machine machine{line.substr(begin, end - begin), workers};
    const std::size_t count = line.find_first_not_of(" \t\r", end);
    if (count != std::string::npos) {
      const std::size_t last = line.find_last_not_of(" \t\r") + 1;
      const auto [stop, error] =
          std::from_chars(line.data() + count, line.data() + last, machine.workers);
      if (error != std::errc() || stop != line.data() + last || machine.workers < 1)
        throw sim::InputError({file.string(), number, static_cast<int>(count) + 1},
                              "expected a number of workers after the machine, found `" +
                                  line.substr(count, last - count) + "`");
    }
    machines.push_back(machine);
  }
  if (machines.empty())
    throw sim::InputError({file.string()}, "names no machine; expected one a line: NAME [WORKERS]");
  return machines;
}

Workers ssh_workers(const EngineOptions& options, const fs::path& queue, int count) {
  const std::vector<Machine> machines = read_machines(options.machines, count);
  const auto started = std::make_shared<Started>();
  int all = 0;
  for (const Machine& machine : machines)
    for (int i = 1; i <= machine.workers; ++i, ++all)
      started->programs.push_back(std::make_unique<StartedProgram>(
          std::vector<std::string>{"ssh", "-o", "BatchMode=yes", machine.name, work_command(queue)},
          queue / fmt::format("ssh-{}.log", all + 1)));
  return {[started] { return started->look(); },
          fmt::format("ssh, {} workers on {} machines", all, machines.size()), started};
}

}  // namespace

Workers start_workers(const EngineOptions& options, const fs::path& queue, int count, int threads) {
  switch (options.kind) {
    case EngineKind::Slurm:
      return slurm_workers(queue, count, threads);
    case EngineKind::Parallel:
      return parallel_workers(options, queue, count);
    case EngineKind::Ssh:
      return ssh_workers(options, queue, count);
    default:
      return {[] { return true; }, "whoever runs: articular work " + quoted(queue.string()), {}};
  }
}

}  // namespace articular::tools
