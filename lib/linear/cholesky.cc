// Sparse Cholesky in double precision; in single precision where the wanted tolerance permits, for half the time and
// memory.
//
// Single precision serves corrections of Newton's method, which the next iteration corrects, and preconditioners. The
// first solution with each factor is refined once, which shows its error. If this is larger than 1e-3, each solution is
// refined. If refinement does not converge well, or if a pivot is not positive (perhaps by round-off), this and the
// next ten factorisations are in double precision.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "lib/core/errors.h"
#include "lib/core/memory.h"
#include "lib/linear/solver.h"
#include "lib/linear/supernodal_factor.h"

namespace orthodyn {
namespace {

// Relative error of solutions in single precision, and the tolerance from which on it is used.
constexpr double kSingleTolerance = 1e-3;
constexpr double kSlowRefinement = 0.1;  // ratio of successive errors
constexpr int kMostRefinements = 4;
constexpr int kDoubleFactors = 10;  // before single precision is tried again

class Cholesky : public LinearSolver {
 public:
  void analyze(const Pattern& pattern) override {
    single_.reset();
    double_.reset();
    try {
      supernodes_ = find_supernodes(pattern);
    } catch (const std::bad_alloc&) {
      refuse_size();
    }
    pattern_ = &pattern;
    residual_.resize(pattern.n);
    correction_.resize(pattern.n);
    num_single_ = num_double_ = doubles_left_ = 0;
  }

  FactorStatus factor(const double* values) override {
    values_ = values;
    if (doubles_left_ > 0) --doubles_left_;
    else if (wants_single()) {
      is_accurate_ = false;
      if (refactor(single_)) {
        double_.reset();
        ++num_single_;
        return FactorStatus::ok;
      }
    }
    return factor_in_double();
  }

  bool checks_definiteness() const override { return true; }

  void solve(const ConstVectorRef& b, VectorRef x) override {
    if (double_) return double_->solve(b, x);
    residual_ = b;  // x may be b
    single_->solve(residual_, x);
    if (!is_accurate_ && !refine(x)) {
      if (factor_in_double() != FactorStatus::ok)
        throw RecoverableError("the matrix is indefinite in double precision");
      double_->solve(rhs_, x);
    }
  }

  void set_tolerance(const SolveTolerance& tolerance) override { tolerance_ = tolerance.relative; }

  std::size_t factor_bytes() const override {
    if (!supernodes_) return 0;
    const bool single = !double_ && (single_ || wants_single());
    return supernodes_->bytes() +
           (single ? SupernodalFactor<float>::bytes(*supernodes_) : SupernodalFactor<double>::bytes(*supernodes_));
  }

  std::string description() const override {
    std::string text = supernodes_ && supernodes_->nested_dissection ? "nested dissection" : "minimum degree";
    if (!wants_single()) return text;
    if (num_single_ > 0) text += fmt::format(", {} factors in single precision", num_single_);
    if (num_double_ > 0) text += fmt::format(", {} in double precision", num_double_);
    return text;
  }

 private:
  bool wants_single() const { return tolerance_ >= kSingleTolerance; }

  FactorStatus factor_in_double() {
    if (single_) doubles_left_ = kDoubleFactors;
    single_.reset();
    ++num_double_;
    return refactor(double_) ? FactorStatus::ok : FactorStatus::not_positive_definite;
  }

  // Makes the factor at its first use.
  template <class T>
  bool refactor(std::optional<SupernodalFactor<T>>& factor) {
    if (!factor) {
      require_memory_for_factor(
          SupernodalFactor<T>::bytes(*supernodes_), "the Cholesky factor",
          "use a coarser mesh, or an explicit integrator (central_differences), which needs no factor");
      try {
        factor.emplace(*supernodes_);
      } catch (const std::bad_alloc&) {
        refuse_size();
      }
    }
    return factor->factor(values_);
  }

  [[noreturn]] static void refuse_size() {
    throw RunError("the Cholesky factor does not fit in memory; use a coarser mesh", Reason::out_of_memory);
  }

  // Refines x, a solution in single precision for the right-hand side residual_. False if this converges too slowly.
  // The correction shows the error before it: its square in the energy norm is correction . residual.
  bool refine(VectorRef x) {
    rhs_ = residual_;
    const double energy = x.dot(rhs_);
    double last = energy;
    for (int k = 0; k < kMostRefinements; ++k) {
      pattern_->multiply(values_, x, residual_);
      residual_ = rhs_ - residual_;
      single_->solve(residual_, correction_);
      const double error = correction_.dot(residual_);
      if (!std::isfinite(error)) return std::isnan(energy);  // NaN in, NaN out
      x += correction_;
      if (error <= square(kSingleTolerance) * energy) {
        if (k == 0 && energy > 0) is_accurate_ = true;
        return true;
      }
      if (error > square(kSlowRefinement) * last) return false;
      last = error;
    }
    return false;
  }

  static double square(double x) { return x * x; }

  double tolerance_ = SolveTolerance{}.relative;
  const Pattern* pattern_ = nullptr;
  const double* values_ = nullptr;
  std::optional<Supernodes> supernodes_;
  std::optional<SupernodalFactor<float>> single_;
  std::optional<SupernodalFactor<double>> double_;
  bool is_accurate_ = false;  // solutions with single_ need no refinement
  int num_single_ = 0, num_double_ = 0, doubles_left_ = 0;
  Vector rhs_, residual_, correction_;
};

const bool cholesky_registered = register_solver(
    "cholesky", {"Supernodal sparse Cholesky on the reduced n x n matrix; symmetric tangents. Corrections of Newton's "
                 "method use single precision where that suffices.",
                 false, [](const std::string&) { return std::make_unique<Cholesky>(); }});

}  // namespace
}  // namespace orthodyn
