#pragma once

#include <functional>
#include <string>
#include <vector>

namespace articular::benchmarks {

/// What a process has used until its end.
struct ChildUse {
  bool succeeded = false;
  double cpu_seconds = 0;     // of its threads and children, in the program and in the kernel
  double peak_megabytes = 0;  // of memory
  std::string output;         // what it has written to standard output
};

/// Runs `work` in a copy of this process. The copy starts with this one's memory, and its peak
/// is no lower than that: keep the caller small.
/// @return what it used; failed where `work` throws or exits with another code than 0
ChildUse measure_in_child(const std::function<void()>& work);

/// Runs a program, found by PATH, in a folder; its output goes to the file `log` there. OpenMP and
/// BLAS get one thread.
ChildUse measure_program(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& folder);

}  // namespace articular::benchmarks
