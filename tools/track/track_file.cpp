#include "tools/track/track_file.hpp"

#include <algorithm>

#include "sim/output/history_column.hpp"
#include "sim/scenario/csv_table.hpp"
#include "sim/scenario/data_path.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"
#include "tools/study/history_columns.hpp"
#include "tools/study/study_settings.hpp"

namespace articular::tools {
namespace {

using sim::KeyTable;
using sim::Node;
using sim::TableReader;
namespace form = sim::form;

/// A plain number, or a table of `time` and `value`.
sim::KeyType number_or_curve() {
  return {form::Either{{{form::Number{sim::kAny}}, {form::Table{sim::curve_keys}}}}};
}

sim::Curve read_number_or_curve(const Node& node, const sim::Range& range) {
  if (node.table() == nullptr) return {{0}, {sim::read_number(node, range)}};
  static const std::vector<sim::Body> kNoBodies;
  return sim::read_curve(node, range, {{}, kNoBodies});
}

/// What is compared has one unit, where both have one.
void check_units(const Node& node, const std::string& in_file, const std::string& of_probe) {
  const std::string file = sim::history_column(in_file).unit,
                    probe = sim::history_column(of_probe).unit;
  if (!file.empty() && !probe.empty() && file != probe)
    sim::fail(node,
              fmt::format("the file's column is in {}, and `{}` in {}: expected the same unit",
                          file, sim::one_line(of_probe), probe));
}

/// A column of a table over time, such as history.csv of a run.
sim::Curve read_column(const std::filesystem::path& file, const std::string& column,
                       const Node& reference) {
  constexpr const char* kTimeColumn = "time [s]";
  std::size_t time = 0, value = 0;
  const sim::CsvTable table =
      sim::read_csv(file, "the target", reference.where, [&](const sim::CsvRow& headers) {
        const auto find = [&](const std::string& name) {
          const auto found = std::find(headers.fields.begin(), headers.fields.end(), name);
          if (found == headers.fields.end())
            throw sim::InputError(
                headers.where,
                fmt::format("no column `{}`{}", name,
                            name == kTimeColumn ? ", which has the times in seconds"
                                                : sim::suggestion(name, headers.fields)));
          return static_cast<std::size_t>(found - headers.fields.begin());
        };
        time = find(kTimeColumn);
        value = find(column);
      });
  sim::Curve curve;
  for (const sim::CsvRow& row : table.rows) {
    const double t = sim::csv_number(row.fields[time], kTimeColumn, row.where);
    if (!curve.time.empty() && !(t > curve.time.back()))
      throw sim::InputError(row.where, fmt::format("times must increase, found {:g} s after {:g} s",
                                                   t, curve.time.back()));
    curve.time.push_back(t);
    curve.value.push_back(sim::csv_number(row.fields[value], column, row.where));
  }
  return curve;
}

const KeyTable& target_keys() {
  static const KeyTable kTable{
      "[[target]] of a track",
      {{"name", {form::Text{"name"}}, sim::otherwise("the column"), "for the report"},
       {"column", history_columns(), sim::kRequired,
        "what a probe shows, with its unit; of a list the sum"},
       {"value",
        {number_or_curve()},
        sim::otherwise("or `file`"),
        "what it should be, in the column's unit: a number, or a curve, which counts from its "
        "first to its last time"},
       {"file",
        {form::Text{"path"}},
        sim::kNone,
        "in its place: a table (.csv) with `time [s]`, such as history.csv of a run"},
       {"file_column",
        {form::Text{"column of the file"}},
        sim::otherwise("`column`"),
        "which column of the file"},
       {"spread",
        {form::Number{sim::kPositive}},
        sim::kRequired,
        "its standard deviation, in the same unit: targets count by it"}}};
  return kTable;
}

TrackTarget read_target(const Node& node, const std::filesystem::path& folder) {
  const TableReader table(node, target_keys(), "[[target]]");
  TrackTarget target;
  target.where = node.where;
  target.columns = read_history_columns(table.at("column"));
  target.name = fmt::format("{}", fmt::join(target.columns, " + "));
  table.read("name", target.name);
  const Node& value = table.exactly_one({"value", "file"});
  if (table.find("value") != nullptr) {
    table.refuse({"file_column"}, "it is a column of `file`");
    target.value = read_number_or_curve(value, sim::kAny);
  } else {
    std::string column = target.columns.front();
    if (table.find("file_column") == nullptr && target.columns.size() > 1)
      sim::fail(value, "of several columns the sum is fitted: expected `file_column` beside it");
    table.read("file_column", column);
    check_units(value, column, target.columns.front());
    target.value = read_column(sim::read_path(value, folder), column, value);
  }
  table.read("spread", target.spread);
  return target;
}

const KeyTable& track_muscle_keys() {
  static const KeyTable kTable{
      "[[muscle]] of a track",
      {{"name",
        {form::Text{"name of a muscle"}},
        sim::kRequired,
        "of the scenario; `*` in it stands for any characters. The first entry that fits a muscle "
        "counts"},
       {"together",
        {form::Boolean{}},
        sim::standard(false),
        "`true`: all muscles that fit have one excitation"},
       {"lowest", {form::Number{sim::kFraction}}, sim::standard(0.0), "bound of the excitation"},
       {"highest", {form::Number{sim::kFraction}}, sim::standard(1.0), "bound of the excitation"},
       {"emg", {number_or_curve()}, sim::kNone, "excitation as it was measured, 0 to 1"},
       {"emg_spread",
        {form::Number{sim::kPositive}},
        sim::otherwise("needed with `emg`"),
        "its standard deviation"}}};
  return kTable;
}

TrackMuscle read_track_muscle(const Node& node) {
  const TableReader table(node, track_muscle_keys(), "[[muscle]]");
  TrackMuscle muscle;
  muscle.where = node.where;
  muscle.name = sim::read_text(table.at("name"));
  table.read("together", muscle.together);
  table.read("lowest", muscle.lowest);
  table.read("highest", muscle.highest);
  if (!(muscle.lowest < muscle.highest))
    sim::fail(node, "expected `lowest` to be less than `highest`");
  if (const Node* emg = table.find("emg")) {
    muscle.emg = read_number_or_curve(*emg, sim::kFraction);
    table.at("emg_spread");
    table.read("emg_spread", muscle.emg_spread);
  } else {
    table.refuse({"emg_spread"}, "it is that of `emg`");
  }
  return muscle;
}

}  // namespace

const KeyTable& track_keys() {
  static const KeyTable kTable{
      "track",
      {{"title", {form::Text{"text"}}, sim::otherwise("file name"), "for the report"},
       {"scenario", {form::Text{"path"}}, sim::kRequired, "the scene, from the track's folder"},
       {"set",
        {form::Map{"path of a value", {{form::Anything{}}}}},
        sim::kNone,
        "values that it changes, as `articular run --set PATH=VALUE`"},
       {"duration",
        {form::Quantity{sim::kTime, sim::kPositive}},
        sim::otherwise("the scenario's"),
        "until when"},
       {"interval",
        {form::Quantity{sim::kTime, sim::kPositive}},
        sim::otherwise("static: the load step; else that of the output"),
        "excitations are found at its multiples, and are linear between them"},
       {"look_ahead",
        {form::Quantity{sim::kTime, sim::kPositive}},
        sim::otherwise("an interval"),
        "dynamic: how far ahead targets count where an excitation is found"},
       {"cost",
        {form::Choice{{{"squares", TrackCost::Squares},
                       {"cubes", TrackCost::Cubes},
                       {"largest", TrackCost::Largest}}}},
        sim::standard("squares"),
        "what is least among excitations that meet the targets alike: the sum of squares, of "
        "cubes, or the square of the largest"},
       {"effort",
        {form::Number{sim::kPositive}},
        sim::standard(0.1),
        "the cost of a muscle at full excitation, in squared spreads of a target"},
       {"muscle",
        {sim::entries_of({form::Table{track_muscle_keys}})},
        sim::kRequired,
        "whose excitations are found; others keep those of the scenario"},
       {"target",
        {sim::entries_of({form::Table{target_keys}})},
        sim::kRequired,
        "what is known of motions and forces"}}};
  return kTable;
}

Track read_track(const std::filesystem::path& file) {
  const Node root = sim::read_toml(file);
  const TableReader document(root, track_keys(), "track");
  Track track;
  track.file = file;
  track.name = file.stem().string();
  track.title = track.name;
  document.read("title", track.title);
  track.scenario = file.parent_path() / sim::read_text(document.at("scenario"));
  if (const Node* set = document.find("set")) {
    if (set->table() == nullptr)
      sim::fail(*set, "expected a table of paths and values, { \"integrator.step\" = \"1 ms\" }");
    for (const sim::Member& member : set->table()->members)
      track.overrides.push_back(member.key + "=" + toml_text(member.node));
  }
  document.read("duration", track.duration);
  document.read("interval", track.interval);
  document.read("look_ahead", track.look_ahead);
  document.read("cost", track.cost);
  document.read("effort", track.effort);
  sim::Mistakes mistakes;
  for (const Node& node : sim::read_list(document.at("muscle"), "[[muscle]] tables"))
    mistakes.in([&] { track.muscles.push_back(read_track_muscle(node)); });
  for (const Node& node : sim::read_list(document.at("target"), "[[target]] tables"))
    mistakes.in([&] { track.targets.push_back(read_target(node, file.parent_path())); });
  mistakes.tell();
  return track;
}

}  // namespace articular::tools
