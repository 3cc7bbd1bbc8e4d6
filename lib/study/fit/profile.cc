#include "lib/study/fit/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/errors.h"

namespace orthodyn::study::fit {

namespace {

constexpr double kRise = 3.841459;  // 95 % quantile of chi-square with one degree of freedom
constexpr double kNormal = 1.959964;

class Profile {
 public:
  Profile(const Problem& problem, Fit fit, const Search& best, const Statistics& statistics, const JobOptions& options)
      : problem_(problem), fit_(std::move(fit)), best_(best), statistics_(statistics), options_(options) {
    fit_.tolerance = std::max(fit_.tolerance, 1e-5);  // the rise is needed to 1 %
    rise_ = kRise * std::pow(statistics.noise.factor, 2);
  }

  ProfileInterval of(std::size_t p) {
    ProfileInterval out{p, {}, {}, 2 * best_.cost};
    least_ = 2 * best_.cost;
    out.low = end(p, -1), out.high = end(p, 1);
    out.least_chi_square = least_;
    return out;
  }

 private:
  struct Point {
    Vector z;
    double rise;
  };

  // Finds the distance from the best z at which the rise is reached: the root of the rise grows almost linearly.
  ProfileEnd end(std::size_t p, int sign) {
    constexpr int kMost = 8;
    constexpr double kAccuracy = 0.01;
    const double deviation = statistics_.estimates[p].deviation_z;
    if (!std::isfinite(deviation)) return {{}, false, "the data do not determine it"};
    const auto i = static_cast<Eigen::Index>(p);
    const double farthest = room(p, sign);
    if (!(farthest > 0)) return {value_at(best_.z, p), true, ""};
    double distance = std::min(kNormal * deviation, farthest), inner = 0, outer = farthest;
    Point last{best_.z, 0};
    std::string failure;
    for (int k = 0; k < kMost; ++k) {
      try {
        last = minimum(p, best_.z[i] + sign * distance);
      } catch (const Failed& e) {
        failure = e.what(), outer = distance, distance = 0.5 * (inner + outer);
        continue;
      }
      if (std::abs(last.rise / rise_ - 1) < kAccuracy) return {value_at(last.z, p), false, ""};
      if (last.rise < rise_ && distance >= farthest) return {value_at(last.z, p), true, ""};
      (last.rise < rise_ ? inner : outer) = distance;
      const double next = last.rise > 0 ? distance * std::sqrt(rise_ / last.rise) : 2 * distance;
      const bool is_inside = next > inner && next < outer;
      distance = is_inside || !std::isfinite(outer) ? std::min({next, 3 * distance, outer}) : 0.5 * (inner + outer);
    }
    return {{}, false, failure.empty() ? "chi-square is too irregular beside its minimum" : failure};
  }

  // The largest distance that the bounds allow.
  double room(std::size_t p, int sign) const {
    const FittedParameter& parameter = problem_.parameters()[p];
    const double z = best_.z[static_cast<Eigen::Index>(p)];
    double out = std::numeric_limits<double>::infinity();
    for (const auto& bound : {parameter.lower, parameter.upper}) {
      if (!bound) continue;
      const double distance = sign * (problem_.coordinates().at(p, *bound) - z);
      if (distance >= 0) out = std::min(out, distance);
    }
    return out;
  }

  // The least chi-square with one coordinate fixed, above the best one. Starts where the linearised covariance expects
  // the others.
  Point minimum(std::size_t p, double fixed) {
    const auto i = static_cast<Eigen::Index>(p);
    const Eigen::MatrixXd& covariance = statistics_.covariance;
    Vector z = best_.z;
    for (Eigen::Index j = 0; j < z.size(); ++j)
      if (const double slope = covariance(j, i) / covariance(i, i); std::isfinite(slope))
        z[j] = within_bounds(static_cast<std::size_t>(j), z[j] + slope * (fixed - best_.z[i]));
    z[i] = fixed;
    const Search found = search(
        problem_, fit_, z, options_, [](const Iteration&) {}, p);
    least_ = std::min(least_, 2 * found.cost);
    return {found.z, 2 * (found.cost - best_.cost)};
  }

  double within_bounds(std::size_t p, double z) const {
    const FittedParameter& parameter = problem_.parameters()[p];
    if (parameter.lower) z = std::max(z, problem_.coordinates().at(p, *parameter.lower));
    if (parameter.upper) z = std::min(z, problem_.coordinates().at(p, *parameter.upper));
    return z;
  }

  double value_at(const Vector& z, std::size_t p) const {
    return problem_.coordinates().values(z)[static_cast<Eigen::Index>(p)];
  }

  const Problem& problem_;
  Fit fit_;
  const Search& best_;
  const Statistics& statistics_;
  const JobOptions& options_;
  double rise_ = kRise, least_ = 0;
};

}  // namespace

std::vector<ProfileInterval> profiles_of(const Problem& problem, const Fit& fit, const Search& best,
                                         const Statistics& statistics, const JobOptions& options,
                                         const std::function<void(const std::string& stage)>& on_stage) {
  Profile profile(problem, fit, best, statistics, options);
  std::vector<ProfileInterval> out;
  for (const std::size_t p : problem.single_parameters()) {
    on_stage(fmt::format("profile of {}", problem.parameters()[p].name));
    out.push_back(profile.of(p));
  }
  return out;
}

}  // namespace orthodyn::study::fit
