#include "lib/study/fit/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_format.h"
#include "lib/core/spelling.h"
#include "lib/core/versions.h"
#include "lib/study/fit/field_result.h"
#include "lib/study/fit/mode_sentences.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::fit {

namespace {

constexpr double kStrongCorrelation = 0.95;
constexpr double kInterval95 = 1.96;  // half width over the standard deviation

std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{:.4g}{}", value, unit.empty() ? "" : " " + unit);
}

// "±0.8 %" for logarithmic parameters, "±0.4 deg" for others: half of the 95 % interval.
std::string precision(const Problem& problem, const Estimate& estimate, std::size_t p) {
  const FittedParameter& parameter = problem.parameters()[p];
  if (problem.coordinates().is_log(p)) return fmt::format("±{:.2g} %", 100 * kInterval95 * estimate.deviation_z);
  return "±" + fmt::format("{:.2g}{}", kInterval95 * estimate.deviation / parameter.factor,
                           parameter.unit.empty() ? "" : " " + parameter.unit);
}

const char* word_of(Knowledge knowledge) {
  switch (knowledge) {
    case Knowledge::determined: return "determined";
    case Knowledge::poorly_determined: return "poorly determined";
    case Knowledge::undetermined: return "undetermined";
  }
  return "";
}

// "E2 and nu23": parameters with a large weight in a direction, the largest first.
std::string combination(const Problem& problem, const Direction& direction) {
  constexpr double kPart = 0.3;
  std::vector<std::size_t> order(problem.parameters().size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto weight = [&](std::size_t i) { return std::abs(direction.weights[static_cast<Eigen::Index>(i)]); };
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return weight(a) > weight(b); });
  std::vector<std::string> names;
  for (const std::size_t i : order)
    if (weight(i) > kPart * weight(order[0])) names.push_back(problem.parameters()[i].name);
  return join(names);
}

Json vector_json(const Eigen::VectorXd& values) {
  Json out = Json::array();
  for (const double x : values) out.push_back(finite_or_null(x));
  return out;
}

// Values of the single parameters in the units of display.
Json values_json(const Problem& problem, const Vector& si) {
  Json out = Json::array();
  for (const std::size_t p : problem.single_parameters())
    out.push_back(finite_or_null(si[static_cast<Eigen::Index>(p)] / problem.parameters()[p].factor));
  return out;
}

Json end_json(const ProfileEnd& end, double factor) {
  return {{"value", end.value ? finite_or_null(*end.value / factor) : Json()},
          {"open", end.is_open},
          {"failure", end.failure}};
}

Json parameter_json(const Problem& problem, const Result& result, std::size_t p) {
  const FittedParameter& parameter = problem.parameters()[p];
  const Estimate& estimate = result.statistics.estimates[p];
  const auto shown = [&](double si) { return finite_or_null(si / parameter.factor); };
  Json out{{"name", parameter.name},
           {"paths", parameter.paths},
           {"unit", parameter.unit},
           {"value", shown(estimate.value)},
           {"deviation", shown(estimate.deviation)},
           {"low", shown(estimate.low)},
           {"high", shown(estimate.high)},
           {"start", shown(parameter.start)},
           {"relative", problem.coordinates().is_log(p)},
           {"knowledge", word_of(estimate.knowledge)},
           {"precision", std::isfinite(estimate.deviation) ? precision(problem, estimate, p) : "unknown"},
           {"at_bound", estimate.at_bound}};
  out["prior"] =
      parameter.prior ? Json{{"value", shown(*parameter.prior)}, {"deviation", shown(*parameter.deviation)}} : Json();
  const auto profile = std::ranges::find(result.profiles, p, &ProfileInterval::parameter);
  const bool has_profile = profile != result.profiles.end();
  out["profile"] = has_profile ? Json{{"low", end_json(profile->low, parameter.factor)},
                                      {"high", end_json(profile->high, parameter.factor)}}
                               : Json();
  out["shift"] = result.shift ? shown((*result.shift)[static_cast<Eigen::Index>(p)]) : Json();
  return out;
}

Json data_json(const Problem& problem, const Search& search) {
  Json out = Json::array();
  std::size_t i = 0;
  for (const PreparedExperiment& experiment : problem.experiments()) {
    if (experiment.is_candidate) continue;
    for (const Datum& datum : experiment.data) {
      const double computed = search.at.computed[i];
      const auto &match = search.at.matches[i], &first = search.matches_at_start[i];
      const auto by_number = optional_json(datum.metric.mode);
      out.push_back(
          {{"experiment", experiment.name},
           {"entry", datum.entry},
           {"title", datum.title},
           {"quantity", datum.metric.quantity},
           {"unit", datum.unit},
           {"over", optional_json(datum.over)},
           {"measured", datum.value / datum.factor},
           {"deviation", datum.deviation / datum.factor},
           {"computed", finite_or_null(computed / datum.factor)},
           {"computed_at_start", finite_or_null(search.computed_at_start[static_cast<Eigen::Index>(i)] / datum.factor)},
           {"residual", finite_or_null((computed - datum.value) / datum.deviation)},
           {"mode", match ? Json(match->mode) : by_number},
           {"mode_at_start", first ? Json(first->mode) : by_number},
           {"mac", match ? finite_or_null(match->mac) : Json()}});
      ++i;
    }
  }
  return out;
}

