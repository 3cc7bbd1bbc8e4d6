#include "lib/simulation/sensitivity/response_sensitivity.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "lib/core/errors.h"
#include "lib/fem/time_functions/time_function.h"
#include "lib/mesh/selection.h"
#include "lib/simulation/harmonic/loss_stiffness.h"
#include "lib/simulation/sensitivity/stiffness_product.h"

namespace orthodyn {

namespace {

using Complex = std::complex<double>;

// A V for a matrix with values on the model's pattern.
Eigen::MatrixXd products(const Model& model, const std::vector<double>& values, const Eigen::MatrixXd& V) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(V.rows(), V.cols());
  if (values.empty()) return out;
  for (Eigen::Index k = 0; k < V.cols(); ++k) {
    Vector product(V.rows());
    model.multiply_matrix(values.data(), V.col(k), product);
    out.col(k) = product;
  }
  return out;
}

std::vector<double> viscous_damping(const Model& model, double t, const Vector& q) {
  Linearization at;
  model.linearize(t, q, Vector::Zero(q.size()), TangentKind::exact, at);
  std::vector<double> values(model.pattern().row.size());
  model.combine({0, 1, 0}, at, values.data());
  return values;
}

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& A) { return (A + A.transpose()) / 2; }

}  // namespace

ResponseSensitivity::ResponseSensitivity(const Config& config, const Setup& setup, const HarmonicResponse& response,
                                         const std::vector<std::size_t>& columns,
                                         const std::vector<SceneParameter>& parameters)
    : setup_(setup), response_(response), system_(response.reduced_system()), outputs_(response.columns().size()) {
  for (const std::size_t column : columns) {
    const Vector q = output(response.columns()[column]);
    system_.include(q.cast<Complex>(), response.range());
  }
  for (const std::size_t column : columns)
    outputs_[column] = system_.basis().transpose() * output(response.columns()[column]);
  for (const SceneParameter& parameter : parameters)
    slopes_.push_back(slopes(ChangedModels(config, *setup.built.model, parameter)));
}

// The unit vector of the free coordinate of a column; zero if it is clamped.
Vector ResponseSensitivity::output(const ResponseColumn& column) const {
  const FemModel& model = *setup_.built.model;
  Vector q = Vector::Zero(model.num_dofs());
  for (const auto& [probe, entry] : setup_.scene.output.probes) {
    if (probe != column.probe) continue;
    const auto component = static_cast<std::size_t>(column.name.back() - 'x');
    const DofMap& dofs = *model.parts().dofs;
    dofs.ties().for_each_leader(entry.node(model.parts().mesh), [&](int leader, double weight) {
      if (const int dof = dofs.node(leader).at(component); dof >= 0) q[dof] += weight;
    });
  }
  return q;
}

// dq/dp of the steady state: K dq/dp = df/dp.
Vector ResponseSensitivity::slope_of_state(const ChangedModels& changed_models) const {
  const State& about = response_.about();
  const FemModel& model = *setup_.built.model;
  Vector slope = Vector::Zero(about.q.size());
  if (about.q.isZero(0)) return slope;  // nothing acts at rest
  const Vector unbalanced = changed_models.derivative([&](const ChangedModels::Changed& changed) {
    Vector force(about.q.size());
    changed.model().force(about.t, about.q, about.v, force);
    return force;
  });
  Linearization at;
  model.linearize(about.t, about.q, about.v, TangentKind::exact, at);
  std::vector<double> values(model.pattern().row.size());
  model.combine({0, 0, 1}, at, values.data());
  const auto solver = make_solver_for(model.pattern());
  if (solver->factor(values.data()) != FactorStatus::ok)
    throw RunError("the stiffness about the steady state is singular, so that its derivative does not exist");
  solver->solve(unbalanced, slope);
  return slope;
}

