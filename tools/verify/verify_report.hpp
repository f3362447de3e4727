#pragma once

#include <string>
#include <vector>

#include "sim/output/provenance.hpp"
#include "tools/verify/verify.hpp"

/// The outcomes of `articular verify` as text.
namespace articular::tools {

/// What was verified, and the names of the columns.
std::string table_head(const sim::Provenance& by);
/// A row for each finding.
std::string table_rows(const Outcome& outcome);
/// How many passed, and which did not.
std::string table_end(const std::vector<Outcome>& outcomes);

/// All of it; numbers that are missing are null.
std::string outcomes_json(const sim::Provenance& by, const std::vector<Outcome>& outcomes);

/// 0 where all passed, else 1: a wrong result on this machine is a bug of ours.
int exit_code_of(const std::vector<Outcome>& outcomes);

}  // namespace articular::tools
