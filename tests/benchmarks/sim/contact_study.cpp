// tests/benchmarks/contact_study [STUDY]... [rule RULE] [stiffness FACTOR]
//                                [element plain|smoothed] [finest N]
//
// Verifies contact in static scenes put together in code; prints tables in markdown.
//
//     patch      two tissue blocks, or a block and a rigid plate, on meshes that do not match
//     drag       a rigid sphere dragged over a tissue block
//     hertz      a rigid sphere on a large block          cylinders  two of tissue, crossed
//     layer      a thin layer on bone under a large rigid sphere
//     lines      a punch with edges pushed across the mesh lines of a block
//     pressure   what is told of the pressure: a flat punch, a sphere, a wedge with a sharp edge
//     responses  both rules at three stiffnesses, by three of these scenes
//
//     contact_study patch
//     contact_study drag stiffness 10
//     contact_study hertz layer element plain
//
// Without a study all of them. `rule` is how depths count: averaged, which is what statics does, or
// pointwise. `stiffness` multiplies the contact stiffness that the model chooses; studies that
// refine stop at `finest` (default 16) elements over their length.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/benchmarks/sim/contact_study.hpp"

namespace {

using namespace articular::sim;

struct Study {
  const char* name;
  void (*run)(const StudyOptions&);
};
constexpr Study kStudies[] = {{"patch", study_patch},         {"drag", study_drag},
                              {"hertz", study_hertz},         {"cylinders", study_cylinders},
                              {"layer", study_layer},         {"lines", study_lines},
                              {"responses", study_responses}, {"pressure", study_pressure}};

const Study* find_study(const std::string& name) {
  for (const Study& study : kStudies)
    if (study.name == name) return &study;
  return nullptr;
}

/// @return whether `name` is an option.
bool set_option(const std::string& name, const std::string& value, StudyOptions& options) {
  if (name == "stiffness") {
    options.stiffness = std::stod(value);
  } else if (name == "element" && (value == "plain" || value == "smoothed")) {
    options.element =
        value == "plain" ? TissueMaterial::Element::Plain : TissueMaterial::Element::Smoothed;
  } else if (name == "rule") {
    const auto rule = std::find(std::begin(kDepthRules), std::end(kDepthRules), value);
    if (rule == std::end(kDepthRules)) return false;
    options.rule = static_cast<DepthRule>(rule - std::begin(kDepthRules));
  } else if (name == "finest") {
    options.finest = std::stoi(value);
  } else {
    return false;
  }
  return true;
}

void run_studies(const std::vector<std::string>& arguments) {
  StudyOptions options;
  std::vector<const Study*> chosen;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (const Study* study = find_study(arguments[i])) {
      chosen.push_back(study);
    } else if (i + 1 < arguments.size() && set_option(arguments[i], arguments[i + 1], options)) {
      ++i;
    } else {
      throw std::invalid_argument("no study, and no option with such a value: `" + arguments[i] +
                                  "`; see the top of contact_study.cpp");
    }
  }
  if (chosen.empty())
    for (const Study& study : kStudies) chosen.push_back(&study);
  for (const Study* study : chosen) study->run(options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run_studies({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contact_study: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