ResponseSensitivity::Slopes ResponseSensitivity::slopes(const ChangedModels& changed_models) const {
  const State& about = response_.about();
  const Eigen::MatrixXd& V = system_.basis();
  const double small = small_displacement(*setup_.built.model);
  const Vector slope = slope_of_state(changed_models);
  const auto state = [&](const ChangedModels::Changed& changed) -> Vector { return about.q + changed.change * slope; };
  const auto projected = [&](const auto& of) -> Eigen::MatrixXd {
    return symmetric(V.transpose() * changed_models.derivative(of));
  };
  Slopes out;
  out.stiffness = projected([&](const ChangedModels::Changed& changed) {
    Eigen::MatrixXd columns(V.rows(), V.cols());
    for (Eigen::Index k = 0; k < V.cols(); ++k)
      columns.col(k) = stiffness_times(changed.model(), about.t, state(changed), V.col(k), small);
    return columns;
  });
  out.mass = projected([&](const ChangedModels::Changed& changed) {
    Eigen::MatrixXd columns(V.rows(), V.cols());
    for (Eigen::Index k = 0; k < V.cols(); ++k) {
      Vector product(V.rows());
      changed.model().multiply_mass(V.col(k), product);
      columns.col(k) = product;
    }
    return columns;
  });
  out.loss = projected([&](const ChangedModels::Changed& changed) {
    if (about.q.isZero(0)) return loss_products(changed.scene, changed.model(), V, small);
    return products(changed.model(), loss_stiffness(changed.scene, changed.model(), state(changed)), V);
  });
  out.damping = projected([&](const ChangedModels::Changed& changed) {
    return products(changed.model(), viscous_damping(changed.model(), about.t, state(changed)), V);
  });
  // Rigid motions cause no strain; if the geometry changes, strains of first order, whose energy is of second order.
  const int rigid = response_.modes().zeros;
  out.stiffness.topLeftCorner(rigid, rigid).setZero();
  out.loss.topLeftCorner(rigid, rigid).setZero();
  const double ratio_slope = changed_models.derivative(
      [](const ChangedModels::Changed& changed) { return changed.scene.harmonic->damping_ratio; });
  out.damping += slope_of_modal_damping(out, ratio_slope);
  const ComplexVector load = changed_models.derivative([&](const ChangedModels::Changed& changed) {
    return vibrating_load(changed.scene, changed.model(), state(changed));
  });
  out.load.resize(V.cols());
  out.load.real() = V.transpose() * load.real();
  out.load.imag() = V.transpose() * load.imag();
  out.base = changed_models.derivative([&](const ChangedModels::Changed& changed) {
    const auto columns = response_columns(changed.scene, changed.model());
    Vector base(std::ssize(columns));
    for (std::size_t c = 0; c < columns.size(); ++c) base[static_cast<Eigen::Index>(c)] = columns[c].base;
    return base;
  });
  return out;
}

// d/dp of V^T D V with D = M f(M^-1 K), f(lambda) = 2 zeta sqrt(lambda) for the modes and 0 for the further vectors.
Eigen::MatrixXd ResponseSensitivity::slope_of_modal_damping(const Slopes& slopes, double ratio_slope) const {
  const auto modes = std::ssize(response_.modes().modes);
  const Eigen::Index size = system_.basis().cols(), further = size - modes;
  const double ratio = setup_.scene.harmonic->damping_ratio;
  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(size, size);
  Vector lambda = system_.reduced_stiffness().diagonal().cwiseMax(0.0), f = Vector::Zero(size);
  if (further > 0) {  // the eigenvectors of the further vectors, which are orthogonal to the modes
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        system_.reduced_stiffness().bottomRightCorner(further, further));
    turn.bottomRightCorner(further, further) = eigen.eigenvectors();
    lambda.tail(further) = eigen.eigenvalues();
  }
  f.head(modes) = 2 * ratio * lambda.head(modes).cwiseSqrt();
  const Eigen::MatrixXd stiffness = turn.transpose() * slopes.stiffness * turn,
                        mass = turn.transpose() * slopes.mass * turn;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index j = 0; j < size; ++j)
    for (Eigen::Index k = 0; k < size; ++k) {
      double quotient = 0;  // (f_j - f_k) / (lambda_j - lambda_k), or its limit
      const double roots = std::sqrt(lambda[j]) + std::sqrt(lambda[k]);
      if (j < modes && k < modes) quotient = roots > 0 ? 2 * ratio / roots : 0;
      else if (j < modes || k < modes) quotient = (f[j] - f[k]) / (lambda[j] - lambda[k]);
      out(j, k) = mass(j, k) * f[k] + (stiffness(j, k) - lambda[k] * mass(j, k)) * quotient;
    }
  for (Eigen::Index k = 0; k < modes; ++k) out(k, k) += 2 * ratio_slope * std::sqrt(lambda[k]);
  return symmetric(turn * out * turn.transpose());
}

std::vector<Complex> ResponseSensitivity::derivatives(std::size_t column, double frequency) const {
  const double omega = 2 * std::numbers::pi * frequency;
  const ResponseColumn& of = response_.columns()[column];
  const ComplexVector x = system_.coordinates(frequency),
                      w = system_.coordinates(frequency, outputs_[column].cast<Complex>());
  const Complex rate(0, omega);
  std::vector<Complex> out;
  for (const Slopes& slopes : slopes_) {
    const ComplexVector unbalanced = slopes.load - (slopes.stiffness - omega * omega * slopes.mass) * x -
                                     Complex(0, 1) * ((slopes.loss + omega * slopes.damping) * x);
    const Complex product = w.cwiseProduct(unbalanced).sum();  // without conjugation
    out.push_back(std::pow(rate, of.time_derivative) * product +
                  slopes.base[static_cast<Eigen::Index>(column)] * std::pow(rate, of.time_derivative - 2));
  }
  return out;
}

}  // namespace orthodyn
