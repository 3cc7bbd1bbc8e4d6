#include "lib/analysis/strain_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lib/analysis/strain_limits.h"

namespace orthodyn {

namespace {

constexpr double kMargin = 2;          // between Green's strain and that of the law; engineering shear counts twice
constexpr double kOvershoot = 2;       // of a load applied at once, over its static response
constexpr int kLargestSystem = 30000;  // unknowns that are factorised for a warning's sake

// The elements of a region beyond one limit.
struct Excess {
  int axis = 0, count = 0;
  double worst = 0;  // sigma / E, as a strain
  StrainLimit limit{};
  double severity() const { return worst / limit.strain; }
};

// A column for each point, as ElasticTerm::strains() has them.
using Strains = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using AxialStrains = Eigen::Matrix<double, 3, Eigen::Dynamic>;

// Of all axes and signs the limit that is exceeded most; count 0 if none is.
Excess find_excess(const ElasticTerm& term, const std::array<AxisLimits, 3>& limits, const AxialStrains& strains) {
  std::array<std::array<Excess, 2>, 3> found;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& [compression, tension] = limits[axis];
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& limit = side == 0 ? compression : tension;
      if (limit) found[axis][side] = {static_cast<int>(axis), 0, 0, *limit};
    }
  }
  for (int k = 0; k < term.size(); ++k) {
    const auto e = strains.middleCols(k * term.num_points(), term.num_points());
    for (auto& sides : found)
      for (Excess& one : sides) {
        if (one.limit.strain == 0) continue;
        const double share = (e.row(one.axis) / one.limit.strain).maxCoeff<Eigen::PropagateNumbers>();
        if (!(share > 1)) continue;
        ++one.count;
        if (share > one.severity()) one.worst = share * one.limit.strain;
      }
  }
  Excess most;
  for (const auto& sides : found)
    for (const Excess& one : sides)
      if (one.count > 0 && (most.count == 0 || one.severity() > most.severity())) most = one;
  return most;
}

std::string warning(const ElasticTerm& term, const Excess& e, const std::string& cause) {
  const std::string means =
      e.limit.kind == LimitKind::flat
          ? fmt::format("a bar of it that is pulled along this axis has no thickness left ({})",
                        describe(e.limit, e.axis))
          : fmt::format(
                "the corotational law is no longer elliptic ({}): patterns as small as the elements then come "
                "from the mesh, not from the material",
                describe(e.limit, e.axis));
  return fmt::format(
      "region {}: {} {} of {} elements along material axis {} under the stress of a strain of {:+.3g} "
      "%; beyond {:+.3g} % {}. Lower the load, or look for a mistake in the constants and axes",
      term.region(), cause, e.count, term.size(), e.axis + 1, 100 * e.worst, 100 * e.limit.strain, means);
}

Strains small_strains(const ElasticTerm& term, const NodalVector& u) {
  Strains out(6, term.size() * term.num_points());
  for (int k = 0; k < term.size(); ++k)
    for (int p = 0; p < term.num_points(); ++p)
      out.col(k * term.num_points() + p) = voigt_strain<double>(term.small_strain(k, p, u));
  return out;
}

// By a body of this material.
bool may_be_met(const Stiffness& stiffness) {
  for (const AxisLimits& axis : strain_limits(stiffness))
    if (axis.compression || (axis.tension && axis.tension->strain < 1)) return true;
  return false;
}

double smallest(const std::array<AxisLimits, 3>& limits) {
  double least = std::numeric_limits<double>::infinity();
  for (const AxisLimits& axis : limits)
    for (const auto& limit : {axis.compression, axis.tension})
      if (limit && limit->strain != 0) least = std::min(least, std::abs(limit->strain));
  return least;
}

}  // namespace

bool needs_strain_check(const FemModel& model, const std::vector<Stiffness>& stiffness) {
  return model.num_dofs() <= kLargestSystem && std::any_of(stiffness.begin(), stiffness.end(), may_be_met);
}

Warnings strain_warnings(const FemModel& model, const std::vector<Stiffness>& stiffness, const State& initial,
                         const StaticResponse& statics) {
  Warnings out;
  NodalVector u = NodalVector::Zero(3, model.parts().rest->cols());
  if (statics.exists()) model.parts().dofs->add_to(statics.displacement, u);
  const NodalExpansion start(model.parts(), initial.t, initial.q, initial.v);
  for (std::size_t r = 0; r < stiffness.size(); ++r) {
    const auto& term = model.parts().elastic[r];
    const auto limits = strain_limits(stiffness[r]);
    const Mat36 equivalent = stress_over_young(stiffness[r]);
    const auto check = [&](const std::string& cause, const Strains& strains) {
      const Excess excess = find_excess(*term, limits, equivalent * strains);
      if (excess.count > 0) out.push_back(warning(*term, excess, cause));
    };
    if (statics.exists())
      check("twice the linear static response to the loads puts", kOvershoot * small_strains(*term, u));
    if (!initial.q.isZero(0)) check("the initial deformation puts", term->strains(start.state()));
  }
  return out;
}

std::optional<StrainExcess> strain_excess(const FemModel& model, const NodalState& state) {
  std::optional<StrainExcess> worst;
  for (const auto& term : model.parts().elastic) {
    if (term->definition().options.kinematics == Kinematics::linear) continue;
    const Stiffness& stiffness = term->definition().stiffness;
    const Mat36 equivalent = stress_over_young(stiffness);
    const auto limits = strain_limits(stiffness);
    const double far_off = smallest(limits) / (kMargin * equivalent.rowwise().norm().maxCoeff());
    if (term->largest_green_strain(state) < far_off) continue;
    const Excess excess = find_excess(*term, limits, equivalent * term->strains(state));
    if (excess.count > 0 && (!worst || excess.severity() > worst->share))
      worst = {excess.severity(), warning(*term, excess, "the motion put")};
  }
  return worst;
}

bool has_strain_limits(const FemModel& model) {
  return std::any_of(model.parts().elastic.begin(), model.parts().elastic.end(), [](const auto& term) {
    return term->definition().options.kinematics != Kinematics::linear && may_be_met(term->definition().stiffness);
  });
}

}  // namespace orthodyn
