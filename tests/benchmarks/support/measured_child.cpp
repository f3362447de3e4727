#include "tests/benchmarks/support/measured_child.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <system_error>

namespace articular::benchmarks {
namespace {

constexpr double kMicro = 1e-6;
constexpr int kNotRun = 127;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + kMicro * static_cast<double>(time.tv_usec);
}

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

std::string all_of(int file) {
  std::string text;
  std::array<char, 4096> part;
  for (ssize_t n = 0; (n = read(file, part.data(), part.size())) > 0;) {
    text.append(part.data(), static_cast<std::size_t>(n));
  }
  return text;
}

ChildUse use_of(pid_t child) {
  int status = 0;
  rusage usage;
  if (wait4(child, &status, 0, &usage) != child) fail("wait4");
  return {.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0,
          .cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime),
          .peak_megabytes = static_cast<double>(usage.ru_maxrss) / 1024,
          .output = {}};
}

[[noreturn]] void become(std::string program, std::vector<std::string> arguments,
                         const std::string& folder) {
  for (const char* threads : {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"}) setenv(threads, "1", 1);
  const int log = chdir(folder.c_str()) == 0 ? open("log", O_WRONLY | O_CREAT | O_TRUNC, 0600) : -1;
  std::vector<char*> words{program.data()};
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  if (log >= 0 && dup2(log, STDOUT_FILENO) >= 0 && dup2(log, STDERR_FILENO) >= 0)
    execvp(program.c_str(), words.data());
  _exit(kNotRun);
}

}  // namespace

ChildUse measure_in_child(const std::function<void()>& work) {
  std::array<int, 2> ends;
  if (pipe(ends.data()) != 0) fail("pipe");
  std::fflush(stdout);  // or the copy would write it as well
  const pid_t child = fork();
  if (child < 0) fail("fork");
  if (child == 0) {
    close(ends[0]);
    dup2(ends[1], STDOUT_FILENO);
    try {
      work();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      _exit(EXIT_FAILURE);
    }
    std::fflush(stdout);
    _exit(EXIT_SUCCESS);
  }
  close(ends[1]);
  std::string output = all_of(ends[0]);
  close(ends[0]);
  ChildUse use = use_of(child);
  use.output = std::move(output);
  return use;
}

ChildUse measure_program(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& folder) {
  const pid_t child = fork();
  if (child < 0) fail("fork");
  if (child == 0) become(program, arguments, folder);
  return use_of(child);
}

}  // namespace articular::benchmarks
