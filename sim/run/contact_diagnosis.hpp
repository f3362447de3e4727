#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/model/model.hpp"

namespace articular::sim {

/// A step that failed, tried again with some contacts alone.
struct ContactTrial {
  enum class Contacts { None, Alone, AllBut };
  enum class Outcome { Taken, Failed, OutOfTime };
  Contacts contacts = Contacts::None;
  ContactId contact = -1;  // the one that is alone, or left out
  Outcome outcome = Outcome::Taken;
  std::string why;  // it failed
};

struct ContactDiagnosis {
  double reached = 0;  // [s] the last state that was accepted
  bool ended = false;  // at the scenario's duration, without a failure
  std::string why;     // it failed there; empty: it did not, as long as it was looked at
  std::vector<ContactTrial> trials;
  /// Without each of these alone the step is taken; where there is none, each of these alone makes
  /// it fail that is taken without contact.
  std::vector<ContactId> culprits;
};

struct DiagnosisOptions {
  double seconds = 60;  // of wall time until the failure, and again for all trials
  /// Told what is tried next.
  std::function<void(const std::string&)> progress = {};
};

/// Goes on from the start until a step fails, then tries that step from the same state without
/// contact, with each pair alone, and with all pairs but one. Pairs whose bodies are more than an
/// element apart, box from box, stay as they are: they don't meet in this step. Writes nothing.
ContactDiagnosis diagnose_contact(const Scenario& scenario, const Model& model,
                                  const DiagnosisOptions& options);

}  // namespace articular::sim
