#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/study/population.hpp"
#include "tools/study/study_settings.hpp"

/// STUDY.toml: a scenario, what to vary in it, what to look at, and what is right.
/// tools/study/README.md has the format.
namespace articular::tools {

/// One thing to vary. Its choices have names such as "0.5 ms" or "smoothed".
struct StudyKnob {
  struct Choice {
    std::string name;
    StudySettings settings;
  };
  std::string name;
  std::vector<Choice> choices;
  std::string path = {};  // of the value that is varied; "": choices set what they like
};

/// A run beside those that the knobs make.
struct StudyExtra {
  std::string name;
  StudySettings settings;
};

/// How a column of history.csv becomes what is compared.
enum class StudyValue { Last, Change, Largest, Smallest, Mean, History };

struct StudyOutput {
  std::string name;
  std::string column;  // as in the file, "tip.position.z [mm]"
  StudyValue value = StudyValue::Last;
  std::optional<double> scale;  // an error of 1, in the column's unit; default: the reference
  std::optional<double> exact;  // the right value, in the column's unit
};

/// A converged run; `size` is that of its step or element, relative to the other reference runs.
struct StudyReference {
  double size = 1;
  StudySettings settings;
};

struct Study {
  std::filesystem::path file, scenario;
  std::vector<std::string> command;  // in place of the scenario
  std::string name, title;           // name: the file's, without its ending
  StudySettings settings;            // of every run
  int repeats = 1;
  bool every_combination = false;    // of the knobs' choices; else one knob at a time
  std::optional<double> time_limit;  // of a run [s]
  std::vector<StudyKnob> knobs;
  std::vector<StudyExtra> extras;
  std::vector<StudyOutput> outputs;
  std::vector<StudyReference> references;  // finest first; one, two or three of them, or none
  std::optional<Population> population;

  /// Nothing says what is right: only the outputs of the cases are listed.
  bool is_sweep() const;
};

/// The keys of a study file.
const sim::KeyTable& study_keys();

/// @throws sim::InputError  with file, line and column
Study read_study(const std::filesystem::path& file);

}  // namespace articular::tools