Json attempt_json(const Problem& problem, const Attempt& attempt) {
  Json out{{"start", values_json(problem, attempt.start)}, {"failure", attempt.failure}};
  if (!attempt.search) return out;
  const Search& search = *attempt.search;
  out["end"] = values_json(problem, problem.coordinates().values(search.z));
  out["chi_square"] = finite_or_null(2 * search.cost);
  out["converged"] = search.converged;
  out["message"] = search.message;
  out["evaluations"] = search.evaluations;
  out["failed_evaluations"] = search.failed_evaluations;
  out["iterations"] = Json::array();
  for (const Iteration& one : search.iterations)
    out["iterations"].push_back({{"number", one.number},
                                 {"chi_square", finite_or_null(one.chi_square)},
                                 {"accepted", one.accepted},
                                 {"values", values_json(problem, one.values)}});
  return out;
}

Json noise_json(const NoiseTest& noise) {
  return {{"chi_square", finite_or_null(noise.chi_square)},
          {"freedom", noise.freedom},
          {"probability", optional_json(noise.probability)},
          {"runs_probability", optional_json(noise.runs_probability)},
          {"factor", noise.factor},
          {"bic", finite_or_null(noise.information_criterion)}};
}

Json candidates_json(const Problem& problem, const Result& result) {
  Json out = Json::array();
  for (const CandidateValue& candidate : result.candidates) {
    Json deviations = Json::array();
    for (const std::size_t p : problem.single_parameters())
      deviations.push_back(finite_or_null(candidate.deviations[p] / problem.parameters()[p].factor));
    out.push_back({{"name", candidate.name},
                   {"deviations", deviations},
                   {"determinant_gain", finite_or_null(candidate.determinant_gain)},
                   {"trace_gain", finite_or_null(candidate.trace_gain)}});
  }
  return out;
}

}  // namespace

std::vector<std::string> findings(const Problem& problem, const Result& result) {
  const Statistics& statistics = result.statistics;
  std::vector<std::string> determined, poor, nothing, out;
  for (const std::size_t p : problem.single_parameters()) {
    const Estimate& estimate = statistics.estimates[p];
    const std::string& name = problem.parameters()[p].name;
    switch (estimate.knowledge) {
      case Knowledge::determined: determined.push_back(name + " " + precision(problem, estimate, p)); break;
      case Knowledge::poorly_determined: poor.push_back(name + " " + precision(problem, estimate, p)); break;
      case Knowledge::undetermined: nothing.push_back(name); break;
    }
  }
  if (!determined.empty()) out.push_back(fmt::format("These data determine {} (95 % intervals).", join(determined)));
  if (!poor.empty()) out.push_back(fmt::format("They determine {} poorly.", join(poor)));
  if (!nothing.empty())
    out.push_back(fmt::format("They say nothing about {}: fix {}, give a prior, or measure more.", join(nothing),
                              nothing.size() == 1 ? "it" : "them"));
  for (const ParameterField& field : problem.fields()) out.push_back(field_sentence(result, field));
  const Direction& worst = statistics.directions.front();
  if (worst.deviation > 0.1 && problem.fields().empty() && statistics.estimates.size() > 1)
    out.push_back(fmt::format("The least determined combination is one of {}{}.", combination(problem, worst),
                              std::isfinite(worst.deviation)
                                  ? fmt::format(", known to a factor {:.3g}", std::exp(kInterval95 * worst.deviation))
                                  : ", of which the data say nothing"));
  const std::vector<std::size_t> singles = problem.single_parameters();
  for (const std::size_t i : singles)
    for (const std::size_t j : singles) {
      if (j >= i) break;
      const double correlation = statistics.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (std::abs(correlation) > kStrongCorrelation)
        out.push_back(fmt::format("{} and {} can hardly be told apart: their correlation is {:.3f}.",
                                  problem.parameters()[j].name, problem.parameters()[i].name, correlation));
    }
  const auto best = std::ranges::max_element(result.candidates, {}, &CandidateValue::determinant_gain);
  if (best != result.candidates.end())
    out.push_back(
        fmt::format("Of the candidates, '{}' would tell most: the volume of the confidence region shrinks by a "
                    "factor {:.3g}.",
                    best->name, best->determinant_gain));
  for (std::string& sentence : matched_modes(problem, result.search())) out.push_back(std::move(sentence));
  return out;
}

