// A scene from YAML text, built, with what tests ask of its model.
#pragma once

#include <fmt/format.h>

#include <string>

#include "lib/core/registry.h"
#include "lib/mesh/box.h"
#include "lib/scene/build.h"
#include "lib/scene/mesh_source.h"
#include "tests/material/constants.h"

namespace orthodyn {

// `mesh: {type: given}`: the mesh that a test has put here.
inline TetMesh& given_mesh() {
  static TetMesh mesh;
  return mesh;
}
class GivenMesh : public MeshSource {
 public:
  static const Spec<GivenMesh>& spec() {
    static const Spec<GivenMesh> s;
    return s;
  }
  LoadedMesh load() const override { return {given_mesh(), {}}; }
};
inline const bool given_mesh_registered = Registry<MeshSource>::add<GivenMesh>("given", "A test's own mesh.");

struct BuiltTestScene {
  explicit BuiltTestScene(const std::string& yaml)
      : scene(read_scene(Config::from_text(yaml))), built(build(scene)) {}

  const FemModel& model() const { return *built.model; }
  const TetMesh& mesh() const { return model().parts().mesh; }
  int size() const { return model().num_dofs(); }
  Vector zero() const { return Vector::Zero(size()); }

  Vector force(const Vector& q, const Vector& v, double t = 0) const {
    Vector f(size());
    model().force(t, q, v, f);
    return f;
  }
  Vector force(const Vector& q) const { return force(q, zero()); }

  double scalar(const std::string& name, const Vector& q, const Vector& v) const {
    return model().evaluate(name, {0, q, v})[0];
  }
  double potential(const Vector& q) const {
    return scalar("energy.elastic", q, zero()) + scalar("energy.gravitational", q, zero());
  }

  // w_m M + w_d D + w_k K as a full matrix.
  Eigen::MatrixXd matrix(const Weights& w, const Vector& q, const Vector& v,
                         TangentKind kind = TangentKind::exact) const {
    Linearization at;
    model().linearize(0, q, v, kind, at);
    std::vector<double> values(model().pattern().row.size());
    model().combine(w, at, values.data());
    const Eigen::MatrixXd stored = model().pattern().matrix(values.data());
    if (!model().pattern().symmetric) return stored;
    return stored.selfadjointView<Eigen::Lower>();
  }
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
  NodalVector nodal(const Vector& q) const {
    NodalVector u = NodalVector::Zero(3, model().parts().rest->cols());
    model().parts().dofs->add_to(q, u);
    return u;
  }
  NodalVector positions(const Vector& q) const { return *model().parts().rest + nodal(q); }

  Scene scene;
  BuiltScene built;
};

inline Vector random_dofs(Random& random, Eigen::Index n, double amplitude) {
  return Vector::NullaryExpr(n, [&] { return random.between(-amplitude, amplitude); });
}

// Axes turned by -0.7 rad about (1, 2, 3).
inline const std::string kTurnedAxes =
    "{first: [0.781639, 0.550117, -0.293958], second: [-0.482929, 0.832030, 0.272956]}";

inline std::string fibre_material(double ratio, double density = 1) {
  return "{type: orthotropic_stable, density: " + std::to_string(density) + ", young: [" + std::to_string(ratio) +
         ", 1, 1], nu: 0.3}";
}

inline std::string anisotropic_material(const Mat6& C, double density = 1) {
  std::string yaml = fmt::format("{{type: anisotropic, density: {}, voigt_order: 11-22-33-12-23-31", density);
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) yaml += fmt::format(", c{}{}: {}", i + 1, j + 1, C(i, j));
  return yaml + "}";
}

// The fibre material above as 21 constants in axes of which A are the fibre's.
inline std::string turned_fibre_material(double ratio, const Mat3& A, double density = 1) {
  const Mat6 K = stress_rotation(A);
  return anisotropic_material(K * voigt(stiffness(stable_family({ratio, 1, 1}, 0.3))) * K.transpose(), density);
}

}  // namespace orthodyn
