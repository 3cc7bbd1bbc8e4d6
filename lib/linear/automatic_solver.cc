// The automatic choice: Cholesky if its factor fits in memory and is cheaper, else PETSc; KLU if A is unsymmetric.
#include <fmt/format.h>

#include "lib/core/memory.h"
#include "lib/linear/solver.h"
#include "lib/linear/solver_cost.h"

namespace orthodyn {
namespace {

// Numbers of unknowns. Below the first, a factor always costs less (docs/decisions.md). With the second or more, not
// even the analysis of a factor is tried (an estimated limit).
constexpr int kIterativeFrom = 100'000, kOnlyIterativeFrom = 3'000'000;
// Largest share of memory_limit() for a factor (an estimate). The limit is used instead of the free memory, so that the
// same scene always has the same solver.
constexpr double kShareOfMemory = 0.6;

constexpr double kSolutions = 15;  // solutions per factor in an adaptive run, measured

bool is_cheaper_by_iterations(const Pattern& pattern, double factor_bytes) {
  using namespace solver_cost;
  const double entries = factor_bytes / kBytesPerEntry, n = pattern.n;
  const double all = 2 * static_cast<double>(pattern.row.size());
  return kFactor * entries * entries / n + kSolutions * kSolve * entries >
         all * (kSetUp + kSolutions * kIterations * kIteration);
}

// Reason to iterate, for description(); "" if a factor fits and costs less.
std::string why_iterations(const Pattern& pattern, double factor_bytes) {
  constexpr double kGigabyte = 1e9;
  const double gigabytes = factor_bytes / kGigabyte, limit = memory_limit();
  if (factor_bytes > kShareOfMemory * limit)
    return fmt::format("a factor needs {:.3g} GB, more than {} of {:.3g} GB of memory", gigabytes, kShareOfMemory,
                       limit / kGigabyte);
  if (is_cheaper_by_iterations(pattern, factor_bytes))
    return fmt::format("a factor of {:.3g} GB costs more than iterations", gigabytes);
  return "";
}

class AutomaticSolver : public LinearSolver {
 public:
  void analyze(const Pattern& pattern) override {
    if (!pattern.symmetric) return use("klu", pattern);
    if (pattern.share) return use(pattern.share->unknowns < kIterativeFrom ? "cholesky" : "petsc", pattern);
    const bool has_petsc = solver_registry().at("petsc").unavailable.empty();
    if (!has_petsc || pattern.n < kIterativeFrom) return use("cholesky", pattern);
    if (pattern.n >= kOnlyIterativeFrom)
      return use("petsc", pattern, fmt::format("no factor is tried for {} unknowns", pattern.n));
    try {
      use("cholesky", pattern);
    } catch (const RunError&) {  // more than 2^31 entries, or no memory for the analysis
      return use("petsc", pattern, "the analysis of a factor failed");
    }
    const auto factor = static_cast<double>(solver_->factor_bytes());
    const std::string because = why_iterations(pattern, factor);
    if (because.empty()) return;
    try {
      use("petsc", pattern, because);
    } catch (const ConfigError&) {  // PETSc cannot be loaded
      use("cholesky", pattern, because + ", but PETSc cannot be loaded");
    }
  }

  FactorStatus factor(const double* values) override { return solver_->factor(values); }
  bool checks_definiteness() const override { return solver_->checks_definiteness(); }
  void solve(const ConstVectorRef& b, VectorRef x) override { solver_->solve(b, x); }
  bool is_iterative() const override { return solver_->is_iterative(); }
  void set_tolerance(const SolveTolerance& tolerance) override { solver_->set_tolerance(tolerance); }
  bool wants_rigid_motions() const override { return solver_->wants_rigid_motions(); }
  void set_rigid_motions(const Eigen::MatrixXd& motions) override { solver_->set_rigid_motions(motions); }
  int negative_eigenvalues() const override { return solver_->negative_eigenvalues(); }
  std::optional<bool> has_negative_determinant() const override { return solver_->has_negative_determinant(); }
  std::size_t factor_bytes() const override { return solver_ ? solver_->factor_bytes() : 0; }
  std::string description() const override {
    if (!solver_) return "not chosen yet";
    return fmt::format("{}: {}{}", type_, solver_->description(), because_.empty() ? "" : "; " + because_);
  }

 private:
  void use(const char* type, const Pattern& pattern, const std::string& because = "") {
    solver_.reset();  // first, to free its memory
    solver_ = make_linear_solver({type}, pattern);
    type_ = type;
    because_ = because;
  }

  const char* type_ = "";
  std::string because_;  // why no factor is used, or ""
  std::unique_ptr<LinearSolver> solver_;
};

const bool automatic_registered = register_solver(
    "auto", {"cholesky where its factor fits in memory and costs less than iterations, else petsc; on several ranks "
             "petsc from 100,000 unknowns on. klu where the tangent is unsymmetric.",
             true, [](const std::string&) { return std::make_unique<AutomaticSolver>(); }, false, "", true});

}  // namespace
}  // namespace orthodyn
