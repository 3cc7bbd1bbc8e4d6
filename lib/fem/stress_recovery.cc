#include "lib/fem/stress_recovery.h"

#include <algorithm>

#include "lib/material/stiffness.h"

namespace orthodyn {

namespace {

constexpr double kSmallStep = 1e-6;  // largest displacement of the difference, relative to the body's smallest extent

SixColumns at_points(const ElasticTerm& term, const NodalState& s, const StressRecovery::Pick& pick) {
  SixColumns out(term.size() * term.num_points(), 6);
  term.observe_points(s, [&](int k, int p, const PointObservation& observation) {
    out.row(k * term.num_points() + p) = pick(observation).transpose();
  });
  return out;
}

// Stresses at all points in space axes at rest, Pa.
SixColumns stresses(const ElasticTerm& term, const NodalState& s) {
  const auto stresses = term.stresses(s);
  SixColumns out(stresses.cols(), 6);
  for (Eigen::Index i = 0; i < stresses.cols(); ++i) {
    const auto k = static_cast<int>(i / term.num_points()), p = static_cast<int>(i % term.num_points());
    out.row(i) = (stress_rotation(term.axes_at_rest(k, p)) * stresses.col(i)).transpose();
  }
  return out;
}

}  // namespace

const std::vector<StressRecovery::Region>& StressRecovery::regions() const {
  std::call_once(once_, [&] {
    const ElementMesh mesh(mesh_);
    for (const auto& term : terms_) regions_.push_back(make_region(mesh, *term));
  });
  return regions_;
}

StressRecovery::Region StressRecovery::make_region(const ElementMesh& mesh, const ElasticTerm& term) const {
  std::vector<int> own, places;
  for (int k = 0; k < term.size(); ++k) own.push_back(term.cell(k)), places.push_back(k);
  if (!subdomain_) return {RegionRecovery(mesh, own, term.type()), places};
  const std::vector<int>& all = term.definition().cells_of_all;
  for (std::size_t k = 0; k < own.size(); ++k)
    places[k] = static_cast<int>(std::lower_bound(all.begin(), all.end(), own[k]) - all.begin());
  return {RegionRecovery(mesh, all, term.type()), places};
}

SixColumns StressRecovery::of_all_ranks(std::size_t region, SixColumns at_points) const {
  if (!subdomain_) return at_points;
  const auto& [recovery, places] = regions()[region];
  const Eigen::Index points = terms_[region]->num_points();
  SixColumns all = SixColumns::Zero(points * static_cast<Eigen::Index>(recovery.cells().size()), 6);
  for (std::size_t k = 0; k < places.size(); ++k)
    all.middleRows(points * places[k], points) = at_points.middleRows(points * static_cast<Eigen::Index>(k), points);
  subdomain_->ranks().sum({all.data(), static_cast<std::size_t>(all.size())});
  return all;
}

StressRecovery::NodalValues StressRecovery::at_nodes_of_region(std::size_t region, const NodalState& s,
                                                               const Pick& pick) const {
  const ElasticTerm& term = *terms_[region];
  const RegionRecovery& recovery = regions()[region].recovery;
  return {&recovery.nodes(), &recovery.inside(), recovery.at_nodes(of_all_ranks(region, at_points(term, s, pick)))};
}

std::optional<StressRecovery::NodalValue> StressRecovery::at_node_of_region(std::size_t region, int node,
                                                                            const NodalState& s,
                                                                            const Pick& pick) const {
  const ElasticTerm& term = *terms_[region];
  const RegionRecovery& recovery = regions()[region].recovery;
  const auto found = std::find(recovery.nodes().begin(), recovery.nodes().end(), node);
  if (found == recovery.nodes().end()) return std::nullopt;
  const auto row = static_cast<int>(found - recovery.nodes().begin());
  int observed = -1;
  std::vector<PointObservation> points;  // of element `observed`
  const Vec6 value = recovery.at_node(row, [&](int k, int p) {
    if (k != observed) points = term.observe_element(k, s);
    observed = k;
    return pick(points[static_cast<std::size_t>(p)]);
  });
  return NodalValue{value, recovery.inside()[static_cast<std::size_t>(row)] != 0};
}

std::vector<RegionMeshError> StressRecovery::mesh_errors(const NodalState& s) const {
  const ElementMesh mesh(mesh_);
  std::vector<RegionMeshError> all;
  for (std::size_t r = 0; r < terms_.size(); ++r) {
    const SixColumns stress = of_all_ranks(r, stresses(*terms_[r], s));
    all.push_back(mesh_error(mesh, *terms_[r], regions()[r].recovery, regions()[r].places, stress));
  }
  return all;
}

StressMisfit StressRecovery::misfit_of(const std::vector<SixColumns>& at_points) const {
  StressMisfit all;
  for (std::size_t r = 0; r < terms_.size(); ++r)
    all.push_back(misfit_of_region(terms_[r]->type(), regions()[r].recovery, at_points[r]));
  return all;
}

StressMisfit StressRecovery::misfit(const NodalState& s) const {
  std::vector<SixColumns> computed;
  for (std::size_t r = 0; r < terms_.size(); ++r) computed.push_back(of_all_ranks(r, stresses(*terms_[r], s)));
  return misfit_of(computed);
}

// Computed by a central difference over a displacement that is small compared with the body.
StressMisfit StressRecovery::misfit_along(const NodalVector& direction, const NodalState& s) const {
  const double extent = bounding_box(mesh_).size().minCoeff();
  const double in_part = direction.size() > 0 ? direction.lpNorm<Eigen::Infinity>() : 0;
  const double largest = subdomain_ ? subdomain_->ranks().max(in_part) : in_part;
  const double step = kSmallStep * extent / (largest > 0 ? largest : 1);
  const NodalVector more_x = s.x + step * direction, less_x = s.x - step * direction;
  const NodalVector more_u = s.u + step * direction, less_u = s.u - step * direction;
  std::vector<SixColumns> derivatives;
  for (std::size_t r = 0; r < terms_.size(); ++r)
    derivatives.push_back(of_all_ranks(
        r, (stresses(*terms_[r], {s.t, more_x, more_u, s.v}) - stresses(*terms_[r], {s.t, less_x, less_u, s.v})) /
               (2 * step)));
  return misfit_of(derivatives);
}

double StressRecovery::product(const StressMisfit& a, const StressMisfit& b) const {
  const ElementMesh mesh(mesh_);
  double sum = 0;
  for (std::size_t r = 0; r < terms_.size(); ++r)
    sum += misfit_product(mesh, *terms_[r], regions()[r].places, a[r], b[r]);
  return subdomain_ ? subdomain_->ranks().sum(sum) : sum;
}

}  // namespace orthodyn
