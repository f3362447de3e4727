#include "tools/import/import_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/base/message_text.hpp"
#include "sim/mesh/febio_mesh.hpp"
#include "sim/scenario/scenario.hpp"
#include "tools/import/febio_scenario.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

/// What is written is valid, but it is not the whole model.
constexpr int kNotTheWhole = 3;

struct ImportOptions {
  fs::path model, directory;
  std::string units;
};

const UnitSystem& units_of(const ImportOptions& options, const FebioModel& model) {
  if (!options.units.empty()) return unit_system(options.units);
  if (model.units) return unit_system(*model.units);
  throw sim::InputError({options.model.string()},
                        "the model does not say its units (<Module><units>); expected --units with "
                        "one of " +
                            unit_system_names());
}

/// The losses stand in the file too: whoever runs it later should know.
std::string with_losses(const ImportedScenario& scenario, const std::string& source) {
  std::string head = fmt::format("# Made by `articular import` from {}.\n", sim::one_line(source));
  for (const Loss& loss : scenario.losses)
    head += fmt::format("# Not taken over, line {}: {}\n", loss.line, sim::one_line(loss.what));
  return head + scenario.text;
}

int import_model(const ImportOptions& options) {
  const std::string file = options.model.string();
  if (options.model.extension() != ".feb")
    throw sim::InputError({file}, "expected a FEBio model that ends in .feb");
  const std::string bytes = sim::file_bytes(options.model);
  const sim::XmlElement document = sim::read_xml_tree(file, ".feb", bytes);
  const sim::MeshData mesh = sim::febio_mesh(file, document);
  FebioModel model = read_febio_model(file, document);
  const std::string name = options.model.stem().string();
  model.title = name;
  const UnitSystem& units = units_of(options, model);
  const ImportedScenario scenario = scenario_of(file, model, mesh, units, name + ".feb");

  const fs::path directory = options.directory.empty() ? fs::path("out") / name : options.directory;
  sim::make_folders(directory);
  const fs::path written = directory / (name + ".toml"), copy = directory / (name + ".feb");
  std::error_code error;
  if (!fs::equivalent(copy, options.model, error)) sim::write_text_file(copy, bytes);
  sim::write_text_file(written, with_losses(scenario, file));
  fmt::print("{}\n{}\n", written.string(), copy.string());
  for (const Loss& loss : scenario.losses)
    fmt::print(stderr, "articular: {}:{}: not taken over: {}\n", file, loss.line,
               sim::one_line(loss.what));
  sim::read_scenario(written, {});  // constants that FEBio takes and we do not
  return scenario.losses.empty() ? 0 : kNotTheWhole;
}

const char* const kImportHelp =
    R"(Writes DIR/NAME.toml, a scenario, and DIR/NAME.feb beside it, from which the scenario takes its
meshes and sets. Versions 2.5, 3.0 and 4.0 of FEBio's format, solid mechanics. What could not be
taken over is listed on stderr with its line, and in the scenario; the exit code is 3 then. Solver
settings, penalties of contact and requests for output have no counterpart and are not listed.
tools/import/README.md says what becomes of what.

Example
  articular import knee.feb -o out/knee --units mm-N-s
  articular check out/knee/knee.toml)";

}  // namespace

void add_import_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App& command = *app.add_subcommand("import", "A FEBio model as a scenario");
  command.add_option("model", options->model, "FEBio model (.feb)")->required()->type_name("MODEL");
  command.add_option("-o,--out", options->directory, "Folder of the scenario (default: out/NAME)")
      ->type_name("DIR");
  command
      .add_option("--units", options->units,
                  "Units of the model's numbers: SI, mm-N-s, mm-kg-s, um-nN-s, CGS, mm-g-s or "
                  "mm-mg-s [as the model says]")
      ->type_name("SYSTEM");
  command.footer(kImportHelp);
  command.callback([options, &exit_code] { exit_code = import_model(*options); });
}

}  // namespace articular::tools
