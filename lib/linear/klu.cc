// KLU (Davis & Palamadai Natarajan): sparse LU for general matrices, minimum-degree ordering.
#include <klu.h>

#include <optional>
#include <span>
#include <vector>

#include "lib/core/errors.h"
#include "lib/core/memory.h"
#include "lib/linear/solver.h"

namespace orthodyn {
namespace {

// Pivots are reused as long as entries grow by less than the inverse of this number, which loses at most three digits.
constexpr double kSmallestReciprocalGrowth = 1e-3;

bool is_odd(std::span<const int> permutation) {
  std::vector<bool> seen(permutation.size(), false);
  bool odd = false;
  for (std::size_t k = 0; k < permutation.size(); ++k)
    for (std::size_t i = k; !seen[i]; i = static_cast<std::size_t>(permutation[i])) {
      seen[i] = true;
      if (static_cast<std::size_t>(permutation[i]) != k) odd = !odd;
    }
  return odd;
}

class Klu : public LinearSolver {
 public:
  Klu() {
    klu_defaults(&common_);
    common_.ordering = 0;  // AMD
    common_.btf = 0;       // the matrices are irreducible
  }

  ~Klu() override { release(); }
  Klu(const Klu&) = delete;
  Klu& operator=(const Klu&) = delete;

  void analyze(const Pattern& pattern) override {
    release();
    pattern_ = &pattern;
    const std::vector<double> zeros(pattern.row.size(), 0.0);
    full_ = full(zeros.data());
    symbolic_ = klu_analyze(static_cast<int>(full_.cols()), full_.outerIndexPtr(), full_.innerIndexPtr(), &common_);
    if (!symbolic_)
      throw RunError("KLU's analysis failed for lack of memory; use cholesky or a coarser mesh", Reason::out_of_memory);
  }

  FactorStatus factor(const double* values) override {
    if (!numeric_)
      require_memory_for_factor(factor_bytes(), "the pair of LU factors", "use cholesky or a coarser mesh");
    full_ = full(values);
    int* p = full_.outerIndexPtr();
    int* i = full_.innerIndexPtr();
    double* x = full_.valuePtr();
    const bool kept_pivots = numeric_ && klu_refactor(p, i, x, symbolic_, numeric_, &common_) &&
                             klu_rgrowth(p, i, x, symbolic_, numeric_, &common_) &&
                             common_.rgrowth > kSmallestReciprocalGrowth;
    if (!kept_pivots) {
      klu_free_numeric(&numeric_, &common_);
      numeric_ = klu_factor(p, i, x, symbolic_, &common_);
    }
    if (common_.status == KLU_OUT_OF_MEMORY || common_.status == KLU_TOO_LARGE)
      throw RunError("the LU factors do not fit in memory; use cholesky or a coarser mesh", Reason::out_of_memory);
    return numeric_ ? FactorStatus::ok : FactorStatus::singular;
  }

  bool checks_definiteness() const override { return false; }

  void solve(const ConstVectorRef& b, VectorRef x) override {
    x = b;
    klu_solve(symbolic_, numeric_, static_cast<int>(x.size()), 1, x.data(), &common_);
  }

  // Computed from the signs of the pivots and of the permutations; KLU's row scales are positive.
  std::optional<bool> has_negative_determinant() const override {
    const auto* pivots = static_cast<const double*>(numeric_->Udiag);
    const auto n = static_cast<std::size_t>(symbolic_->n);
    bool negative = is_odd({numeric_->Pnum, n}) != is_odd({symbolic_->Q, n});
    for (std::size_t k = 0; k < n; ++k) negative = negative != (pivots[k] < 0);
    return negative;
  }

  std::size_t factor_bytes() const override {
    if (!symbolic_) return 0;
    const double entries = numeric_ ? double(numeric_->lnz) + double(numeric_->unz) : symbolic_->lnz + symbolic_->unz;
    return static_cast<std::size_t>(entries) * (sizeof(double) + sizeof(int));
  }

  std::string description() const override { return "LU, minimum degree"; }

 private:
  SparseMatrix full(const double* values) const {
    const auto A = pattern_->matrix(values);
    if (!pattern_->symmetric) return A;
    return A.selfadjointView<Eigen::Lower>();
  }

  void release() {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }

  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  const Pattern* pattern_ = nullptr;
  SparseMatrix full_;
};

const bool klu_registered = register_solver("klu", {"KLU sparse LU on the reduced n x n matrix; symmetric or not.",
                                                    true, [](const std::string&) { return std::make_unique<Klu>(); }});

}  // namespace
}  // namespace orthodyn
