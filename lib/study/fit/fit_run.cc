#include "lib/study/fit/fit_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "lib/core/errors.h"

namespace orthodyn::study::fit {

namespace {

// Searches from all starts. Failures of single starts are results.
void search_all(const Problem& problem, const Fit& fit, const JobOptions& options, const FitListener& listener,
                Result& result) {
  const std::vector<Vector> starts = starts_of(problem, fit);
  for (std::size_t k = 0; k < starts.size(); ++k) {
    if (starts.size() > 1) listener.on_stage(fmt::format("search {} of {}", k + 1, starts.size()));
    Attempt attempt{problem.coordinates().values(starts[k]), {}, ""};
    try {
      attempt.search = search(problem, fit, starts[k], options,
                              [&](const Iteration& iteration) { listener.on_iteration(k, iteration); });
    } catch (const Failed& e) {
      attempt.failure = e.what();
    }
    result.attempts.push_back(std::move(attempt));
  }
  const auto cost = [](const Attempt& attempt) {
    return attempt.search ? attempt.search->cost : std::numeric_limits<double>::infinity();
  };
  const auto best = std::ranges::min_element(result.attempts, {}, cost);
  if (!best->search) throw RunError(best->failure);
  result.best = static_cast<std::size_t>(best - result.attempts.begin());
}

}  // namespace

Result run_fit(const Problem& problem, const Fit& fit, JobOptions options, const FitListener& listener) {
  Result result;
  const auto on_job = options.on_job;
  options.on_job = [&](std::size_t count, const Job& job, const EvaluationResult& evaluated, bool cached) {
    if (!cached) ++result.runs;
    if (!cached && evaluated.cost) result.cpu_seconds += evaluated.cost->cpu_seconds;
    on_job(count, job, evaluated, cached);
  };
  search_all(problem, fit, options, listener, result);
  const Search& best = result.search();
  result.statistics = statistics_of(problem, best, fit.loss);
  if (fit.intervals == Intervals::profile)
    result.profiles = profiles_of(problem, fit, best, result.statistics, options, listener.on_stage);
  if (fit.refine) {
    listener.on_stage("refined meshes");
    try {
      result.shift = shift_by_refinement(
          problem, best, fit.loss, evaluate(problem, best.z, false, options, Experiments::measured, Meshes::refined));
    } catch (const Failed& e) {
      result.refinement_failure = e.what();
    }
  }
  if (!fit.candidates.empty()) {
    listener.on_stage("candidates");
    try {
      result.candidates = values_of_candidates(problem, best, fit.loss, result.statistics,
                                               evaluate(problem, best.z, true, options, Experiments::candidates));
    } catch (const Failed& e) {
      result.candidates_failure = e.what();
    }
  }
  return result;
}

}  // namespace orthodyn::study::fit
