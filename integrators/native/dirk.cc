#include "integrators/native/dirk.h"

#include <algorithm>
#include <utility>

namespace orthodyn {

Dirk::Dirk(const std::string& name, const Model& model, const NewtonOptions& options, const Scales& scales,
           DirkTable table)
    : OneStep(name, model, options, scales), table_(std::move(table)), past_(model.space()), tried_(past_) {
  std::vector<double> diagonals;
  for (const auto& row : table_.a) {
    const auto known = std::find(diagonals.begin(), diagonals.end(), row.back());
    const auto place = static_cast<std::size_t>(known - diagonals.begin());
    if (known == diagonals.end()) {
      diagonals.push_back(row.back());
      solvers_.push_back(std::make_unique<StageSolver>(model, options, norm_, statistics_));
    }
    solver_of_.push_back(solvers_[place].get());
  }
  const auto stages = static_cast<Eigen::Index>(table_.c.size());
  V_.resize(model.num_dofs(), stages);
  A_.resize(model.num_dofs(), stages);
}

void Dirk::restarted() {
  for (const auto& solver : solvers_) solver->restart();
  past_.clear();
  past_.add(now().t, now().a);
}

bool Dirk::attempt(double h) {
  tried_ = past_;
  V_.col(0) = now().v;
  A_.col(0) = now().a;
  for (const auto& solver : solvers_) solver->begin_step();
  for (Eigen::Index i = 1; i < V_.cols(); ++i)
    if (!solve_stage(i, h)) return false;
  next_.v = V_.rightCols(1);
  next_.a = A_.rightCols(1);
  return true;
}

bool Dirk::solve_stage(Eigen::Index i, double h) {
  const auto& row = table_.a[static_cast<std::size_t>(i - 1)];
  const Eigen::Map<const Vector> known(row.data(), i);
  const double gamma = h * row.back();
  stage_.t = now().t + table_.c[static_cast<std::size_t>(i)] * h;
  stage_.v = now().v + h * (A_.leftCols(i) * known);
  stage_.q = now().q + h * (V_.leftCols(i) * known) + gamma * stage_.v;
  stage_.w_d = gamma;
  stage_.w_k = gamma * gamma;
  tried_.predict(stage_.t, A_.col(i));
  if (!solver_of_[static_cast<std::size_t>(i - 1)]->solve(stage_, A_.col(i), next_.q, V_.col(i))) return false;
  tried_.add(stage_.t, A_.col(i));
  return true;
}

void Dirk::estimate(double h, VectorRef e_q, VectorRef e_v) {
  const Eigen::Map<const Vector> weights(table_.error.data(), V_.cols());
  e_q = h * (V_ * weights);
  e_v = h * (A_ * weights);
  solver_of_.back()->filter(e_q, e_v);
}

void Dirk::accepted(double) { std::swap(past_, tried_); }

std::size_t Dirk::factor_bytes() const {
  std::size_t sum = 0;
  for (const auto& solver : solvers_) sum += solver->factor_bytes();
  return sum;
}

std::size_t Dirk::method_bytes() const {
  std::size_t sum = past_.bytes() + tried_.bytes();
  for (const auto& solver : solvers_) sum += solver->bytes();
  const auto vectors = static_cast<std::size_t>(2 * V_.cols() + 2);
  return sum + vectors * static_cast<std::size_t>(model_.num_dofs()) * sizeof(double);
}

}  // namespace orthodyn
