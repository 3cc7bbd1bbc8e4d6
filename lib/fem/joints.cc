#include "lib/fem/joints.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lib/fem/fem_model.h"
#include "lib/ode/constraints_at.h"

namespace orthodyn {

JointPoint joint_point(const Mesh& mesh, const std::vector<int>& nodes, const Vec3& point) {
  constexpr double kRoundOff = 1e-9;
  double size = 0;
  for (const int node : nodes) size = std::max(size, (mesh.node(node) - point).norm());
  if (size == 0) size = 1;
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Eigen::Matrix4Xd A(4, n);  // of the sum and the place, relative to the point and to the size
  for (Eigen::Index i = 0; i < n; ++i) A.col(i) << 1, (mesh.node(nodes[static_cast<std::size_t>(i)]) - point) / size;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least_norm;
  least_norm.setThreshold(kRoundOff);
  least_norm.compute(A);
  const Eigen::Vector4d wanted = Eigen::Vector4d::UnitX();
  const Vector weights = least_norm.solve(wanted);
  JointPoint out{{}, point};
  if ((A * weights - wanted).norm() > kRoundOff) return out;
  for (Eigen::Index i = 0; i < n; ++i) out.weights.emplace_back(nodes[static_cast<std::size_t>(i)], weights[i]);
  return out;
}

namespace {

// The mean of nodal values, such as displacements; zero for a point in space.
Vec3 place(const JointPoint& point, const NodalVector& nodal) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [node, weight] : point.weights) sum += weight * nodal.col(node);
  return sum;
}

// From the second point to the first.
Vec3 span(const JointEquation& e, const NodalVector& u) {
  return e.first.rest - e.second.rest + place(e.first, u) - place(e.second, u);
}

// N; that on the second point is opposite.
Vec3 force_on_first(const JointEquation& e, const NodalVector& u, const Vector& lambda) {
  if (e.kind == JointEquation::Kind::coincide) return -lambda.head<3>();
  return -lambda[0] / e.length() * span(e, u);
}

// The joint that has this constraint.
const Joint& joint_of(const FemModel::Parts& parts, int constraint) {
  int first = 0;
  for (const Joint& joint : parts.joints)
    for (const JointEquation& equation : joint.equations)
      if (first += equation.size(); constraint < first) return joint;
  throw std::logic_error("no such constraint");
}

class JointConstraints final : public Constraints {
 public:
  explicit JointConstraints(const FemModel::Parts& parts) : parts_(parts) {
    for (const Joint& joint : parts.joints)
      for (const JointEquation& equation : joint.equations) size_ += equation.size();
  }

  int size() const override { return size_; }

  std::string name(int constraint) const override {
    int first = 0;
    for (const Joint& joint : parts_.joints)
      for (const JointEquation& equation : joint.equations) {
        if (constraint < first + equation.size())
          return equation.kind == JointEquation::Kind::distance
                     ? fmt::format("joint {}, distance", joint.name)
                     : fmt::format("joint {}, {}", joint.name, "xyz"[constraint - first]);
        first += equation.size();
      }
    return "";
  }

  void values(double t, const ConstVectorRef& q, VectorRef g) const override {
    const NodalExpansion nodal(parts_, t, q, Vector::Zero(q.size()));
    for_each([&](const JointEquation& e, Eigen::Index i) {
      const Vec3 change = place(e.first, nodal.u) - place(e.second, nodal.u), rest = e.first.rest - e.second.rest;
      if (e.kind == JointEquation::Kind::coincide) g.segment<3>(i) = change;  // without the digits of the place
      else g[i] = change.dot(rest + 0.5 * change) / e.length();
    });
  }

  Eigen::SparseMatrix<double> jacobian(double t, const ConstVectorRef& q) const override {
    const NodalExpansion nodal(parts_, t, q, Vector::Zero(q.size()));
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](const JointPoint& point, double sign, Eigen::Index column, const Vec3& direction) {
      for (const auto& [node, weight] : point.weights)
        parts_.dofs->ties().for_each_leader(node, [&, of_node = sign * weight](int leader, double share) {
          for (std::size_t c = 0; c < 3; ++c)
            if (const int dof = parts_.dofs->node(leader)[c]; dof >= 0)
              if (const double entry = of_node * share * direction[static_cast<Eigen::Index>(c)]; entry != 0)
                entries.emplace_back(dof, static_cast<int>(column), entry);
        });
    };
    for_each([&](const JointEquation& e, Eigen::Index i) {
      for (int k = 0; k < e.size(); ++k) {
        const Vec3 direction =
            e.kind == JointEquation::Kind::coincide ? Vec3(Vec3::Unit(k)) : Vec3(span(e, nodal.u) / e.length());
        add(e.first, 1, i + k, direction);
        add(e.second, -1, i + k, direction);
      }
    });
    Eigen::SparseMatrix<double> out(q.size(), size_);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  void rates(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef g_rate) const override {
    const NodalExpansion nodal(parts_, t, q, v);
    for_each([&](const JointEquation& e, Eigen::Index i) {
      const Vec3 rate = place(e.first, nodal.u_rate) - place(e.second, nodal.u_rate);
      if (e.kind == JointEquation::Kind::coincide) g_rate.segment<3>(i) = rate;
      else g_rate[i] = rate.dot(span(e, nodal.u)) / e.length();
    });
  }

