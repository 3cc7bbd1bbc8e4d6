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

// The spans r and s of an equation, or their changes or rates.
struct Spans {
  Vec3 r, s;
};

Spans rest_spans(const JointEquation& e) { return {e.first.rest - e.second.rest, e.third.rest - e.second.rest}; }

// From nodal displacements or rates.
Spans changes(const JointEquation& e, const NodalVector& nodal) {
  const Vec3 second = place(e.second, nodal);
  return {place(e.first, nodal) - second, place(e.third, nodal) - second};
}

Spans spans(const JointEquation& e, const NodalVector& u) {
  const Spans rest = rest_spans(e), change = changes(e, u);
  return {rest.r + change.r, rest.s + change.s};
}

// The derivatives of constraint k of an equation by the places of its three points.
struct Slopes {
  Vec3 first, second, third;
};

Slopes slopes(const JointEquation& e, int k, const NodalVector& u) {
  if (e.kind == JointEquation::Kind::coincide) return {Vec3::Unit(k), -Vec3::Unit(k), Vec3::Zero()};
  const auto [r, s] = spans(e, u);
  return {s / e.length(), -(r + s) / e.length(), r / e.length()};
}

// Calls visit(point, slope) for the points of an equation.
template <class Visit>
void for_each_point(const JointEquation& e, const Slopes& at, Visit&& visit) {
  visit(e.first, at.first);
  visit(e.second, at.second);
  visit(e.third, at.third);
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
          return fmt::format("{} {}, {}", joint.of == Joint::Of::bodies ? "joint" : "rigid body", joint.name,
                             equation.kind == JointEquation::Kind::coincide ? std::string(1, "xyz"[constraint - first])
                             : equation.kind == JointEquation::Kind::distance ? "distance"
                                                                              : "line");
        first += equation.size();
      }
    return "";
  }

  void values(double t, const ConstVectorRef& q, VectorRef g) const override {
    const NodalExpansion nodal(parts_, t, q, Vector::Zero(q.size()));
    for_each([&](const JointEquation& e, Eigen::Index i) {
      const Spans rest = rest_spans(e), change = changes(e, nodal.u);
      if (e.kind == JointEquation::Kind::coincide) g.segment<3>(i) = change.r;  // without the digits of the place
      else g[i] = (change.r.dot(rest.s + change.s) + rest.r.dot(change.s)) / e.length();
    });
  }

  Eigen::SparseMatrix<double> jacobian(double t, const ConstVectorRef& q) const override {
    const NodalExpansion nodal(parts_, t, q, Vector::Zero(q.size()));
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](const JointPoint& point, Eigen::Index column, const Vec3& slope) {
      for (const auto& [node, weight] : point.weights)
        parts_.dofs->ties().for_each_leader(node, [&, of_node = weight](int leader, double share) {
          for (std::size_t c = 0; c < 3; ++c)
            if (const int dof = parts_.dofs->node(leader)[c]; dof >= 0)
              if (const double entry = of_node * share * slope[static_cast<Eigen::Index>(c)]; entry != 0)
                entries.emplace_back(dof, static_cast<int>(column), entry);
        });
    };
    for_each([&](const JointEquation& e, Eigen::Index i) {
      for (int k = 0; k < e.size(); ++k)
        for_each_point(e, slopes(e, k, nodal.u),
                       [&](const JointPoint& point, const Vec3& slope) { add(point, i + k, slope); });
    });
    Eigen::SparseMatrix<double> out(q.size(), size_);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  void rates(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef g_rate) const override {
    const NodalExpansion nodal(parts_, t, q, v);
    for_each([&](const JointEquation& e, Eigen::Index i) {
      const Spans at = spans(e, nodal.u), rate = changes(e, nodal.u_rate);
      if (e.kind == JointEquation::Kind::coincide) g_rate.segment<3>(i) = rate.r;
      else g_rate[i] = (rate.r.dot(at.s) + at.r.dot(rate.s)) / e.length();
    });
  }

  void curvature(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef c) const override {
    const NodalExpansion nodal(parts_, t, q, v);
    NodalVector a = parts_.moved ? parts_.moved->accelerations(t) : NodalVector(NodalVector::Zero(3, nodal.x.cols()));
    if (parts_.moved) parts_.dofs->ties().place(a);
    for_each([&](const JointEquation& e, Eigen::Index i) {
      const Spans at = spans(e, nodal.u), rate = changes(e, nodal.u_rate), of_supports = changes(e, a);
      if (e.kind == JointEquation::Kind::coincide) c.segment<3>(i) = of_supports.r;
      else c[i] = (2 * rate.r.dot(rate.s) + of_supports.r.dot(at.s) + at.r.dot(of_supports.s)) / e.length();
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
      for (int k = 0; k < e.size(); ++k)
        for_each_point(e, slopes(e, k, u), [&](const JointPoint& point, const Vec3& slope) {
          for (const auto& [node, weight] : point.weights) f.col(node) -= weight * lambda[first + k] * slope;
        });
      first += e.size();
    }
  return f;
}

// The third point belongs to the first body if the distance is kept, else to the second one.
Vec3 joint_force(const FemModel::Parts& parts, const Joint& joint, const NodalVector& u, const Vector& lambda) {
  if (lambda.size() == 0) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3 sum = Vec3::Zero();
  Eigen::Index first = 0;
  for (const Joint& other : parts.joints)
    for (const JointEquation& e : other.equations) {
      for (int k = 0; k < e.size() && &other == &joint; ++k) {
        const Slopes at = slopes(e, k, u);
        sum -= lambda[first + k] * at.first;
        if (e.kind == JointEquation::Kind::distance) sum -= lambda[first + k] * at.third;
      }
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
    Vector share = eigen.eigenvectors().col(0).cwiseAbs();
    for (Eigen::Index k = 0; k < m; ++k)  // joints are what a user can remove
      if (joint_of(model.parts(), static_cast<int>(k)).of == Joint::Of::rigid_body) share[k] = 0;
    share.maxCoeff(&worst);
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
