#include "integrators/native/dirk.h"

#include <algorithm>
#include <utility>

namespace orthodyn {

DirkTable composite_table(double g, double q1, double q2) {
  const double q0 = 1 - q1 - q2;
  const double b1 = 1 / (6 * g * (1 - g)), b2 = 0.5 - g * b1, b0 = 1 - b1 - b2;
  return {2, 3, {0, g, 1}, {{g / 2, g / 2}, {q0, q1, q2}}, {b0 - q0, b1 - q1, b2 - q2}};
}

Dirk::Dirk(const std::string& name, const Model& model, const NewtonOptions& options, const Scales& scales,
           DirkTable table)
    : OneStep(name, model, options, scales),
      table_(std::move(table)),
      predictor_(model.space()),
      attempt_predictor_(predictor_) {
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
  predictor_.clear();
  predictor_.add(now().t, now().a);
}

bool Dirk::attempt(double h) {
  attempt_predictor_ = predictor_;
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
  attempt_predictor_.predict(stage_.t, A_.col(i));
  if (!solver_of_[static_cast<std::size_t>(i - 1)]->solve(stage_, A_.col(i), next_.q, V_.col(i))) return false;
  attempt_predictor_.add(stage_.t, A_.col(i));
  return true;
}

void Dirk::estimate(double h, VectorRef e_q, VectorRef e_v) {
  const Eigen::Map<const Vector> weights(table_.error.data(), V_.cols());
  e_q = h * (V_ * weights);
  e_v = h * (A_ * weights);
  solver_of_.back()->filter(e_q, e_v);
}

void Dirk::accepted(double) { std::swap(predictor_, attempt_predictor_); }

std::size_t Dirk::factor_bytes() const {
  std::size_t sum = 0;
  for (const auto& solver : solvers_) sum += solver->factor_bytes();
  return sum;
}

std::size_t Dirk::method_bytes() const {
  std::size_t sum = predictor_.bytes() + attempt_predictor_.bytes();
  for (const auto& solver : solvers_) sum += solver->bytes();
  const auto vectors = static_cast<std::size_t>(2 * V_.cols() + 2);
  return sum + vectors * static_cast<std::size_t>(model_.num_dofs()) * sizeof(double);
}

}  // namespace orthodyn
