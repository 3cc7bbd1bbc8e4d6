#include "tests/contract/models.h"

#include <cmath>
#include <complex>

#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

SmallModel::SmallModel(const Matrix& mass, bool symmetric) : mass_(mass) {
  const int n = static_cast<int>(mass.rows());
  pattern_.n = n;
  pattern_.symmetric = symmetric;
  for (int j = 0; j < n; ++j) {
    pattern_.column_start.push_back(pattern_.non_zeros());
    for (int i = symmetric ? j : 0; i < n; ++i) pattern_.row.push_back(i);
  }
  pattern_.column_start.push_back(pattern_.non_zeros());
  traits_.lumped_mass = mass.isDiagonal();
}

void SmallModel::assemble(double t, const ConstVectorRef& q, const ConstVectorRef& v, TangentKind kind,
                          Linearization& out) const {
  out.stiffness.resize(pattern_.row.size());
  gather(stiffness(t, q, v, kind), out.stiffness.data());
  if (!traits_.damping_matrix) return;
  out.damping.resize(pattern_.row.size());
  gather(damping(q), out.damping.data());
}

void SmallModel::combine(const Weights& w, const Linearization& at, double* values) const {
  gather(w.mass * mass_, values);
  for (std::size_t k = 0; k < at.stiffness.size(); ++k) values[k] += w.stiffness * at.stiffness[k];
  for (std::size_t k = 0; k < at.damping.size(); ++k) values[k] += w.damping * at.damping[k];
}

void SmallModel::multiply_mass(const ConstVectorRef& x, VectorRef y) const { y = mass_ * x; }

void SmallModel::solve_mass(VectorRef x) const { x = mass_.llt().solve(Vector(x)); }

void SmallModel::mean_force(double t0, const ConstVectorRef& q0, double t1, const ConstVectorRef& q1,
                            const ConstVectorRef& v, VectorRef f) const {
  force(0.5 * (t0 + t1), 0.5 * (q0 + q1), v, f);
}

Matrix SmallModel::damping(const Vector&) const { return Matrix::Zero(num_dofs(), num_dofs()); }

void SmallModel::gather(const Matrix& full, double* values) const {
  for (int j = 0; j < pattern_.n; ++j)
    for (int i = pattern_.symmetric ? j : 0; i < pattern_.n; ++i) *values++ = full(i, j);
}

// A fraction of another model's force.
class Share : public SmallModel {
 public:
  Share(const SmallModel& whole, double share)
      : SmallModel(whole.mass_, whole.pattern().symmetric), whole_(whole), share_(share) {
    traits_ = whole.traits();
  }
  void force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const override {
    whole_.force(t, q, v, f);
    f *= share_;
  }
  State initial() const override { return whole_.initial(); }
  double end() const override { return whole_.end(); }

 private:
  Matrix stiffness(double t, const Vector& q, const Vector& v, TangentKind kind) const override {
    return share_ * whole_.stiffness(t, q, v, kind);
  }
  Matrix damping(const Vector& q) const override { return share_ * whole_.damping(q); }

  const SmallModel& whole_;
  double share_;
};

std::unique_ptr<Model> SmallModel::only(const std::vector<std::string>& parts) const {
  return std::make_unique<Share>(*this, 0.5 * static_cast<double>(parts.size()));
}

LinearModel::LinearModel(const Given& given)
    : SmallModel(given.mass, given.stiffness.isApprox(given.stiffness.transpose(), 0)), given_(given) {
  traits_.linear = true;
  traits_.damped = traits_.damping_matrix = given.beta > 0;
  traits_.time_dependent = given.load.size() > 0;
  traits_.conservative = !traits_.damped && !traits_.time_dependent;
  if (!given_.start.size()) given_.start = Vector::Zero(given.mass.rows());
  const auto modes = symmetric_eigenpairs(given.stiffness, given.mass);
  shapes_ = modes.vectors;  // V^T M V = I
  omega_squared_ = modes.values;
}

void LinearModel::force(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  f = -given_.stiffness * (q + given_.beta * v);
  if (given_.load.size()) f += factor(t) * given_.load;
}

