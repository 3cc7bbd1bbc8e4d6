#include "lib/petsc/energy_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/errors.h"

namespace orthodyn::petsc {

namespace {

// Relative error in the energy norm below which energy differences are round-off and the residual is used instead.
constexpr double kResolution = 1e-7;
constexpr double kSafety = 2;        // factor on the estimated error
constexpr double kRoundOff = 1e-14;  // relative to the first residual: below this, search directions are round-off

}  // namespace

void EnergyTest::attach(KSP method) {
  PetscBool is_cg = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(method), KSPCG, &is_cg));
  KSPNormType norm = KSP_NORM_NONE;
  check(KSPGetNormType(method, &norm));
  if (!is_cg || norm == KSP_NORM_NONE) return;
  const auto function = [](KSP solver, PetscInt iteration, PetscReal residual, KSPConvergedReason* reason,
                           void* test) -> PetscErrorCode {
    try {
      *reason = static_cast<EnergyTest*>(test)->test(solver, iteration, residual);
      return static_cast<PetscErrorCode>(0);
    } catch (const RunError& e) {
      return e.reason() == Reason::out_of_memory ? PETSC_ERR_MEM : PETSC_ERR_LIB;
    } catch (...) {
      return PETSC_ERR_LIB;
    }
  };
  check(KSPSetConvergenceTest(method, function, this, nullptr));
}

void EnergyTest::set(const SolveTolerance& tolerance, double unknowns) {
  tolerance_ = tolerance;
  absolute_ = tolerance.absolute * std::sqrt(unknowns);
}

KSPConvergedReason EnergyTest::test(KSP method, PetscInt iteration, double residual) {
  if (!std::isfinite(residual)) return KSP_DIVERGED_NANORINF;
  if (residual == 0 || (iteration > 0 && residual <= kRoundOff * first_residual_)) return KSP_CONVERGED_ATOL;
  if (iteration == 0) {
    first_residual_ = residual;
    energy_ = 0;
    gains_.fill(0);
    return KSP_CONVERGED_ITERATING;
  }
  Vec x = nullptr, b = nullptr;
  double energy = 0, size = 0;
  check(KSPBuildSolution(method, nullptr, &x));
  check(KSPGetRhs(method, &b));
  check(VecDot(b, x, &energy));
  check(VecNorm(x, NORM_2, &size));
  std::rotate(gains_.begin(), gains_.end() - 1, gains_.end());
  if (!(energy >= 0)) return KSP_DIVERGED_INDEFINITE_MAT;
  gains_[0] = std::max(energy - energy_, 0.0);
  energy_ = energy;
  const double relative = std::max(tolerance_.relative, size > 0 ? absolute_ / size : 0);
  const double error = kSafety * std::sqrt(missing_energy() / energy);  // may be NaN
  if (!(error <= std::max(relative, kResolution))) return KSP_CONVERGED_ITERATING;
  if (relative < kResolution && residual > relative * first_residual_) return KSP_CONVERGED_ITERATING;
  return KSP_CONVERGED_RTOL;
}

// Sum of the future gains: a geometric series whose ratio is the larger of the last and the mean ratio of gains.
double EnergyTest::missing_energy() const {
  constexpr double kNothing = std::numeric_limits<double>::epsilon();
  if (gains_[1] == 0) return gains_[0] == 0 && energy_ > 0 ? 0 : std::numeric_limits<double>::infinity();
  if (gains_[0] <= kNothing * energy_) return kNothing * energy_;
  double rate = gains_[0] / gains_[1];
  const auto known = std::find(gains_.begin(), gains_.end(), 0.0) - gains_.begin();
  const auto oldest = static_cast<std::size_t>(known - 1);
  rate = std::max(rate, std::pow(gains_[0] / gains_[oldest], 1 / static_cast<double>(oldest)));
  return rate < 1 ? gains_[0] * rate / (1 - rate) : std::numeric_limits<double>::infinity();
}

}  // namespace orthodyn::petsc
