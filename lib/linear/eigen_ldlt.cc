// Eigen's simplicial L D L^T, for small systems.
#include <Eigen/SparseCholesky>

#include "lib/linear/solver.h"

namespace orthodyn {
namespace {

// Gives the number of entries of L after the analysis; matrixL() is available only after a factorisation.
class Ldlt : public Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> {
 public:
  std::size_t entries() const { return static_cast<std::size_t>(m_matrix.nonZeros()); }
};

class EigenLdlt : public LinearSolver {
 public:
  void analyze(const Pattern& pattern) override {
    pattern_ = &pattern;
    const std::vector<double> ones(pattern.row.size(), 1);
    ldlt_.analyzePattern(pattern.matrix(ones.data()));
  }

  FactorStatus factor(const double* values) override {
    ldlt_.factorize(pattern_->matrix(values));
    if (ldlt_.info() != Eigen::Success) return FactorStatus::singular;
    const bool positive = (ldlt_.vectorD().array() > 0).all();  // false for NaN
    return positive ? FactorStatus::ok : FactorStatus::not_positive_definite;
  }

  bool checks_definiteness() const override { return true; }

  void solve(const ConstVectorRef& b, VectorRef x) override { x = ldlt_.solve(Vector(b)); }

  std::size_t factor_bytes() const override { return pattern_ ? ldlt_.entries() * (sizeof(double) + sizeof(int)) : 0; }

  std::string description() const override { return "simplicial, minimum degree"; }

 private:
  const Pattern* pattern_ = nullptr;
  Ldlt ldlt_;
};

const bool eigen_ldlt_registered = register_solver(
    "eigen_ldlt", {"Eigen's simplicial Cholesky on the reduced n x n matrix; symmetric tangents, small systems.", false,
                   [](const std::string&) { return std::make_unique<EigenLdlt>(); }});

}  // namespace
}  // namespace orthodyn
