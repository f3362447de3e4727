#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

/// The engines of a study: each starts workers somewhere, and all workers do the same, see
/// task_queue.hpp.
namespace articular::tools {

enum class EngineKind { Local, Slurm, Parallel, Ssh, Folder };

struct EngineOptions {
  EngineKind kind = EngineKind::Local;
  std::filesystem::path machines;  // of ssh and GNU parallel: a line each
  double silence_limit = 60;       // [s] a worker that is not heard of for longer has died
};

/// Workers of an engine. When the last copy goes, they are asked to end.
struct Workers {
  /// Whether any is left, as far as is known.
  std::function<bool()> are_there;
  std::string where;  // for people
  std::shared_ptr<void> life;
};

/// @param queue    folder of the queue, absolute
/// @param count    how many workers, of ssh: where a machine's line does not say
/// @param threads  what each of them needs
/// @throws sim::InputError   when the file of machines is no such file
/// @throws sim::SystemError  when nothing can be started: says why
Workers start_workers(const EngineOptions& options, const std::filesystem::path& queue, int count,
                      int threads);

}  // namespace articular::tools
