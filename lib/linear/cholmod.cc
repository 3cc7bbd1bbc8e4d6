// CHOLMOD (Davis et al.): sparse Cholesky, simplicial for small and supernodal for large factors.
#include <fmt/format.h>

#include <optional>

#include "lib/core/errors.h"
#include "lib/core/memory.h"
#include "lib/core/versions.h"
#include "lib/linear/blas.h"
#include "lib/linear/cholmod_view.h"
#include "lib/linear/gathered_solver.h"
#include "lib/linear/solver.h"

namespace orthodyn {
namespace {

enum class Definite { yes, no };

class Cholmod : public LinearSolver {
 public:
  explicit Cholmod(Definite definite = Definite::yes) : definite_(definite) {
    cholmod_start(&common_);
    common_.print = 0;
    common_.quick_return_if_not_posdef = 1;
#ifdef ORTHODYN_GPL
    common_.supernodal = definite == Definite::yes ? CHOLMOD_AUTO : CHOLMOD_SIMPLICIAL;
    // Merges narrow supernodes up to these numbers of columns, at the cost of stored zeros (CHOLMOD's defaults: 4 and
    // 16).
    common_.nrelax[0] = 16, common_.nrelax[1] = 24;
#else
    common_.supernodal = CHOLMOD_SIMPLICIAL;
#endif
  }

  ~Cholmod() override {
    cholmod_free_dense(&y_, &common_);
    cholmod_free_dense(&e_, &common_);
    cholmod_free_dense(&x_, &common_);
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  void analyze(const Pattern& pattern) override {
    pattern_ = &pattern;
    const bool dissect = pattern.n >= kNestedDissectionFrom;
    common_.nmethods = 1;
    common_.method[0].ordering = dissect ? CHOLMOD_METIS : CHOLMOD_AMD;
    common_.postorder = 1;
    cholmod_free_factor(&factor_, &common_);
    cholmod_sparse view = cholmod_view(pattern, nullptr);
    factor_ = cholmod_analyze(&view, &common_);
    if (!factor_ && dissect && common_.status != CHOLMOD_OUT_OF_MEMORY) {  // CHOLMOD was built without METIS
      common_.method[0].ordering = CHOLMOD_AMD;
      factor_ = cholmod_analyze(&view, &common_);
    }
    refuse_failure();
    if (!factor_) throw RunError("CHOLMOD could not analyse the matrix");
    predicted_entries_ = static_cast<std::size_t>(common_.lnz);
    description_ = fmt::format("{}, {}", factor_->is_super ? "supernodal" : "simplicial",
                               factor_->ordering == CHOLMOD_METIS ? "nested dissection" : "minimum degree");
  }

  FactorStatus factor(const double* values) override {
    const BlasThreadLimit threads(most_threads());
    const SerialOpenMp serial;
    if (factor_->xtype == CHOLMOD_PATTERN)  // first factorisation on this pattern
      require_memory_for_factor(
          factor_bytes(), "the Cholesky factor",
          "use a coarser mesh, or an explicit integrator (central_differences), which needs no factor");
    cholmod_sparse view = cholmod_view(*pattern_, values);
    cholmod_factorize(&view, factor_, &common_);
    if (common_.status == CHOLMOD_NOT_POSDEF)
      return definite_ == Definite::yes ? FactorStatus::not_positive_definite : FactorStatus::singular;
    refuse_failure();
    negative_pivots_ = count_negative_pivots();
    const bool indefinite = negative_pivots_ > 0 && definite_ == Definite::yes;
    return indefinite ? FactorStatus::not_positive_definite : FactorStatus::ok;
  }

  int negative_eigenvalues() const override { return negative_pivots_; }

  bool checks_definiteness() const override { return definite_ == Definite::yes; }

  void solve(const ConstVectorRef& b, VectorRef x) override {
    const BlasThreadLimit threads(most_threads());
    const SerialOpenMp serial;
    cholmod_dense view{};
    view.nrow = static_cast<std::size_t>(b.size());
    view.ncol = 1;
    view.nzmax = view.d = view.nrow;
    view.x = const_cast<double*>(b.data());  // CHOLMOD only reads it
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    if (!cholmod_solve2(CHOLMOD_A, factor_, &view, nullptr, &x_, nullptr, &y_, &e_, &common_)) refuse_failure();
    x = Eigen::Map<const Vector>(static_cast<const double*>(x_->x), b.size());
  }

  // The factor and CHOLMOD's workspace: a permuted copy of the matrix and, for supernodes, the largest update matrix.
  std::size_t factor_bytes() const override {
    if (!factor_) return 0;
    const std::size_t n = factor_->n, index = sizeof(int), number = sizeof(double);
    const std::size_t copy = pattern_->row.size() * (number + index) + n * index;
    if (factor_->is_super)
      return factor_->xsize * number + factor_->ssize * index + 3 * factor_->nsuper * index + 2 * n * index +
             factor_->maxcsize * number + copy;
    const std::size_t entries = factor_->xtype == CHOLMOD_PATTERN ? predicted_entries_ : factor_->nzmax;
    return entries * (number + index) + 6 * n * index + copy;
  }

  std::string description() const override { return description_; }

 private:
  std::optional<int> most_threads() const {
    return pattern_->n < kBlasThreadsFrom || blas_uses_openmp() ? std::optional(1) : std::nullopt;
  }

  // The simplicial factorisation is L D L^T, which continues past a negative pivot.
  int count_negative_pivots() const {
    if (factor_->is_super || factor_->is_ll) return 0;
    const auto* column = static_cast<const int*>(factor_->p);
    const auto* value = static_cast<const double*>(factor_->x);
    int negative = 0;
    for (std::size_t j = 0; j < factor_->n; ++j)
      if (!(value[column[j]] > 0)) ++negative;
    return negative;
  }

  void refuse_failure() const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY)
      throw RunError("the Cholesky factor does not fit in memory; use a coarser mesh", Reason::out_of_memory);
    if (common_.status == CHOLMOD_TOO_LARGE)
      throw RunError("the Cholesky factor has more than 2^31 entries; use a coarser mesh");
    if (common_.status < 0) throw RunError(fmt::format("CHOLMOD failed with status {}", common_.status));
  }

  Definite definite_;
  int negative_pivots_ = 0;
  const Pattern* pattern_ = nullptr;
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;
  std::size_t predicted_entries_ = 0;
  std::string description_;
};

const bool cholmod_registered = register_solver(
    "cholmod",
    {"CHOLMOD sparse Cholesky on the reduced n x n matrix, simplicial or supernodal by size; symmetric tangents.",
     false, [](const std::string&) { return std::make_unique<Cholmod>(); }});

const bool version_registered = library_versions()
                                    .emplace("SuiteSparse", fmt::format("CHOLMOD {}.{}.{}", CHOLMOD_MAIN_VERSION,
                                                                        CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION))
                                    .second;

}  // namespace

std::unique_ptr<LinearSolver> make_indefinite_solver(const Pattern& pattern) {
  return prepare(std::make_unique<Cholmod>(Definite::no), pattern);
}

}  // namespace orthodyn
