#include "tests/fem/built_scene.h"

#include <fmt/format.h>

#include "lib/config/registry.h"
#include "lib/core/errors.h"
#include "lib/linear/solver.h"
#include "lib/mesh/mesh_source.h"

namespace orthodyn {
namespace {

class GivenMesh : public MeshSource {
 public:
  static const Spec<GivenMesh>& spec() {
    static const Spec<GivenMesh> s;
    return s;
  }
  LoadedMesh load() const override { return {given_mesh(), {}}; }
};

const bool built_scene_registered = Registry<MeshSource>::add<GivenMesh>("given", "A test's own mesh.");

}  // namespace

Mesh& given_mesh() {
  static Mesh mesh;
  return mesh;
}

BuiltTestScene::BuiltTestScene(const std::string& yaml) : BuiltTestScene(Config::from_text(yaml)) {}

BuiltTestScene::BuiltTestScene(const Config& config) : scene(read_scene(config)), built(build(scene)) {}

Vector BuiltTestScene::force(const Vector& q, const Vector& v, double t) const {
  Vector f(size());
  model().force(t, q, v, f);
  return f;
}

double BuiltTestScene::scalar(const std::string& name, const Vector& q, const Vector& v) const {
  return model().evaluate(name, {0, q, v})[0];
}

double BuiltTestScene::potential(const Vector& q) const {
  return scalar("energy.elastic", q, zero()) + scalar("energy.gravitational", q, zero());
}

Eigen::MatrixXd BuiltTestScene::matrix(const Weights& w, const Vector& q, const Vector& v, TangentKind kind) const {
  Linearization at;
  model().linearize(0, q, v, kind, at);
  std::vector<double> values(model().pattern().row.size());
  model().combine(w, at, values.data());
  const Eigen::MatrixXd stored = model().pattern().matrix(values.data());
  if (!model().pattern().symmetric) return stored;
  return stored.selfadjointView<Eigen::Lower>();
}

Vector linear_static(const BuiltTestScene& s) {
  Linearization at;
  s.model().linearize(0, s.zero(), s.zero(), TangentKind::exact, at);
  const auto solver = make_linear_solver("cholesky");
  solver->analyze(s.model().pattern());
  if (solver->factor(at.stiffness.data()) != FactorStatus::ok) throw RunError("the stiffness is singular");
  Vector u(s.size());
  solver->solve(s.force(s.zero()), u);
  return u;
}

NodalVector BuiltTestScene::nodal(const Vector& q) const {
  NodalVector u = NodalVector::Zero(3, model().parts().rest->cols());
  model().parts().dofs->add_to(q, u);
  return u;
}

Vector random_dofs(Random& random, Eigen::Index n, double amplitude) {
  return Vector::NullaryExpr(n, [&] { return random.between(-amplitude, amplitude); });
}

std::string fibre_material(double ratio, double density) {
  return "{type: orthotropic_stable, density: " + std::to_string(density) + ", young: [" + std::to_string(ratio) +
         ", 1, 1], nu: 0.3}";
}

std::string anisotropic_material(const Mat6& C, double density) {
  std::string yaml = fmt::format("{{type: anisotropic, density: {}, voigt_order: 11-22-33-12-23-31", density);
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) yaml += fmt::format(", c{}{}: {}", i + 1, j + 1, C(i, j));
  return yaml + "}";
}

std::string turned_fibre_material(double ratio, const Mat3& A, double density) {
  const Mat6 K = stress_rotation(A);
  return anisotropic_material(K * voigt(stiffness(stable_family({ratio, 1, 1}, 0.3))) * K.transpose(), density);
}

}  // namespace orthodyn
