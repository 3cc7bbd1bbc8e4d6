#include "lib/study/converge/convergence_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lib/simulation/run/machine.h"
#include "lib/study/converge/richardson.h"
#include "lib/study/inputs/labels.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::converge {

namespace {

constexpr double kTarget = 0.01;  // relative error whose cost is reported
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <class T>
std::optional<T> entry(const Named<T>& list, const std::string& name) {
  for (const auto& [key, value] : list)
    if (key == name) return value;
  return std::nullopt;
}

class Table {
 public:
  Table(const Convergence& wanted, const Design& design, const std::vector<Job>& jobs, const Results& results)
      : wanted_(wanted), design_(design), jobs_(jobs), results_(results) {}

  Json json() const {
    Json metrics = Json::array(), rows = Json::array();
    for (const auto& [name, metric] : design_.metrics) metrics.push_back(metric_json(name, metric));
    for (std::size_t i = 0; i < design_.levels.size(); ++i) rows.push_back(row_json(i));
    return {{"orthodyn_convergence", 1},
            {"name", stem(wanted_.file)},
            {"file", wanted_.file},
            {"set", wanted_.set},
            {"written", utc_now()},
            {"machine", machine_json()},
            {"ranks", wanted_.ranks},
            {"versions", versions_json()},
            {"ratio", kRatio},
            {"target", kTarget},
            {"orders", wanted_.orders},
            {"metrics", metrics},
            {"rows", rows}};
  }

 private:
  struct Limit {
    Extrapolation value;
    int order;  // of the elements used
  };

  const EvaluationResult* result(std::size_t level) const {
    const auto found = results_.find(jobs_[level].folder);
    return found == results_.end() ? nullptr : &found->second;
  }

  double value(std::size_t level, const std::string& metric) const {
    const EvaluationResult* r = result(level);
    return r ? entry(r->metrics, metric).value_or(kNaN) : kNaN;
  }

  // Values of one element order, from coarse to fine, up to the first missing one.
  std::vector<double> values(int order, const std::string& metric) const {
    std::vector<double> out;
    for (std::size_t i = 0; i < design_.levels.size(); ++i) {
      if (design_.levels[i].order != order) continue;
      const double v = value(i, metric);
      if (!std::isfinite(v)) break;
      out.push_back(v);
    }
    return out;
  }

  static std::optional<Extrapolation> extrapolated(const std::vector<double>& values, int order) {
    return extrapolate(values, kRatio, 2 * order);
  }

  // The limit for the highest element order that has one, because that order is the most accurate on equal cells. A
  // lower order has none if the finest value of the highest order contradicts it.
  std::optional<Limit> limit(const std::string& metric) const {
    std::optional<Limit> found;
    const std::vector<double> best = values(wanted_.orders.back(), metric);
    for (const int order : wanted_.orders) {
      const auto value = extrapolated(values(order, metric), order);
      if (!value) continue;
      const bool agrees = best.empty() || std::abs(best.back() - value->limit) <= value->uncertainty;
      if (order == wanted_.orders.back() || agrees) found = Limit{*value, order};
    }
    return found;
  }

  // Relative to the limit; of oscillating values at least their range.
  double error(std::size_t level, const std::string& metric) const {
    const auto found = limit(metric);
    if (!found || found->value.limit == 0) return kNaN;
    const double distance = std::abs(value(level, metric) - found->value.limit);
    const double least = found->value.order ? 0 : found->value.uncertainty;
    return std::max(distance, least) / std::abs(found->value.limit);
  }

  double cpu_seconds(std::size_t level, const WantedMetric& metric) const {
    const EvaluationResult* r = result(level);
    const auto cost = metric.is_of_motion() ? &EvaluationResult::cost : &EvaluationResult::modes_cost;
    return r && r->*cost ? (r->*cost)->cpu_seconds : kNaN;
  }

  // A natural frequency has its own error estimate, and a buckling load has none (NaN). Other metrics use the relative
  // error of the elastic energy.
  double mesh_error(std::size_t level, const WantedMetric& metric, const std::string& name) const {
    const EvaluationResult* r = result(level);
    if (!r) return kNaN;
    return metric.is_of_motion() ? r->mesh_error.value_or(kNaN) : entry(r->metric_errors, name).value_or(kNaN);
  }

