#include "tools/run/contact_doctor.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "sim/run/contact_diagnosis.hpp"

namespace articular::tools {
namespace {

std::string pair_of(const sim::Model& model, sim::ContactId contact) {
  const sim::ContactModel pair = model.contacts[contact];
  return fmt::format("`{}` and `{}`", model.bodies[static_cast<std::size_t>(pair.a)].name,
                     model.bodies[static_cast<std::size_t>(pair.b)].name);
}

std::string words(const sim::Model& model, const sim::ContactTrial& trial) {
  using Contacts = sim::ContactTrial::Contacts;
  if (trial.contacts == Contacts::None) return "no contact";
  const std::string pair = pair_of(model, trial.contact);
  return trial.contacts == Contacts::Alone ? pair + " alone" : "all but " + pair;
}

std::string outcome(const sim::ContactTrial& trial) {
  using Outcome = sim::ContactTrial::Outcome;
  if (trial.outcome == Outcome::Taken) return "taken";
  if (trial.outcome == Outcome::OutOfTime) return "out of time";
  return "fails: " + trial.why;
}

void print_culprits(const sim::Model& model, const sim::ContactDiagnosis& found) {
  using sim::ContactTrial;
  const bool without = found.trials.front().outcome == ContactTrial::Outcome::Taken;
  for (const sim::ContactId contact : found.culprits)
    fmt::print("contact of {} makes it fail\n", pair_of(model, contact));
  if (!found.culprits.empty()) return;
  fmt::print("{}\n", without ? "no pair makes it fail alone, and none is needed for it"
                             : "it is not taken without contact either: look at what else acts");
}

}  // namespace

bool diagnose(const sim::Scenario& scenario, const sim::Model& model, double seconds) {
  const sim::ContactDiagnosis found = sim::diagnose_contact(
      scenario, model, {.seconds = seconds, .progress = [](const std::string& what) {
                          fmt::print(stderr, "articular: diagnose: {}\n", what);
                        }});
  if (found.why.empty()) {
    fmt::print("no step failed until t = {:.6g} s{}\n", found.reached,
               found.ended ? ", the end" : ", where the time was over: --seconds gives it more");
    return false;
  }
  fmt::print("{}\n", found.why);
  if (found.trials.empty()) return true;
  fmt::print("\nthe step from t = {:.6g} s, with\n", found.reached);
  for (const sim::ContactTrial& trial : found.trials)
    fmt::print("  {:<50} {}\n", words(model, trial), outcome(trial));
  fmt::print("\n");
  print_culprits(model, found);
  return true;
}

}  // namespace articular::tools
