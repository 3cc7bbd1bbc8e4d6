// A model built from YAML text, with helper functions for tests.
#pragma once

#include <string>

#include "lib/scene/build.h"
#include "tests/material/constants.h"

namespace orthodyn {

// Mesh source `mesh: {type: given}`: the mesh that a test sets here.
Mesh& given_mesh();

struct BuiltTestScene {
  explicit BuiltTestScene(const std::string& yaml);
  explicit BuiltTestScene(const Config& config);

  const FemModel& model() const { return *built.model; }
  const Mesh& mesh() const { return model().parts().mesh; }
  int size() const { return model().num_dofs(); }
  Vector zero() const { return Vector::Zero(size()); }

  Vector force(const Vector& q, const Vector& v, double t = 0) const;
  Vector force(const Vector& q) const { return force(q, zero()); }

  double scalar(const std::string& name, const Vector& q, const Vector& v) const;
  double potential(const Vector& q) const;

  // w_m M + w_d D + w_k K as a full matrix.
  Eigen::MatrixXd matrix(const Weights& w, const Vector& q, const Vector& v,
                         TangentKind kind = TangentKind::exact) const;
  Eigen::MatrixXd stiffness(const Vector& q) const { return matrix({0, 0, 1}, q, zero()); }
  Eigen::MatrixXd mass() const { return matrix({1, 0, 0}, zero(), zero()); }

  // The free coordinates of a displacement given at the nodes of the rest shape.
  template <class Displacement>
  Vector dofs(Displacement&& u) const {
    NodalVector nodal(3, model().parts().rest->cols());
    for (Eigen::Index i = 0; i < nodal.cols(); ++i) nodal.col(i) = u(Vec3(model().parts().rest->col(i)));
    Vector q(size());
    model().parts().dofs->restrict_to(nodal, q);
    return q;
  }
  NodalVector nodal(const Vector& q) const;
  NodalVector positions(const Vector& q) const { return *model().parts().rest + nodal(q); }

  Scene scene;
  BuiltScene built;
};

// The free coordinates of the equilibrium under the loads at t = 0, linearised about rest.
Vector linear_static(const BuiltTestScene& s);

Vector random_dofs(Random& random, Eigen::Index n, double amplitude);

// Axes turned by -0.7 rad about (1, 2, 3).
inline const std::string kTurnedAxes =
    "{first: [0.781639, 0.550117, -0.293958], second: [-0.482929, 0.832030, 0.272956]}";

std::string fibre_material(double ratio, double density = 1);

std::string anisotropic_material(const Mat6& C, double density = 1);

// The fibre material above as 21 constants in axes in which the fibre's axes are A.
std::string turned_fibre_material(double ratio, const Mat3& A, double density = 1);

}  // namespace orthodyn
