#include "lib/fem/joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/fem/fem_model.h"

namespace orthodyn {

namespace {

// The spans r and s of an equation, or their changes or rates.
struct Spans {
  Vec3 r, s;
};

// The factors of the spans to the third and the fourth point in s, and their first and second derivatives by time.
struct Turn {
  double third = 1, fourth = 0, third_rate = 0, fourth_rate = 0, third_curvature = 0, fourth_curvature = 0;
};

Turn turn_of(const JointEquation& e, double t) {
  if (e.kind != JointEquation::Kind::turn) return {};
  const double m = e.motor.value(t), rate = e.motor.rate(t), curvature = e.motor.curvature(t);
  const double cos = std::cos(m), sin = std::sin(m);
  return {
      cos, -sin, -sin * rate, -cos * rate, -sin * curvature - cos * rate * rate, -cos * curvature + sin * rate * rate};
}

// The sum of the spans from the second point to the third and the fourth one with these factors.
template <class At>
Vec3 combined(const JointEquation& e, double third, double fourth, At&& at) {
  const Vec3 second = at(e.second);
  if (fourth == 0) return third * (at(e.third) - second);
  return third * (at(e.third) - second) + fourth * (at(e.fourth) - second);
}

struct Rest {
  Vec3 operator()(const JointPoint& point) const { return point.rest; }
};
struct Mean {
  const NodalVector& nodal;
  Vec3 operator()(const JointPoint& point) const { return point.mean(nodal); }
};
struct Place {
  const NodalVector& u;
  Vec3 operator()(const JointPoint& point) const { return point.rest + point.mean(u); }
};

// Of places, rest places, displacements or rates.
template <class At>
Spans spans_of(const JointEquation& e, const Turn& turn, At&& at) {
  return {at(e.first) - at(e.second), combined(e, turn.third, turn.fourth, at)};
}

// What a slide or a stretch subtracts in g, m, and its first and second derivative by time; 0 for other equations.
struct Course {
  double value = 0, rate = 0, curvature = 0;
};

Course course_of(const JointEquation& e, double t) {
  if (e.kind != JointEquation::Kind::slide && e.kind != JointEquation::Kind::stretch) return {};
  const double m = e.motor.value(t), rate = e.motor.rate(t), curvature = e.motor.curvature(t);
  if (e.kind == JointEquation::Kind::slide) return {m, rate, curvature};
  const double twice = e.length();  // the distance at rest, m
  return {m + m * m / twice, rate * (1 + 2 * m / twice), curvature * (1 + 2 * m / twice) + 2 * rate * rate / twice};
}

// The derivatives of constraint k of an equation by the places of its four points.
struct Slopes {
  Vec3 first, second, third, fourth;
};

Slopes slopes(const JointEquation& e, int k, double t, const NodalVector& u) {
  if (e.kind == JointEquation::Kind::coincide) return {Vec3::Unit(k), -Vec3::Unit(k), Vec3::Zero(), Vec3::Zero()};
  const Turn turn = turn_of(e, t);
  const auto [r, s] = spans_of(e, turn, Place{u});
  return {s / e.length(), -(s + (turn.third + turn.fourth) * r) / e.length(), turn.third * r / e.length(),
          turn.fourth * r / e.length()};
}

// Calls visit(point, slope) for the points of an equation.
template <class Visit>
void for_each_point(const JointEquation& e, const Slopes& at, Visit&& visit) {
  visit(e.first, at.first);
  visit(e.second, at.second);
  visit(e.third, at.third);
  visit(e.fourth, at.fourth);
}

// The partial derivative of a driven constraint by time.
double rate_of_motor(const JointEquation& e, double t, const NodalVector& u) {
  if (e.kind != JointEquation::Kind::turn) return -course_of(e, t).rate;
  const Turn turn = turn_of(e, t);
  const Vec3 r = spans_of(e, turn, Place{u}).r;
  return r.dot(combined(e, turn.third_rate, turn.fourth_rate, Place{u})) / e.length();
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
                             : equation.is_driven()                           ? "motor"
                                                                              : "line");
        first += equation.size();
      }
    return "";
  }

  void values(double t, const ConstVectorRef& q, VectorRef g) const override {
    const NodalExpansion nodal(parts_, t, q, Vector::Zero(q.size()));
    for_each([&](const JointEquation& e, Eigen::Index i) {
      const Turn turn = turn_of(e, t);
      const Spans change = spans_of(e, turn, Mean{nodal.u});
      if (e.kind == JointEquation::Kind::coincide) {  // without the digits of the place
        g.segment<3>(i) = change.r;
        return;
      }
      const Spans rest = spans_of(e, turn, Rest{});
      const double change_at_rest = e.kind == JointEquation::Kind::turn ? rest.r.dot(rest.s) : 0;
      g[i] = (change_at_rest + change.r.dot(rest.s + change.s) + rest.r.dot(change.s)) / e.length() -
             course_of(e, t).value;
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
        for_each_point(e, slopes(e, k, t, nodal.u),
                       [&](const JointPoint& point, const Vec3& slope) { add(point, i + k, slope); });
    });
    Eigen::SparseMatrix<double> out(q.size(), size_);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  void rates(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef g_rate) const override {
    const NodalExpansion nodal(parts_, t, q, v);
    for_each([&](const JointEquation& e, Eigen::Index i) {
      const Turn turn = turn_of(e, t);
      const Spans rate = spans_of(e, turn, Mean{nodal.u_rate});
      if (e.kind == JointEquation::Kind::coincide) {
        g_rate.segment<3>(i) = rate.r;
        return;
      }
      const Spans at = spans_of(e, turn, Place{nodal.u});
      g_rate[i] = (rate.r.dot(at.s) + at.r.dot(rate.s)) / e.length();
      if (e.is_driven()) g_rate[i] += rate_of_motor(e, t, nodal.u);
    });
  }

  void curvature(double t, const ConstVectorRef& q, const ConstVectorRef& v, VectorRef c) const override {
    const NodalExpansion nodal(parts_, t, q, v);
    NodalVector a = parts_.moved ? parts_.moved->accelerations(t) : NodalVector(NodalVector::Zero(3, nodal.x.cols()));
    if (parts_.moved) parts_.dofs->ties().place(a);
    for_each([&](const JointEquation& e, Eigen::Index i) {
      const Turn turn = turn_of(e, t);
      const Spans of_supports = spans_of(e, turn, Mean{a});
      if (e.kind == JointEquation::Kind::coincide) {
        c.segment<3>(i) = of_supports.r;
        return;
      }
      const Spans at = spans_of(e, turn, Place{nodal.u}), rate = spans_of(e, turn, Mean{nodal.u_rate});
      const Vec3 s_rate = rate.s + combined(e, turn.third_rate, turn.fourth_rate, Place{nodal.u});
      const Vec3 s_curvature = of_supports.s + 2 * combined(e, turn.third_rate, turn.fourth_rate, Mean{nodal.u_rate}) +
                               combined(e, turn.third_curvature, turn.fourth_curvature, Place{nodal.u});
      c[i] = (2 * rate.r.dot(s_rate) + of_supports.r.dot(at.s) + at.r.dot(s_curvature)) / e.length() -
             course_of(e, t).curvature;
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

NodalVector joint_forces(const FemModel::Parts& parts, const NodalExpansion& nodal, const Vector& lambda) {
  NodalVector f = NodalVector::Zero(3, nodal.u.cols());
  Eigen::Index first = 0;
  for (const Joint& joint : parts.joints)
    for (const JointEquation& e : joint.equations) {
      for (int k = 0; k < e.size(); ++k)
        for_each_point(e, slopes(e, k, nodal.time, nodal.u), [&](const JointPoint& point, const Vec3& slope) {
          for (const auto& [node, weight] : point.weights) f.col(node) -= weight * lambda[first + k] * slope;
        });
      first += e.size();
    }
  return f;
}

namespace {

Vec3 place_of(const JointPoint& point, const NodalVector& u) { return point.rest + point.mean(u); }

}  // namespace

// The third point belongs to the first body in equations of a distance, else to the second one.
JointReaction joint_reaction(const FemModel::Parts& parts, const Joint& joint, const NodalExpansion& nodal,
                             const Vector& lambda) {
  const Vec3 unknown = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  if (lambda.size() == 0) return {unknown, unknown};
  JointReaction sum;
  const Vec3 point = place_of(joint.equations.front().first, nodal.u);
  const auto add = [&](const JointPoint& at, const Vec3& force) {
    sum.force += force;
    sum.torque += (place_of(at, nodal.u) - point).cross(force);
  };
  Eigen::Index first = 0;
  for (const Joint& other : parts.joints)
    for (const JointEquation& e : other.equations) {
      for (int k = 0; k < e.size() && &other == &joint; ++k) {
        const Slopes at = slopes(e, k, nodal.time, nodal.u);
        add(e.first, -lambda[first + k] * at.first);
        if (e.is_of_distance()) add(e.third, -lambda[first + k] * at.third);
      }
      first += e.size();
    }
  return sum;
}

// g = per_coordinate() times the coordinate, and power = lambda dg/dt: see motor_power().
double motor_force(const FemModel::Parts& parts, const Joint& joint, double t, const Vector& lambda) {
  if (lambda.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  double force = 0;
  Eigen::Index first = 0;
  for (const Joint& other : parts.joints)
    for (const JointEquation& e : other.equations) {
      if (&other == &joint && e.is_driven()) force = -lambda[first] * e.per_coordinate(t);
      first += e.size();
    }
  return force;
}

// The forces -G^T lambda have the power -v . G^T lambda, and G v + dg/dt = 0.
double motor_power(const FemModel::Parts& parts, const NodalExpansion& nodal, const Vector& lambda) {
  double power = 0;
  Eigen::Index first = 0;
  for (const Joint& joint : parts.joints)
    for (const JointEquation& e : joint.equations) {
      if (e.is_driven() && lambda.size() > 0) power += lambda[first] * rate_of_motor(e, nodal.time, nodal.u);
      first += e.size();
    }
  return power;
}

double JointEquation::per_coordinate(double t) const {
  if (kind == Kind::turn) return (first.rest - second.rest).norm();
  return kind == Kind::stretch ? 1 + 2 * motor.value(t) / length() : 1;
}

const JointEquation* Joint::motor() const {
  for (const JointEquation& e : equations)
    if (e.is_driven()) return &e;
  return nullptr;
}

bool Joint::bears_torque() const {
  return std::any_of(equations.begin(), equations.end(),
                     [&](const JointEquation& e) { return e.first.rest != equations.front().first.rest; });
}

const JointCoordinate* Joint::turn() const {
  if (angle) return &*angle;
  return coordinate && coordinate->is_angle() ? &*coordinate : nullptr;
}

std::unique_ptr<const Constraints> make_joint_constraints(const FemModel::Parts& parts) {
  if (std::none_of(parts.joints.begin(), parts.joints.end(), [](const Joint& joint) { return joint.holds(); }))
    return nullptr;
  return std::make_unique<JointConstraints>(parts);
}

}  // namespace orthodyn
