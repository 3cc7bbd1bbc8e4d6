#include "lib/study/converge/convergence_table.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "lib/simulation/run/machine.h"
#include "lib/study/converge/convergence_answer.h"
#include "lib/study/converge/richardson.h"
#include "lib/study/inputs/labels.h"
#include "lib/study/jobs/json_values.h"

namespace orthodyn::study::converge {

namespace {

constexpr double kTarget = 0.01;  // the error whose cost is told
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
    int order;  // of the elements that it is from
  };

  const EvaluationResult* result(std::size_t level) const {
    const auto found = results_.find(jobs_[level].folder);
    return found == results_.end() ? nullptr : &found->second;
  }

  double value(std::size_t level, const std::string& metric) const {
    const EvaluationResult* r = result(level);
    return r ? entry(r->metrics, metric).value_or(kNaN) : kNaN;
  }

  // Of one order, up to the first that is missing.
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

  // By the elements of the highest order, which are nearest to it on equal cells; the orders ascend.
  std::optional<Limit> limit(const std::string& metric) const {
    std::optional<Limit> found;
    for (const int order : wanted_.orders)
      if (const auto value = extrapolated(values(order, metric), order)) found = Limit{*value, order};
    return found;
  }

  double error(std::size_t level, const std::string& metric) const {
    const auto found = limit(metric);
    return found && found->value.limit != 0 ? std::abs(value(level, metric) / found->value.limit - 1) : kNaN;
  }

  double cpu_seconds(std::size_t level, const WantedMetric& metric) const {
    const EvaluationResult* r = result(level);
    const auto cost = metric.is_of_motion() ? &EvaluationResult::cost : &EvaluationResult::modes_cost;
    return r && r->*cost ? (r->*cost)->cpu_seconds : kNaN;
  }

  // Of a frequency or a buckling load its own, of others the share of the elastic energy.
  double mesh_error(std::size_t level, const WantedMetric& metric, const std::string& name) const {
    const EvaluationResult* r = result(level);
    if (!r) return kNaN;
    return metric.is_of_motion() ? r->mesh_error.value_or(kNaN) : entry(r->metric_errors, name).value_or(kNaN);
  }

  // CPU time at which the error of elements of an order falls to the target, s, between the points that enclose it; at
  // most that of the coarsest mesh where it is below already; null if there is none.
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
    if (last.size() < 3 && wanted_.levels < 3) return "it takes three levels to see one (--levels 3)";
    if (last.size() < 3) return fmt::format("only {} of its meshes came to an end", last.size());
    const auto* at = last.data() + last.size() - 3;
    return fmt::format(
        "{:.4g}, {:.4g}, {:.4g} on the last three meshes do not approach one: refine further, or look "
        "for what has none, such as the stress at a corner",
        at[0], at[1], at[2]);
  }

  // Of the highest order: the value of its finest mesh, and the estimate of that mesh's error.
  std::optional<FinestMesh> finest(const std::string& name) const {
    for (std::size_t i = design_.levels.size(); i-- > 0;)
      if (const double v = value(i, name); std::isfinite(v))
        return FinestMesh{v, mesh_error(i, *entry(design_.metrics, name), name), design_.levels[i].order};
    return std::nullopt;
  }

  // On the level's own value and the two before it.
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
    out["unknowns"] = r && r->unknowns ? Json(*r->unknowns) : Json();
    out["elements"] = r && r->elements ? Json(*r->elements) : Json();
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
