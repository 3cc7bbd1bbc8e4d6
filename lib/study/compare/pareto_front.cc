// The Pareto fronts of a comparison across meshes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "lib/study/compare/comparison_table.h"
#include "lib/study/compare/reference_error.h"
#include "lib/study/compare/work_precision.h"

namespace orthodyn::study::compare {

namespace {

struct CostPoint {
  std::size_t index = 0;
  double seconds = 0, error = 0;
};

// The points that no other point beats in both error and time, from fast to accurate. Errors below `floor` count as
// equal, so of such points only the fastest stays.
std::vector<CostPoint> pareto_front(std::vector<CostPoint> points, double floor) {
  std::sort(points.begin(), points.end(), [](const CostPoint& a, const CostPoint& b) {
    return std::tie(a.seconds, a.error) < std::tie(b.seconds, b.error);
  });
  std::vector<CostPoint> out;
  double best = std::numeric_limits<double>::infinity();
  for (const auto& point : points) {
    const double error = std::max(point.error, floor);
    if (!(error < best)) continue;
    best = error;
    out.push_back(point);
  }
  return out;
}

// The fastest point with an error of at most `target`; empty if there is none.
std::optional<CostPoint> fastest(const std::vector<CostPoint>& points, double target) {
  std::optional<CostPoint> best;
  for (const auto& point : points)
    if (point.error <= kTargetTolerance * target && (!best || point.seconds < best->seconds)) best = point;
  return best;
}

// The Pareto front of one group of the document.
class GroupParetoFront {
 public:
  GroupParetoFront(const Json& document, const std::string& group, double floor) : document_(document), floor_(floor) {
    for (const auto& problem : document.at("problems"))
      if (problem.at("group") == group) members_.push_back(problem.at("id")), problems_[problem.at("id")] = &problem;
    for (std::size_t k = 0; k < document.at("points").size(); ++k) add(k);
  }

  const Json& members() const { return members_; }

  Json points() const {
    Json out = Json::array();
    if (!std::isnan(floor_))
      for (const auto& point : pareto_front(points_, floor_)) out.push_back(point.index);
    return out;
  }

  Json answers() const {
    Json out = Json::array();
    if (std::isnan(floor_)) return out;
    std::vector<WorkPoint> errors;
    for (const auto& point : points_) errors.push_back({0, point.error, point.seconds});
    for (const double target : targets(errors, floor_)) out.push_back(answer(target));
    return out;
  }

 private:
  void add(std::size_t index) {
    const Json& point = document_.at("points")[index];
    const auto problem = problems_.find(point.at("problem"));
    if (problem == problems_.end() || point.at("status") != "completed" || !point.at("errors").is_object()) return;
    const Json& error = point.at("errors").at("displacement").at("l2");
    if (!error.is_number()) return;
    const CostPoint one{index, point.at("cpu").at("median"), error};
    points_.push_back(one);
    by_order_[problem->second->at("order")].push_back(one);
  }

  Json answer(double target) const {
    const CostPoint best = *fastest(points_, target);
    const int order = order_of(best);
    std::string words = fmt::format("at {:g} %: {}", 100 * target, words_of_point(best));
    for (const auto& [other, points] : by_order_)
      if (other != order) words += "; " + words_of_order(other, points, target);
    return {{"target", target}, {"point", best.index}, {"seconds", best.seconds}, {"words", words}};
  }

  int order_of(const CostPoint& point) const { return problem_of(point).at("order"); }
  const Json& problem_of(const CostPoint& point) const {
    return *problems_.at(document_.at("points")[point.index].at("problem"));
  }

  // "order 2, cells [20, 2, 2], cvode_bdf, rtol 0.001, 0.16 s"
  std::string words_of_point(const CostPoint& cost) const {
    const Json& point = document_.at("points")[cost.index];
    const auto& methods = document_.at("methods");
    const auto method =
        std::find_if(methods.begin(), methods.end(), [&](const Json& m) { return m.at("id") == point.at("method"); });
    const Json& control = point.at("control");
    return fmt::format("{}, {}, {} {:g}, {:.2g} s", problem_of(cost).at("mesh").get<std::string>(),
                       method->at("label").get<std::string>(), control.at("kind").get<std::string>(),
                       control.at("value").get<double>(), cost.seconds);
  }

  std::string words_of_order(int order, const std::vector<CostPoint>& points, double target) const {
    const std::string name = order == 1 ? "linear elements" : "quadratic elements";
    if (const auto best = fastest(points, target))
      return fmt::format("{} need {:.2g} s ({})", name, best->seconds, problem_of(*best).at("mesh").get<std::string>());
    const auto nearest =
        std::min_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
    return fmt::format("{} do not reach this error (best {:.2g} % in {:.2g} s)", name, 100 * nearest->error,
                       nearest->seconds);
  }

  const Json& document_;
  double floor_;
  Json members_ = Json::array();
  std::map<std::string, const Json*> problems_;
  std::vector<CostPoint> points_;
  std::map<int, std::vector<CostPoint>> by_order_;
};

}  // namespace

Json pareto_fronts_json(const ComparisonRun& run, const Json& document) {
  Json out = Json::array();
  const Design& design = run.design();
  if (!design.across_meshes) return out;
  for (std::size_t g = 0; g < design.groups.size(); ++g) {
    const auto found = run.references().find(g);
    const Reference* reference = found == run.references().end() ? nullptr : &found->second;
    const auto errors = time_errors_of(reference);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    const double floor = ReferenceFloor(reference, true).at(errors ? errors->displacement.l2 : unknown);
    const GroupParetoFront front(document, design.groups[g].id, floor);
    out.push_back({{"id", design.groups[g].id},
                   {"label", design.groups[g].label},
                   {"problems", front.members()},
                   {"error", kLeadingError},
                   {"clock", "cpu"},
                   {"reach", std::isfinite(floor) ? Json(floor) : Json()},
                   {"points", front.points()},
                   {"answers", front.answers()}});
  }
  return out;
}

}  // namespace orthodyn::study::compare
