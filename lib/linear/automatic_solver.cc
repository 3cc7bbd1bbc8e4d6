// Takes the Cholesky factor where it fits and costs less than iterations do, else PETSc; KLU for unsymmetric matrices.
#include <fmt/format.h>

#include "lib/core/memory.h"
#include "lib/linear/solver.h"
#include "lib/linear/solver_cost.h"

namespace orthodyn {
namespace {

// Unknowns: below the first a factor costs less (docs/decisions.md). From the second on its analysis is not tried: a
// guess, as is the share.
constexpr int kIterativeFrom = 100'000, kOnlyIterativeFrom = 3'000'000;
// Of what the process may use, that a factor may take. What others happen to leave of it decides nothing: the same
// scene has the same solver.
constexpr double kShareOfMemory = 0.6;

constexpr double kSolutions = 15;  // of an adaptive run for each factor, measured

bool is_cheaper_by_iterations(const Pattern& pattern, double factor_bytes) {
  using namespace solver_cost;
  const double entries = factor_bytes / kBytesPerEntry, n = pattern.n;
  const double all = 2 * static_cast<double>(pattern.row.size());
  return kFactor * entries * entries / n + kSolutions * kSolve * entries >
         all * (kSetUp + kSolutions * kIterations * kIteration);
}

// Empty where a factor fits and costs less.
std::string why_iterations(const Pattern& pattern, double factor_bytes) {
  constexpr double kGigabyte = 1e9;
  const double gigabytes = factor_bytes / kGigabyte, limit = memory_limit();
  if (factor_bytes > kShareOfMemory * limit)
    return fmt::format("a factor takes {:.3g} GB, more than {} of {:.3g} GB of memory", gigabytes, kShareOfMemory,
                       limit / kGigabyte);
  if (is_cheaper_by_iterations(pattern, factor_bytes))
    return fmt::format("a factor of {:.3g} GB costs more than iterations", gigabytes);
  return "";
}

class AutomaticSolver : public LinearSolver {
 public:
  void analyze(const Pattern& pattern) override {
    if (!pattern.symmetric) return take("klu", pattern);
    if (pattern.share) return take(pattern.share->unknowns < kIterativeFrom ? "cholmod" : "petsc", pattern);
    const bool has_petsc = solver_registry().at("petsc").unavailable.empty();
    if (!has_petsc || pattern.n < kIterativeFrom) return take("cholmod", pattern);
    if (pattern.n >= kOnlyIterativeFrom)
      return take("petsc", pattern, fmt::format("no factor is tried of {} unknowns", pattern.n));
    try {
      take("cholmod", pattern);
    } catch (const RunError&) {  // more than 2^31 entries, or no memory for the analysis
      return take("petsc", pattern, "a factor cannot be analysed");
    }
    const auto factor = static_cast<double>(solver_->factor_bytes());
    const std::string because = why_iterations(pattern, factor);
    if (because.empty()) return;
    try {
      take("petsc", pattern, because);
    } catch (const ConfigError&) {  // it cannot be loaded here
      take("cholmod", pattern, because + ", but PETSc cannot be loaded");
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
  void take(const char* type, const Pattern& pattern, const std::string& because = "") {
    solver_.reset();  // before the next one takes memory
    solver_ = make_linear_solver({type}, pattern);
    type_ = type;
    because_ = because;
  }

  const char* type_ = "";
  std::string because_;  // where a factor is not taken
  std::unique_ptr<LinearSolver> solver_;
};

const bool automatic_registered =
    solver_registry()
        .emplace(
            "auto",
            SolverKind{"cholmod where its factor fits in memory and costs less than iterations, else "
                       "petsc; on several ranks petsc from 100,000 unknowns on. klu where the tangent is unsymmetric.",
                       true, [](const std::string&) { return std::make_unique<AutomaticSolver>(); }, false, "", true})
        .second;

}  // namespace
}  // namespace orthodyn
