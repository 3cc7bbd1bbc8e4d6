#include "lib/scene/initial.h"

#include <random>

#include "lib/fem/fem_model.h"
#include "lib/ode/internal_variables.h"

namespace orthodyn {

const Spec<Noise>& Noise::spec() {
  static const auto s = Spec<Noise>()
                            .key("amplitude", &Noise::amplitude, "Largest offset of each free coordinate, uniform.",
                                 {.required = true, .unit = "m", .range = kNonNegative})
                            .key("seed", &Noise::seed, "Seed of the generator.", {.range = kNonNegative});
  return s;
}

const Spec<Initial>& Initial::spec() {
  static const auto s =
      Spec<Initial>()
          .key("velocity", &Initial::velocity, "Rigid velocity.", {.unit = "m/s"})
          .key("spin", &Initial::spin, "Rigid angular velocity about `center`.", {.unit = "rad/s"})
          .key("velocity_field", &Initial::velocity_field,
               "Velocity added to the rigid one: three formulas of the rest position.", {.unit = "m/s"})
          .key("center", &Initial::center, "Centre of spin and deformation; default the centre of mass.", {.unit = "m"})
          .key("deformation_gradient", &Initial::deformation_gradient,
               "Uniform F about `center`; a singular F flattens the body, a negative determinant mirrors it.")
          .key("displacement_field", &Initial::displacement_field,
               "Displacement added to the uniform one: three formulas of the rest position.", {.unit = "m"})
          .key("noise", &Initial::noise, "Random displacements of the free coordinates.");
  return s;
}

namespace {

// Uniform in [-1, 1), identical on all platforms.
double symmetric_uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-52 - 1; }

Vec3 at(const std::array<PointFormula, 3>& field, const Vec3& x) {
  return {field[0].at(x), field[1].at(x), field[2].at(x)};
}

Vec3 center_of_mass(const FemModel::Parts& parts) {
  Vec3 moment = *parts.rest * parts.mass->row_sums();
  if (parts.subdomain) parts.subdomain->ranks().sum({moment.data(), 3});
  return moment / parts.mass->total();
}

// The noise of a node does not depend on the number of ranks.
void add_noise(const Noise& noise, const FemModel::Parts& parts, NodalVector& u) {
  std::mt19937_64 generator(static_cast<std::uint64_t>(noise.seed));
  for (int node = 0; node < static_cast<int>(parts.mesh.nodes.size()); ++node) {
    const int here = parts.subdomain ? parts.subdomain->local(node) : node;
    for (int c = 0; c < 3; ++c) {
      const double offset = noise.amplitude * symmetric_uniform(generator);
      if (here >= 0) u(c, here) += offset;
    }
  }
}

// Velocities of all nodes for a body displaced by u.
NodalVector initial_velocity(const Initial& initial, const FemModel::Parts& parts, const NodalVector& u) {
  const Vec3 center = initial.center.value_or(center_of_mass(parts));
  NodalVector v(3, u.cols());
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const Vec3 arm = parts.rest->col(i) + u.col(i) - center;
    v.col(i) = initial.velocity + initial.spin.cross(arm);
    if (initial.velocity_field) v.col(i) += at(*initial.velocity_field, parts.rest->col(i));
  }
  return v;
}

// The body has rested in its initial shape, before its loads acted, or under them if `is_loaded`: its internal
// variables are at equilibrium. Velocities fit the joints.
State completed(State state, const FemModel& model, bool is_loaded) {
  if (const InternalVariables* internal = model.internal_variables()) {
    state.z.resize(internal->size());
    if (is_loaded) internal->strains(state.t, state.q, state.z);
    else internal->total_strains(state.t, state.q, state.z);
  }
  return state;
}

}  // namespace

State initial_state(const std::optional<Initial>& initial, double time, const FemModel& model) {
  const FemModel::Parts& parts = model.parts();
  State state{time, Vector::Zero(model.num_dofs()), Vector::Zero(model.num_dofs())};
  if (!initial) return completed(std::move(state), model, false);
  const Vec3 center = initial->center.value_or(center_of_mass(parts));
  const Mat3 F = initial->deformation_gradient.value_or(Mat3::Identity());
  NodalVector u = (F - Mat3::Identity()) * (parts.rest->colwise() - center);
  if (initial->displacement_field)
    for (Eigen::Index i = 0; i < u.cols(); ++i) u.col(i) += at(*initial->displacement_field, parts.rest->col(i));
  if (initial->noise) add_noise(*initial->noise, parts, u);
  parts.dofs->restrict_to(u, state.q);
  parts.dofs->restrict_to(initial_velocity(*initial, parts, u), state.v);
  return completed(std::move(state), model, false);
}

State initial_state_at(const Vector& q, const std::optional<Initial>& initial, double time, const FemModel& model) {
  State state{time, q, Vector::Zero(q.size())};
  if (!initial) return completed(std::move(state), model, true);
  const FemModel::Parts& parts = model.parts();
  NodalVector u = NodalVector::Zero(3, parts.rest->cols());
  parts.dofs->add_to(q, u);
  parts.dofs->restrict_to(initial_velocity(*initial, parts, u), state.v);
  return completed(std::move(state), model, true);
}

}  // namespace orthodyn