std::vector<double> LinearModel::breakpoints(double start, double end) const {
  std::vector<double> times;
  for (const auto& [t, value] : given_.factor)
    if (t > start && t < end) times.push_back(t);
  return times;
}

State LinearModel::initial() const { return {0, given_.start, Vector::Zero(num_dofs())}; }

State LinearModel::exact(double t) const {
  Vector z = shapes_.transpose() * mass_ * given_.start, w = Vector::Zero(num_dofs());
  double from = 0;
  std::vector<double> stops = breakpoints(0, t);
  stops.push_back(t);
  for (const double to : stops) {
    for (int k = 0; k < num_dofs(); ++k) advance_mode(k, from, to, z[k], w[k]);
    from = to;
  }
  return {t, shapes_ * z, shapes_ * w};
}

Matrix LinearModel::damping(const Vector&) const { return given_.beta * given_.stiffness; }

double LinearModel::factor(double t) const {
  const auto& p = given_.factor;
  if (p.empty()) return 1;
  if (t <= p.front()[0]) return p.front()[1];
  for (std::size_t i = 1; i < p.size(); ++i)
    if (t <= p[i][0]) return p[i - 1][1] + (p[i][1] - p[i - 1][1]) * (t - p[i - 1][0]) / (p[i][0] - p[i - 1][0]);
  return p.back()[1];
}

// z'' + 2 d z' + w2 z = a + b (t - from): homogeneous exponentials and a linear particular part.
void LinearModel::advance_mode(int k, double from, double to, double& z, double& rate) const {
  using C = std::complex<double>;
  const double w2 = omega_squared_[k], d = 0.5 * given_.beta * w2, tau = to - from;
  const double push = given_.load.size() ? shapes_.col(k).dot(given_.load) : 0;
  const double slope = (factor(to) - factor(from)) / tau * push, at_start = factor(from) * push;
  const double p1 = slope / w2, p0 = (at_start - 2 * d * p1) / w2;
  const C root = std::sqrt(C(d * d - w2)), l1 = -d + root, l2 = -d - root;
  const C y = z - p0, y_rate = rate - p1;
  const C c1 = (y_rate - l2 * y) / (l1 - l2), c2 = y - c1;
  z = p0 + p1 * tau + (c1 * std::exp(l1 * tau) + c2 * std::exp(l2 * tau)).real();
  rate = p1 + (c1 * l1 * std::exp(l1 * tau) + c2 * l2 * std::exp(l2 * tau)).real();
}

LinearModel harmonic_oscillator() {
  return LinearModel(
      {.mass = scalar(2), .stiffness = scalar(18), .start = Vector::Ones(1), .end = 6, .velocity_scale = 3});
}

LinearModel damped_oscillator() {
  return LinearModel({.mass = scalar(2),
                      .stiffness = scalar(18),
                      .beta = 0.4 / 3,
                      .start = Vector::Ones(1),
                      .end = 4,
                      .velocity_scale = 3});
}

LinearModel stiff_pair() {
  Matrix K(2, 2);
  K << 1 + 1e6, -1e6, -1e6, 1 + 1e6;
  return LinearModel({.mass = Matrix::Identity(2, 2), .stiffness = K, .beta = 0.1, .start = Vector::Ones(2), .end = 6});
}

LinearModel kinked_oscillator() {
  return LinearModel({.mass = scalar(1),
                      .stiffness = scalar(9),
                      .beta = 0.05,
                      .load = Vector::Constant(1, 9),
                      .factor = {{1, 0}, {2, 1}},
                      .end = 4,
                      .velocity_scale = 3});
}

LinearModel bathes_two_masses() {
  const Matrix M = Vector{{2, 1}}.asDiagonal();
  const Matrix K{{6, -2}, {-2, 4}};
  return LinearModel({.mass = M, .stiffness = K, .load = Vector{{0, 10}}, .end = 3.36, .velocity_scale = 5});
}

