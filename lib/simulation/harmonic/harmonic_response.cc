#include "lib/simulation/harmonic/harmonic_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <numbers>

#include "lib/analysis/rigid_freedom.h"
#include "lib/core/parallel.h"
#include "lib/simulation/harmonic/loss_stiffness.h"
#include "lib/simulation/statics/static_problem.h"

namespace orthodyn {

namespace {

// The force of the model's loads at one of the times that stand for parts of the amplitude (kRealPart), N.
Vector force_of_loads(const FemModel& model, double part, const Vector& q) {
  Vector force = Vector::Zero(q.size());
  const auto loads = model.load_parts().value();
  if (loads.empty()) return force;
  model.only(loads)->force(part, q, Vector::Zero(q.size()), force);
  return force;
}

// Force of inertia on a body whose supports have the acceleration a: -m a.
Vector force_of_base(const FemModel& model, const Vec3& acceleration) {
  const Vector& masses = model.parts().mass->row_sums();
  const NodalVector forces = -acceleration * masses.transpose();
  Vector out(model.num_dofs());
  model.parts().dofs->restrict_forces_to(forces, out);
  return out;
}

}  // namespace

ComplexVector vibrating_load(const Scene& scene, const FemModel& model, const Vector& q) {
  const Vector steady = force_of_loads(model, kSteadyPart, q);
  ComplexVector out(q.size());
  out.real() = force_of_loads(model, kRealPart, q) - steady;
  out.imag() = force_of_loads(model, kImaginaryPart, q) - steady;
  if (const auto& base = scene.harmonic->base_acceleration) out.real() += force_of_base(model, *base);
  return out;
}

HarmonicResponse::HarmonicResponse(const Setup& setup) : setup_(setup), model_(*setup.built.model) {
  const Harmonic& harmonic = *setup.scene.harmonic;
  columns_ = response_columns(setup.scene, model_);
  about_ = steady_state();
  const ComplexVector force = vibrating_load(setup.scene, model_, about_.q);
  if (force.isZero(0)) setup.config.fail("the loads that vibrate are zero, or act on clamped nodes only");
  if (harmonic.tap_seconds && !force.imag().isZero(1e-9 * force.norm()))
    setup.config.at("harmonic").at("tap_seconds").fail("needs loads with the phase 0 or 180 deg: a tap has no phase");
  modes_ = find_modes();
  response_.emplace(reduced_system());
  if (model_.internal_variables()) response_->include(force, range());  // at resonances with the stiffness there
  for (std::size_t k = 0; k < modes_.modes.size(); ++k)
    resonances_.push_back({response_->frequency(static_cast<int>(k)), response_->loss_factor(static_cast<int>(k))});
  require_damping();
  frequencies_ = frequency_grid(harmonic, resonances_);
  set_basis(columns_, setup.scene, model_, about_, response_->basis());
  amplitudes_.resize(std::ssize(columns_), std::ssize(frequencies_));
  parallel_for(static_cast<int>(frequencies_.size()), [&](int f) {
    const double frequency = frequencies_[static_cast<std::size_t>(f)];
    const ComplexVector y = response_->coordinates(frequency);
    for (std::size_t c = 0; c < columns_.size(); ++c)
      amplitudes_(static_cast<Eigen::Index>(c), f) = columns_[c].amplitude(frequency, y);
  });
}

// Round-off hides low frequencies of slender bodies. Their modes would then count as rigid motions.
Modes HarmonicResponse::find_modes() const {
  const double highest = setup_.scene.harmonic->highest();
  Modes found;
  try {
    found = natural_modes_below(model_, about_, kModesBeyond * highest);
  } catch (const ConfigError& e) {
    if (!e.place().empty()) throw;
    setup_.config.at("harmonic").fail(e.message());
  }
  if (found.zeros > 0 && found.zeros > count_rigid_freedom(model_, about_.t))
    setup_.config.at("harmonic")
        .fail(fmt::format("round-off hides natural frequencies below {:.2g} Hz, because the cells are small for the "
                          "length of the body: "
                          "{} modes cannot be distinguished from rigid motions. Use longer cells, or clamp the body",
                          found.resolution, found.zeros));
  return found;
}

// The equilibrium under the loads that do not vibrate.
State HarmonicResponse::steady_state() {
  const Vector zero = Vector::Zero(model_.num_dofs());
  is_loaded_ = !force_of_loads(model_, kSteadyPart, zero).isZero(0);
  if (!is_loaded_) return {kSteadyPart, unloaded_shape(setup_.scene, setup_.built), zero};
  return {kSteadyPart, equilibrium(setup_.scene, setup_.built), zero};
}

VibrationRange HarmonicResponse::range() const {
  std::vector<double> natural;
  for (std::size_t k = 0; k < modes_.modes.size(); ++k)
    natural.push_back(response_ ? response_->frequency(static_cast<int>(k)) : modes_.modes[k].frequency());
  std::sort(natural.begin(), natural.end());
  const Harmonic& harmonic = *setup_.scene.harmonic;
  return {check_frequencies(frequency_grid(harmonic, {}), natural), harmonic.rtol};
}

FrequencyResponse HarmonicResponse::reduced_system() const {
  return {model_,
          about_,
          modes_,
          vibrating_load(setup_.scene, model_, about_.q),
          VibrationDamping{setup_.scene.harmonic->damping_ratio, loss_stiffness(setup_.scene, model_, about_.q)},
          range()};
}

void HarmonicResponse::require_damping() const {
  for (std::size_t k = 0; k < modes_in_range(); ++k) {
    const auto& [frequency, loss_factor] = resonances_[k];
    // Smaller loss factors are round-off.
    constexpr double kUndamped = 1e-9;
    if (frequency >= setup_.scene.harmonic->lowest() && !(loss_factor > kUndamped))
      setup_.config.at("harmonic")
          .fail(fmt::format(
              "nothing damps mode {} at {:.6g} Hz, so that its amplitude at resonance is infinite: give damping_ratio, "
              "losses of all materials, or the scene's damping",
              k + 1, frequency));
  }
}

std::size_t HarmonicResponse::modes_in_range() const {
  const double highest = setup_.scene.harmonic->highest();
  return static_cast<std::size_t>(std::count_if(resonances_.begin(), resonances_.end(),
                                                [&](const Resonance& one) { return one.frequency <= highest; }));
}

FrequencyErrors HarmonicResponse::mesh_errors() const {
  Modes some = modes_;
  some.modes.resize(modes_in_range());
  some.zeros = std::min(some.zeros, static_cast<int>(some.modes.size()));
  if (some.modes.empty()) return {};
  return frequency_errors_of(setup_.scene, model_, about_, some);
}

std::complex<double> HarmonicResponse::amplitude(std::size_t column, double frequency) const {
  return columns_[column].amplitude(frequency, response_->coordinates(frequency));
}

double HarmonicResponse::impulse_velocity(std::size_t column, std::size_t mode) const {
  if (resonances_[mode].frequency == 0) return 0;
  return columns_[column].of_basis[static_cast<Eigen::Index>(mode)] *
         response_->modal_load(static_cast<int>(mode)).real();
}

HarmonicResponse::Peak HarmonicResponse::peak(std::size_t column) const {
  Eigen::Index largest = 0;
  const double on_grid = amplitudes_.row(static_cast<Eigen::Index>(column)).cwiseAbs().maxCoeff(&largest);
  const auto k = static_cast<std::size_t>(largest);
  double low = frequencies_[k > 0 ? k - 1 : 0], high = frequencies_[std::min(k + 1, frequencies_.size() - 1)];
  constexpr double kNarrow = 1e-6;  // relative width at which the search by golden section ends
  while (high - low > kNarrow * high) {
    const double part = (high - low) * (1 - 1 / std::numbers::phi);
    if (std::abs(amplitude(column, low + part)) < std::abs(amplitude(column, high - part))) low += part;
    else high -= part;
  }
  const double between = std::abs(amplitude(column, (low + high) / 2));
  return between > on_grid ? Peak{(low + high) / 2, between} : Peak{frequencies_[k], on_grid};
}

}  // namespace orthodyn
