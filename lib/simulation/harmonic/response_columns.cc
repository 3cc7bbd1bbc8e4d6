#include "lib/simulation/harmonic/response_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "lib/core/spelling.h"
#include "lib/fem/fem_model.h"
#include "lib/mesh/selection.h"
#include "lib/ode/internal_variables.h"
#include "lib/scene/quantity.h"

namespace orthodyn {

namespace {

const std::vector<std::string> kMotions{"displacement", "velocity", "acceleration"};
const std::vector<std::string> kStresses{"nodal_strain", "nodal_strain_space", "nodal_stress", "nodal_stress_material"};
const std::vector<std::string> kMotionUnits{"m", "m/s", "m/s^2"};

// Index in kMotions, or -1.
int motion_index(const std::string& field) {
  const auto found = std::find(kMotions.begin(), kMotions.end(), field);
  return found == kMotions.end() ? -1 : static_cast<int>(found - kMotions.begin());
}

// The model's output for a field: displacement for velocity and acceleration.
OutputInfo output_of(const FemModel& model, const std::string& field, const SourceLocation& origin) {
  const std::string name = motion_index(field) >= 0 ? "displacement" : field;
  const std::string kind = name.substr(name.rfind('.') + 1);  // "REGION.nodal_stress"
  const auto outputs = model.outputs();
  const auto found = std::find_if(outputs.begin(), outputs.end(), [&](const auto& info) { return info.name == name; });
  const bool is_linear =
      motion_index(field) >= 0 || std::find(kStresses.begin(), kStresses.end(), kind) != kStresses.end();
  if (found != outputs.end() && is_linear) return *found;
  std::vector<std::string> known = kMotions;
  known.insert(known.end(), kStresses.begin(), kStresses.end());
  origin.fail(found == outputs.end()
                  ? fmt::format("unknown field '{}'{}; known: {}", field, did_you_mean(field, known), join(known))
                  : fmt::format("field '{}' has no amplitude in a harmonic analysis, because it is not linear in the "
                                "displacement; choose from {}",
                                field, join(known)));
}

double largest_displacement(const Vector& q) { return q.size() > 0 ? q.lpNorm<Eigen::Infinity>() : 0; }

}  // namespace

std::complex<double> ResponseColumn::amplitude(double frequency, const ComplexVector& coordinates) const {
  const std::complex<double> rate(0, 2 * std::numbers::pi * frequency);
  const auto times = [&](const Vector& values) {
    return std::complex<double>(values.dot(coordinates.real()), values.dot(coordinates.imag()));
  };
  std::complex<double> relative = times(of_basis);
  for (const Relaxing& part : relaxing) relative += rate * part.time / (1.0 + rate * part.time) * times(part.of_basis);
  return std::pow(rate, time_derivative) * relative + base * std::pow(rate, time_derivative - 2);
}

std::vector<ResponseColumn> response_columns(const Scene& scene, const FemModel& model) {
  const Vec3 base = scene.harmonic->base_acceleration.value_or(Vec3::Zero());
  std::vector<ResponseColumn> columns;
  for (const auto& [probe, entry] : scene.output.probes)
    for (const auto& field : entry.fields) {
      const OutputInfo info = output_of(model, field, entry.origin);
      const int motion = motion_index(field);
      if (motion < 0) require_field_at(info.name, entry.node(model.parts().mesh), model, entry.origin);
      const std::string unit = motion < 0 ? info.unit : kMotionUnits[static_cast<std::size_t>(motion)];
      for (int c = 0; c < info.components; ++c)
        columns.push_back({probe,
                           fmt::format("{}.{}.{}", probe, field, info.component_names[static_cast<std::size_t>(c)]),
                           unit == "1" ? "" : unit, std::max(motion, 0), motion >= 0, motion < 0 ? 0 : base[c]});
    }
  for (const auto& [name, gauge] : scene.output.gauges)
    for (const auto& [value, unit] : kGaugeValues)
      columns.push_back({name, name + "." + value, std::string(unit) == "1" ? "" : unit, 0, false});
  return columns;
}

std::size_t find_column(const std::vector<ResponseColumn>& columns, const std::string& quantity,
                        const SourceLocation& origin) {
  std::vector<std::string> names;
  for (const ResponseColumn& column : columns) names.push_back(column.name);
  const auto found = std::find(names.begin(), names.end(), quantity);
  if (found == names.end())
    origin.fail(
        fmt::format("unknown quantity '{}'{}; a harmonic analysis has the components of its probes' fields and the "
                    "values of its gauges: {}",
                    quantity, did_you_mean(quantity, names), join(nearest_names(quantity, names, 5))));
  return static_cast<std::size_t>(found - names.begin());
}

namespace {

// Values of all columns, in their order.
Vector values_at(const Scene& scene, const FemModel& model, const std::vector<PlacedGauge>& gauges,
                 const State& state) {
  const ObservedState observed(model, state);
  std::vector<double> out;
  for (const auto& [probe, entry] : scene.output.probes)
    for (const auto& field : entry.fields) {
      const OutputInfo info = output_of(model, field, entry.origin);
      const auto values = observed.evaluate_at(info.name, entry.node(model.parts().mesh), info.components);
      out.insert(out.end(), values.begin(), values.end());
    }
  for (const PlacedGauge& gauge : gauges)
    for (const double value : gauge.values(observed)) out.push_back(value);
  return Eigen::Map<const Vector>(out.data(), std::ssize(out));
}

// The state `at` with its internal variables: those with the relaxation time `time` have the values of the state
// `about`, all others are at equilibrium.
State unrelaxed(const InternalVariables& internal, State at, const State& about, double time) {
  Vector before(internal.size());
  internal.strains(about.t, about.q, before);
  at.z.resize(internal.size());
  internal.strains(at.t, at.q, at.z);
  at.z = (internal.relaxation_times().array() == time).select(before, at.z);
  return at;
}

}  // namespace

void set_basis(std::vector<ResponseColumn>& columns, const Scene& scene, const FemModel& model, const State& about,
               const Eigen::MatrixXd& basis) {
  constexpr double kStep = 1e-5;  // displacement of the differences, relative to the smallest extent of the body
  const double size = bounding_box(model.parts().mesh).size().minCoeff();
  std::vector<PlacedGauge> gauges;
  for (const auto& [name, gauge] : scene.output.gauges) gauges.emplace_back(gauge, model.parts().mesh);
  const InternalVariables* internal = model.internal_variables();
  std::set<double> times;
  if (internal) times.insert(internal->relaxation_times().begin(), internal->relaxation_times().end());
  for (ResponseColumn& column : columns) {
    column.of_basis = Vector::Zero(basis.cols());
    for (const double time : times) column.relaxing.push_back({time, column.of_basis});
  }
  for (Eigen::Index k = 0; k < basis.cols(); ++k) {
    const double step = kStep * size / largest_displacement(basis.col(k));
    const State after{about.t, about.q + step * basis.col(k), about.v},
        before{about.t, about.q - step * basis.col(k), about.v};
    const auto change = [&](const State& high, const State& low) -> Vector {
      return (values_at(scene, model, gauges, high) - values_at(scene, model, gauges, low)) / (2 * step);
    };
    const Vector relaxed = change(after, before);
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].of_basis[k] = relaxed[static_cast<Eigen::Index>(c)];
    for (std::size_t i = 0; const double time : times) {
      const Vector all =
          change(unrelaxed(*internal, after, about, time), unrelaxed(*internal, before, about, time)) - relaxed;
      for (std::size_t c = 0; c < columns.size(); ++c)
        columns[c].relaxing[i].of_basis[k] = all[static_cast<Eigen::Index>(c)];
      ++i;
    }
  }
}

}  // namespace orthodyn
