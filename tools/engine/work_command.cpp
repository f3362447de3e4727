#include "tools/engine/work_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "sim/base/error.hpp"
#include "tools/engine/work.hpp"
#include "tools/process/interruption.hpp"

namespace articular::tools {
namespace {

struct WorkArguments {
  std::filesystem::path folder;
  WorkOptions options;
};

const char* const kWorkHelp =
    R"(Cases of `articular study STUDY.toml --engine folder` wait in OUT/queue. Any number of workers may
take them, on this machine or on others that see the same folder under the same path. Each case is
taken once. A worker that is asked to end puts back what it runs. One that dies costs its case only:
the study notices that it has fallen silent. tools/engine/README.md says what the files of the folder are.)";

}  // namespace

void add_work_command(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<WorkArguments>();
  CLI::App& command = *app.add_subcommand("work", "Runs cases that a study has put into a folder");
  command.add_option("folder", arguments->folder, "The queue of a study: OUT/queue")
      ->required()
      ->type_name("DIR");
  command
      .add_option("case", arguments->options.names,
                  "Names of cases: NAME of NAME.task. Without any, all that wait")
      ->type_name("CASE");
  command.add_flag("--wait", arguments->options.wait,
                   "Wait for more, until the study is done or stopped");
  command.add_flag("--quiet", arguments->options.quiet, "No progress on stderr");
  command.footer(kWorkHelp);
  command.callback([arguments, &exit_code] {
    if (!std::filesystem::is_directory(arguments->folder))
      throw sim::InputError(arguments->folder.string() +
                            ": no such folder; expected the queue of a study, OUT/queue");
    listen_for_interruption();
    TaskQueue queue(std::filesystem::absolute(arguments->folder));
    if (!arguments->options.wait && !queue.is_of_a_study())
      throw sim::InputError(
          arguments->folder.string() +
          ": no case of a study waits, runs or has ended here; expected its queue, OUT/queue, or "
          "`--wait` for one that is yet to begin");
    exit_code = work(queue, arguments->options);
  });
}

}  // namespace articular::tools
