#include "tools/verify/verify.hpp"

#include <algorithm>
#include <chrono>
#include <new>

#include "sim/base/error.hpp"
#include "tools/process/temporary_folder.hpp"

namespace articular::tools {
namespace {

Outcome outcome_of(const Problem& problem, const std::function<bool()>& is_to_stop) {
  using Clock = std::chrono::steady_clock;
  Outcome outcome;
  outcome.problem = problem.name;
  const Clock::time_point start = Clock::now();
  const TemporaryFolder folder;
  try {
    outcome.findings = problem.solve({folder.path(), is_to_stop});
  } catch (const sim::Interruption&) {
    throw;
  } catch (const sim::SystemError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    outcome.error = error.what();
  }
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return outcome;
}

}  // namespace

bool Outcome::passed() const {
  return error.empty() && !findings.empty() &&
         std::all_of(findings.begin(), findings.end(), [](const Finding& f) { return f.passed(); });
}

std::vector<Outcome> verify(const std::vector<Problem>& problems, const VerifyWatch& watch) {
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    if (watch.is_to_stop()) throw sim::Interruption();
    if (watch.before) watch.before(problems[i].name, i);
    outcomes.push_back(outcome_of(problems[i], watch.is_to_stop));
    if (watch.after) watch.after(outcomes.back());
  }
  return outcomes;
}

}  // namespace articular::tools