  // CPU time (s) for which the error of one element order is kTarget, by log-log interpolation between the enclosing
  // meshes. If the coarsest mesh already reaches the target, its time is an upper bound (`at_most`). The time is null
  // if no mesh reaches the target.
  Json cost_of_target(int order, const std::string& name, const WantedMetric& metric) const {
    std::optional<std::size_t> before;
    for (std::size_t i = 0; i < design_.levels.size(); ++i) {
      if (design_.levels[i].order != order) continue;
      const double e = error(i, name), t = cpu_seconds(i, metric);
      if (!(e >= 0) || !(t > 0)) break;
      if (e <= kTarget) {
        if (!before) return {{"order", order}, {"cpu_seconds", t}, {"at_most", true}};
        const double e0 = error(*before, name), t0 = cpu_seconds(*before, metric);
        const double share = std::log(e0 / kTarget) / std::log(e0 / std::max(e, 1e-300));
        return {{"order", order}, {"cpu_seconds", t0 * std::pow(t / t0, share)}, {"at_most", false}};
      }
      before = i;
    }
    return {{"order", order}, {"cpu_seconds", nullptr}, {"at_most", false}};
  }

  std::string unit(const std::string& metric) const {
    for (std::size_t i = 0; i < design_.levels.size(); ++i)
      if (const EvaluationResult* r = result(i))
        if (const auto found = entry(r->units, metric)) return *found;
    return "";
  }

  Json metric_json(const std::string& name, const WantedMetric& metric) const {
    Json out{{"name", name}, {"unit", unit(name)}, {"limit", nullptr}};
    if (const auto found = limit(name)) {
      out["limit"] = found->value.limit;
      out["uncertainty"] = found->value.uncertainty;
      out["from_order"] = found->order;
    } else {
      out["why_no_limit"] = why_no_limit(name);
    }
    Json costs = Json::array();
    for (const int order : wanted_.orders) costs.push_back(cost_of_target(order, name, metric));
    out["cost_of_target"] = costs;
    out["answer"] = answer(out, finest(name), kTarget);
    return out;
  }

  std::string why_no_limit(const std::string& metric) const {
    const std::vector<double> last = values(wanted_.orders.back(), metric);
    if (last.size() < 3 && wanted_.levels < 3) return "a limit needs three levels (--levels 3)";
    if (last.size() < 3) return fmt::format("only {} of its meshes completed", last.size());
    const auto* at = last.data() + last.size() - 3;
    return fmt::format(
        "{:.4g}, {:.4g}, {:.4g} on the last three meshes do not converge: refine further, or check whether the metric "
        "has a limit at all (the stress at a corner has none)",
        at[0], at[1], at[2]);
  }

  // The finest mesh of the highest element order that has a value.
  std::optional<FinestMesh> finest(const std::string& name) const {
    for (std::size_t i = design_.levels.size(); i-- > 0;)
      if (const double v = value(i, name); std::isfinite(v))
        return FinestMesh{v, mesh_error(i, *entry(design_.metrics, name), name), design_.levels[i].order};
    return std::nullopt;
  }

  // Observed on the values of this level and the two before it; null if there is no such order.
  Json observed_order(std::size_t level, const std::string& metric) const {
    if (design_.levels[level].level < 2) return nullptr;
    const auto found = extrapolate({value(level - 2, metric), value(level - 1, metric), value(level, metric)}, kRatio,
                                   2 * design_.levels[level].order);
    return found && found->order ? finite_or_null(*found->order) : Json();
  }

  Json row_json(std::size_t i) const {
    const Level& level = design_.levels[i];
    const EvaluationResult* r = result(i);
    Json out{{"order", level.order},
             {"level", level.level + 1},
             {"title", level.scene.title},
             {"folder", fmt::format("points/{}", jobs_[i].folder.filename().string())},
             {"status", !r           ? "missing"
                        : r->failure ? "failed"
                                     : "completed"},
             {"reason", r && r->failure ? r->failure->reason : ""},
             {"message", r && r->failure ? r->failure->message : ""}};
    out["unknowns"] = r && r->model ? Json(r->model->unknowns) : Json();
    out["elements"] = r && r->model ? Json(r->model->elements) : Json();
    Json metrics = Json::object();
    for (const auto& [name, metric] : design_.metrics)
      metrics[name] = {{"value", finite_or_null(value(i, name))},
                       {"error", finite_or_null(error(i, name))},
                       {"order", observed_order(i, name)},
                       {"mesh_error", finite_or_null(mesh_error(i, metric, name))},
                       {"cpu_seconds", finite_or_null(cpu_seconds(i, metric))}};
    out["metrics"] = metrics;
    return out;
  }

  const Convergence& wanted_;
  const Design& design_;
  const std::vector<Job>& jobs_;
  const Results& results_;
};

}  // namespace

Json convergence_json(const Convergence& wanted, const Design& design, const std::vector<Job>& jobs,
                      const Results& results) {
  return Table(wanted, design, jobs, results).json();
}

}  // namespace orthodyn::study::converge
