#include "lib/analysis/strain_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/analysis/strain_limits.h"

namespace orthodyn {

namespace {

constexpr double kMargin = 2;     // largest ratio of the law's strain to Green's strain; engineering shear counts twice
constexpr double kOvershoot = 2;  // response to a suddenly applied load, relative to its static response
constexpr int kLargestSystem = 30000;  // unknowns; a larger system is not factorised for a warning

// The elements of a region that exceed one limit.
struct Excess {
  int axis = 0, count = 0;
  double worst = 0;  // stress over Young's modulus that exceeds the limit most
  StrainLimit limit{};
  double severity() const { return worst / limit.strain; }
};

// One column per point, as in ElasticTerm::strains().
using Strains = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using AxialStrains = Eigen::Matrix<double, 3, Eigen::Dynamic>;

// The limit that is exceeded most, among all axes and signs; its count is 0 if none is exceeded.
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
          ? fmt::format("a bar stretched along this axis would have no thickness ({})", describe(e.limit, e.axis))
          : fmt::format(
                "the law is no longer elliptic ({}): deformation localises in single elements and depends on the mesh",
                describe(e.limit, e.axis));
  return fmt::format(
      "region {}: {} {} of {} elements along material axis {} to a strain (stress over Young's modulus) of {:+.3g} %; "
      "the limit of the corotational law is {:+.3g} %, beyond which {}. Lower the load, or check the constants and "
      "axes",
      term.region(), cause, e.count, term.size(), e.axis + 1, 100 * e.worst, 100 * e.limit.strain, means);
}

Strains small_strains(const ElasticTerm& term, const NodalVector& u) {
  Strains out(6, term.size() * term.num_points());
  for (int k = 0; k < term.size(); ++k)
    for (int p = 0; p < term.num_points(); ++p)
      out.col(k * term.num_points() + p) = voigt_strain<double>(term.small_strain(k, p, u));
  return out;
}

// Whether the limits hold for the strains of a region. They do not where added laws carry a part of the stress, or
// strain the body without stress.
bool has_limits(const ElasticTerm& term) { return !term.is_replaced() && term.added().empty(); }

// Whether a body of this material can reach a limit.
bool has_reachable_limit(const ElasticTerm& term) {
  if (!has_limits(term)) return false;
  for (const AxisLimits& axis : strain_limits(term.definition().stiffness))
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

// The norm of Green's strain up to which the law's strain cannot exceed a limit.
double safe_green_strain(const ElasticTerm& term) {
  if (term.definition().options.kinematics == Kinematics::linear || !has_limits(term))
    return std::numeric_limits<double>::infinity();
  const Stiffness& stiffness = term.definition().stiffness;
  const double largest_ratio = kMargin * stress_over_young(stiffness).rowwise().norm().maxCoeff();
  return smallest(strain_limits(stiffness)) / largest_ratio;
}

}  // namespace

bool needs_strain_check(const FemModel& model) {
  const auto& terms = model.parts().elastic;
  return model.num_dofs() <= kLargestSystem &&
         std::any_of(terms.begin(), terms.end(), [](const auto& term) { return has_reachable_limit(*term); });
}

Warnings strain_warnings(const FemModel& model, const State& initial, const StaticResponse& statics) {
  Warnings out;
  NodalVector u = NodalVector::Zero(3, model.parts().rest->cols());
  if (statics.exists()) model.parts().dofs->add_to(statics.displacement, u);
  const NodalExpansion start(model.parts(), initial.t, initial.q, initial.v);
  for (const auto& term : model.parts().elastic) {
    if (!has_limits(*term)) continue;
    const Stiffness& stiffness = term->definition().stiffness;
    const auto limits = strain_limits(stiffness);
    const Mat36 equivalent = stress_over_young(stiffness);
    const auto check = [&](const std::string& cause, const Strains& strains) {
      const Excess excess = find_excess(*term, limits, equivalent * strains);
      if (excess.count > 0) out.push_back(warning(*term, excess, cause));
    };
    if (statics.exists())
      check("twice the linear static response to the loads strains", kOvershoot * small_strains(*term, u));
    if (!initial.q.isZero(0)) check("the initial deformation strains", term->strains(start.state()));
  }
  return out;
}

std::vector<double> safe_green_strains(const FemModel& model) {
  std::vector<double> safe;
  for (const auto& term : model.parts().elastic) safe.push_back(safe_green_strain(*term));
  return safe;
}

bool is_near_strain_limit(const FemModel& model, const std::vector<double>& safe, const NodalState& state) {
  for (std::size_t r = 0; r < safe.size(); ++r)
    if (std::isfinite(safe[r]) && model.parts().elastic[r]->largest_green_strain(state) >= safe[r]) return true;
  return false;
}

std::optional<StrainExcess> strain_excess(const FemModel& model, const NodalState& state) {
  std::optional<StrainExcess> worst;
  for (const auto& term : model.parts().elastic) {
    const double safe = safe_green_strain(*term);
    if (!std::isfinite(safe) || term->largest_green_strain(state) < safe) continue;
    const Stiffness& stiffness = term->definition().stiffness;
    const Excess excess =
        find_excess(*term, strain_limits(stiffness), stress_over_young(stiffness) * term->strains(state));
    if (excess.count > 0 && (!worst || excess.severity() > worst->share))
      worst = {excess.severity(), warning(*term, excess, "the motion strained")};
  }
  return worst;
}

bool has_strain_limits(const FemModel& model) {
  return std::any_of(model.parts().elastic.begin(), model.parts().elastic.end(), [](const auto& term) {
    return term->definition().options.kinematics != Kinematics::linear && has_reachable_limit(*term);
  });
}

}  // namespace orthodyn
