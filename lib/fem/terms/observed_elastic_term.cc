#include "lib/fem/terms/observed_elastic_term.h"

#include <fmt/format.h>

#include <algorithm>

namespace orthodyn {

std::string ObservedElasticTerm::description() const {
  if (!is_replaced()) return elastic_->description();
  return fmt::format("{}: {}, {} elements", name(), law(), std::max(size(), definition().elements));
}

// The terms whose stress is added to that of own().
std::vector<const AddedTerm*> ObservedElasticTerm::observed() const {
  std::vector<const AddedTerm*> all = added_;
  if (replacing_) all.push_back(replacing_.get());
  return all;
}

// Without the stress of a replaced law.
PointObservation ObservedElasticTerm::own(PointObservation observation) const {
  if (is_replaced()) observation.cauchy.setZero();
  return observation;
}

PointObservation ObservedElasticTerm::observe(int k, const NodalState& s) const {
  PointObservation out = elastic_->observe(k, s);
  const AddedTerm& any = *observed().front();
  const std::vector<PointObservation> points = observe_element(k, s);
  double volume = 0;
  out.cauchy.setZero();
  for (int p = 0; p < num_points(); ++p) {
    out.cauchy += any.volume(k, p) * points[static_cast<std::size_t>(p)].cauchy;
    volume += any.volume(k, p);
  }
  out.cauchy /= volume;
  return out;
}

PointObservation ObservedElasticTerm::observe_point(int k, int p, const NodalState& s) const {
  PointObservation out = own(elastic_->observe_point(k, p, s));
  for (const AddedTerm* term : observed())
    term->visit_stresses_of(k, s, [&](int, int point, const Mat3& cauchy, const Mat3&) {
      if (point == p) out.cauchy += cauchy;
    });
  return out;
}

std::vector<PointObservation> ObservedElasticTerm::observe_element(int k, const NodalState& s) const {
  std::vector<PointObservation> all = elastic_->observe_element(k, s);
  for (PointObservation& observation : all) observation = own(observation);
  for (const AddedTerm* term : observed())
    term->visit_stresses_of(
        k, s, [&](int, int p, const Mat3& cauchy, const Mat3&) { all[static_cast<std::size_t>(p)].cauchy += cauchy; });
  return all;
}

void ObservedElasticTerm::observe_points(const NodalState& s, const VisitPoint& visit) const {
  std::vector<Mat3> added(static_cast<std::size_t>(size() * num_points()), Mat3::Zero());
  const auto at = [&](int k, int p) -> Mat3& { return added[static_cast<std::size_t>(k * num_points() + p)]; };
  for (const AddedTerm* term : observed())
    term->visit_stresses(s, [&](int k, int p, const Mat3& cauchy, const Mat3&) { at(k, p) += cauchy; });
  elastic_->observe_points(s, [&](int k, int p, const PointObservation& elastic) {
    PointObservation observation = own(elastic);
    observation.cauchy += at(k, p);
    visit(k, p, observation);
  });
}

Eigen::Matrix<double, 6, Eigen::Dynamic> ObservedElasticTerm::stresses(const NodalState& s) const {
  Eigen::Matrix<double, 6, Eigen::Dynamic> out = elastic_->stresses(s);
  if (is_replaced()) out.setZero();
  for (const AddedTerm* term : observed())
    term->visit_stresses(s, [&](int k, int p, const Mat3&, const Mat3& t) {
      out.col(k * num_points() + p) += Vec6(t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0));
    });
  return out;
}

}  // namespace orthodyn