LinearModel fast_ringing() {
  const Matrix K = Vector{{1, 10'100}}.asDiagonal();
  return LinearModel(
      {.mass = Matrix::Identity(2, 2), .stiffness = K, .beta = 20.0 / 10'100, .start = Vector{{1, 0.01}}, .end = 3});
}

LinearModel chain(bool consistent) {
  const int n = 8;
  Matrix K = Matrix::Zero(n, n), M = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = 2;
    M(i, i) = consistent ? 4.0 / 6 : 1;
    if (i + 1 == n) continue;
    K(i, i + 1) = K(i + 1, i) = -1;
    if (consistent) M(i, i + 1) = M(i + 1, i) = 1.0 / 6;
  }
  return LinearModel({.mass = M, .stiffness = K, .beta = 0.1, .start = Vector::Unit(n, 0), .end = 8});
}

SpringPendulum::SpringPendulum(const Vector& start, double drag)
    : SmallModel(Matrix::Identity(2, 2)), start_(start), drag_(drag) {
  traits_.damping_matrix = drag > 0;
  traits_.conservative = drag == 0;
}

void SpringPendulum::force(double, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  f = -kStiffness * (1 - 1 / q.norm()) * q - drag_ * v;
  f[1] -= kGravity;
}

void SpringPendulum::mean_force(double, const ConstVectorRef& q0, double, const ConstVectorRef& q1,
                                const ConstVectorRef& v, VectorRef f) const {
  f = -0.5 * kStiffness * (1 - 2 / (q0.norm() + q1.norm())) * (q0 + q1) - drag_ * v;
  f[1] -= kGravity;
}

double SpringPendulum::energy(const State& s) const {
  return 0.5 * s.v.squaredNorm() + 0.5 * kStiffness * std::pow(s.q.norm() - 1, 2) + kGravity * s.q[1];
}

State SpringPendulum::initial() const { return {0, start_, Vector::Zero(2)}; }

Matrix SpringPendulum::stiffness(double, const Vector& q, const Vector&, TangentKind kind) const {
  const Vector n = q.normalized();
  const Matrix along = kStiffness * n * n.transpose();
  if (kind == TangentKind::gauss_newton) return along;
  return along + kStiffness * (1 - 1 / q.norm()) * (Matrix::Identity(2, 2) - n * n.transpose());
}

Matrix SpringPendulum::damping(const Vector&) const { return drag_ * Matrix::Identity(2, 2); }

SpringPendulum pendulum() { return {Vector{{1.001, 0}}, 0}; }

SpringPendulum upright_column() { return {Vector{{0, 0.99}}, 20}; }

namespace {
const Matrix kCirculatory{{4, 1}, {-1, 9}};
}

CirculatoryModel::CirculatoryModel() : SmallModel(Matrix::Identity(2, 2), false) {
  traits_.damping_matrix = traits_.damped = true;
  traits_.conservative = false;
}

void CirculatoryModel::force(double, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef f) const {
  f = -kCirculatory * q - v;
}

State CirculatoryModel::initial() const { return {0, Vector::Unit(2, 0), Vector::Zero(2)}; }

// The stiffness has the eigenvalues 13/2 -+ sqrt(21)/2 with eigenvectors (1, lambda - 4); each mode moves by
// z'' + z' + lambda z = 0, z(0) = 1, z'(0) = 0.
State CirculatoryModel::exact(double t) const {
  const double low = (13 - std::sqrt(21.0)) / 2, high = (13 + std::sqrt(21.0)) / 2;
  State state{t, Vector::Zero(2), Vector::Zero(2)};
  const auto add = [&](double lambda, double other) {
    const double share = (other - 4) / (other - lambda), omega = std::sqrt(lambda - 0.25), decay = std::exp(-t / 2);
    const Vector shape = Vector{{1, lambda - 4}};
    state.q += share * decay * (std::cos(omega * t) + std::sin(omega * t) / (2 * omega)) * shape;
    state.v -= share * decay * lambda / omega * std::sin(omega * t) * shape;
  };
  add(low, high);
  add(high, low);
  return state;
}

Matrix CirculatoryModel::stiffness(double, const Vector&, const Vector&, TangentKind) const { return kCirculatory; }
Matrix CirculatoryModel::damping(const Vector&) const { return Matrix::Identity(2, 2); }

}  // namespace orthodyn