std::vector<std::string> warnings(const Problem& problem, const Result& result) {
  std::vector<std::string> out = doubtful_modes(problem, result.search().at);
  const Search& search = result.search();
  const NoiseTest& noise = result.statistics.noise;
  if (!search.converged)
    out.push_back(
        fmt::format("the search did not converge ({}): give other start values, or more iterations", search.message));
  if (noise.factor > 1)
    out.push_back(fmt::format(
        "the residuals are {:.2g} times as large as the stated deviations: the model or the deviations are "
        "wrong{}{}. The intervals are enlarged by this factor",
        noise.factor, result.attempts.size() == 1 ? ", or a better result is far from the start (try starts: 10)" : "",
        has_modes_by_order(problem)
            ? ", or computed modes, which are matched by their order, belong to other measured ones (give 'shapes')"
            : ""));
  // Residuals far below the deviations do not matter, also if they are no noise.
  constexpr double kNegligible = 0.1;
  const bool matters = noise.chi_square > kNegligible * static_cast<double>(noise.freedom);
  if (matters && noise.runs_probability && *noise.runs_probability < 0.01)
    out.push_back(
        "neighbouring residuals have the same sign more often than noise has: the scene lacks something that the "
        "measurement has, and the intervals are too small");
  if (noise.freedom <= 0 && noise.chi_square > 1)
    out.push_back(fmt::format(
        "the measured values are not reached (chi-square {:.3g}), although there are as many parameters: the model or "
        "the values are wrong, or a better result is far from the start (try starts: 10). The intervals have no "
        "meaning",
        noise.chi_square));
  for (const ProfileInterval& profile : result.profiles)
    if (profile.least_chi_square < 0.99 * 2 * search.cost - 0.01)
      out.push_back(
          fmt::format("the profile of {} found a smaller chi-square ({:.4g}): the search ended in a false "
                      "minimum, so give another start or starts: 10",
                      problem.parameters()[profile.parameter].name, profile.least_chi_square));
  if (noise.freedom == 0 && !problem.fields().empty())
    out.push_back("the data are as few as the factors that they determine, so the fit cannot be tested");
  else if (noise.freedom == 0)
    out.push_back("there are as many parameters as measured values, so the fit cannot be tested: measure more");
  for (const ParameterField& field : problem.fields())
    for (std::string& warning : field_warnings(result, field)) out.push_back(std::move(warning));
  for (const std::size_t p : problem.single_parameters()) {
    const FittedParameter& parameter = problem.parameters()[p];
    const Estimate& estimate = result.statistics.estimates[p];
    if (estimate.at_bound)
      out.push_back(fmt::format("{} is at its bound, so its interval has no meaning", parameter.name));
    if (!result.shift || !std::isfinite(estimate.deviation)) continue;
    const double shift = (*result.shift)[static_cast<Eigen::Index>(p)];
    if (std::abs(shift) > kInterval95 * estimate.deviation)
      out.push_back(fmt::format(
          "refining the meshes once, and the time steps of motions, moves {} by {}, more than its 95 % interval ({}): "
          "use finer meshes or a smaller rtol in the scenes",
          parameter.name, with_unit(shift / parameter.factor, parameter.unit), precision(problem, estimate, p)));
  }
  if (!result.refinement_failure.empty())
    out.push_back("the effect of the meshes is unknown: " + result.refinement_failure);
  if (!result.candidates_failure.empty())
    out.push_back("the candidates were not computed: " + result.candidates_failure);
  return out;
}

Json fit_json(const Fit& fit, const Problem& problem, const Result& result, const std::string& file) {
  Json out{{"orthodyn_fit", 1},  {"name", fit.name},
           {"title", fit.title}, {"description", fit.description},
           {"file", file},       {"version", orthodyn_version()}};
  out["parameters"] = Json::array();
  const auto indices = problem.single_parameters();
  for (const std::size_t p : indices) out["parameters"].push_back(parameter_json(problem, result, p));
  out["fields"] = Json::array();
  for (const ParameterField& field : problem.fields()) out["fields"].push_back(field_json(problem, result, field));
  const std::vector<Eigen::Index> singles(indices.begin(), indices.end());
  const Eigen::MatrixXd correlation = result.statistics.correlation(singles, singles);
  out["correlation"] = Json::array();
  for (const auto& row : correlation.rowwise()) out["correlation"].push_back(vector_json(row));
  out["directions"] = Json::array();
  const bool has_directions = problem.fields().empty();  // a field has too many directions for a table
  if (has_directions)
    for (const Direction& direction : result.statistics.directions)
      out["directions"].push_back(
          {{"deviation", finite_or_null(direction.deviation)}, {"weights", vector_json(direction.weights)}});
  out["data"] = data_json(problem, result.search());
  out["noise"] = noise_json(result.statistics.noise);
  out["attempts"] = Json::array();
  for (const Attempt& attempt : result.attempts) out["attempts"].push_back(attempt_json(problem, attempt));
  out["best"] = result.best;
  out["candidates"] = candidates_json(problem, result);
  out["findings"] = findings(problem, result);
  out["warnings"] = warnings(problem, result);
  out["materials"] = Json::array();
  for (const FittedMaterial& material : fitted_materials(fit, problem, result))
    out["materials"].push_back({{"name", material.name}, {"yaml", material.yaml}});
  out["runs"] = result.runs;
  out["cpu_seconds"] = result.cpu_seconds;
  return out;
}

}  // namespace orthodyn::study::fit
