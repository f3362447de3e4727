#include "tools/report/report_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "tools/report/report.hpp"

namespace articular::tools {

void add_report_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App& command = *app.add_subcommand(
      "report", "One web page of a run, or of the set-up of a scenario, that opens offline");
  command
      .add_option("what", options->what,
                  "Folder of a run: what was computed and how far to trust it, curves, pictures, "
                  "a 3D view that turns. A scenario (.toml, or the name of a shipped one): the 3D "
                  "view before any run")
      ->required()
      ->type_name("DIR|SCENARIO");
  command
      .add_option("-o,--out", options->out,
                  "Page to write (.html) [DIR/report.html; of a scenario NAME_setup.html]")
      ->type_name("FILE");
  command.callback([options, &exit_code] { exit_code = report(*options); });
}

}  // namespace articular::tools