  void curvature(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef c) const override {
    const NodalExpansion nodal(parts_, t, q, v);
    const NodalVector a =
        parts_.moved ? parts_.moved->accelerations(t) : NodalVector(NodalVector::Zero(3, nodal.x.cols()));
    for_each([&](const JointEquation& e, Eigen::Index i) {
      const Vec3 of_supports = place(e.first, a) - place(e.second, a);
      const Vec3 rate = place(e.first, nodal.u_rate) - place(e.second, nodal.u_rate);
      if (e.kind == JointEquation::Kind::coincide) c.segment<3>(i) = of_supports;
      else c[i] = (rate.squaredNorm() + of_supports.dot(span(e, nodal.u))) / e.length();
    });
  }

 private:
  // visit(equation, index of its first constraint)
  template <class Visit>
  void for_each(Visit&& visit) const {
    Eigen::Index first = 0;
    for (const Joint& joint : parts_.joints)
      for (const JointEquation& equation : joint.equations) {
        visit(equation, first);
        first += equation.size();
      }
  }

  const FemModel::Parts& parts_;
  int size_ = 0;
};

}  // namespace

NodalVector joint_forces(const FemModel::Parts& parts, const NodalVector& u, const Vector& lambda) {
  NodalVector f = NodalVector::Zero(3, u.cols());
  Eigen::Index first = 0;
  for (const Joint& joint : parts.joints)
    for (const JointEquation& e : joint.equations) {
      const Vec3 force = force_on_first(e, u, lambda.segment(first, e.size()));
      for (const auto& [node, weight] : e.first.weights) f.col(node) += weight * force;
      for (const auto& [node, weight] : e.second.weights) f.col(node) -= weight * force;
      first += e.size();
    }
  return f;
}

Vec3 joint_force(const FemModel::Parts& parts, const Joint& joint, const NodalVector& u, const Vector& lambda) {
  if (lambda.size() == 0) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 sum = Vec3::Zero();
  Eigen::Index first = 0;
  for (const Joint& other : parts.joints)
    for (const JointEquation& e : other.equations) {
      if (&other == &joint) sum += force_on_first(e, u, lambda.segment(first, e.size()));
      first += e.size();
    }
  return sum;
}

double start_consistently(const FemModel& model, State& state) {
  const Constraints* constraints = model.constraints();
  if (!constraints) return 0;
  constexpr double kApart = 1e-9, kDependent = 1e-10;  // relative to the body, and of eigenvalues
  const auto fail = [&](Eigen::Index constraint, const std::string& what) {
    const int k = static_cast<int>(constraint);
    throw ConfigError(joint_of(model.parts(), k).place, fmt::format("{} {}", constraints->name(k), what));
  };
  const int m = constraints->size();
  Vector g(m);
  constraints->values(state.t, state.q, g);
  Eigen::Index worst = 0;
  const double extent = bounding_box(model.parts().mesh).size().maxCoeff();
  if (const double apart = g.cwiseAbs().maxCoeff(&worst); apart > kApart * extent)
    fail(worst,
         fmt::format("has points {:.3g} m apart at the start; the initial displacement must keep joints together",
                     apart));
  const ConstraintsAt at(model, state.t, state.q);
  const Eigen::MatrixXd& H = at.matrix();
  const Vector scale = H.diagonal().cwiseSqrt().cwiseInverse();
  for (Eigen::Index k = 0; k < m; ++k)
    if (!std::isfinite(scale[k])) fail(k, "holds nothing that can move: all its nodes are clamped or moved");
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * H * scale.asDiagonal());
  if (eigen.eigenvalues()[0] < kDependent) {
    eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&worst);
    fail(worst, "is already held by the other joints and clamps: remove one of them");
  }
  const Vector before = state.v;
  at.fit(state.v);
  Vector a(state.q.size());
  if (const InternalVariables* internal = model.internal_variables(); internal && state.z.size() > 0)
    internal->force(state.t, state.q, state.v, {InternalState::Kind::given, state.z.data(), 0}, a);
  else model.force(state.t, state.q, state.v, a);
  model.solve_mass(a);
  state.lambda = at.multipliers(state.v, a);
  return (state.v - before).lpNorm<Eigen::Infinity>();
}

std::unique_ptr<const Constraints> make_joint_constraints(const FemModel::Parts& parts) {
  if (parts.joints.empty()) return nullptr;
  return std::make_unique<JointConstraints>(parts);
}

}  // namespace orthodyn
