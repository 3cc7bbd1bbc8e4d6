#include "lib/study/compare/measurement_result.h"

#include <algorithm>

#include "lib/simulation/output/json.h"

namespace orthodyn {

template <>
struct EnumNames<study::compare::MeasurementResult::Kind> {
  using Kind = study::compare::MeasurementResult::Kind;
  static constexpr std::array<std::pair<Kind, const char*>, 2> list{
      {{Kind::exact, "exact"}, {Kind::computed, "computed"}}};
};

}  // namespace orthodyn

namespace orthodyn::study {

template <>
const JsonFields<compare::MeasurementInput> json_fields<compare::MeasurementInput>{
    {"repeats", &compare::MeasurementInput::repeats},
    {"samples", &compare::MeasurementInput::samples},
    {"seconds", &compare::MeasurementInput::seconds},
    {"reference", &compare::MeasurementInput::reference},
    {"keep_trajectory", &compare::MeasurementInput::keep_trajectory},
    {"exact_if_possible", &compare::MeasurementInput::exact_if_possible},
    {"at_probes", &compare::MeasurementInput::at_probes},
    {"quantities", &compare::MeasurementInput::quantities},
    {"code", &compare::MeasurementInput::code}};

template <>
const JsonFields<compare::ModelSize> json_fields<compare::ModelSize>{
    {"unknowns", &compare::ModelSize::unknowns}, {"elements", &compare::ModelSize::elements},
    {"nodes", &compare::ModelSize::nodes},       {"start", &compare::ModelSize::start},
    {"end", &compare::ModelSize::end},           {"order", &compare::ModelSize::order}};

template <>
const JsonFields<compare::Spread> json_fields<compare::Spread>{{"median", &compare::Spread::median, {"median"}},
                                                               {"min", &compare::Spread::min, {"min"}},
                                                               {"max", &compare::Spread::max, {"max"}}};

template <>
const JsonFields<ErrorNorms> json_fields<ErrorNorms>{
    {"final", &ErrorNorms::final, {"final"}}, {"l2", &ErrorNorms::l2, {"l2"}}, {"max", &ErrorNorms::max, {"max"}}};

template <>
const JsonFields<TrajectoryErrors> json_fields<TrajectoryErrors>{
    {"displacement", &TrajectoryErrors::displacement, {"displacement"}},
    {"velocity", &TrajectoryErrors::velocity, {"velocity"}},
    {"probes", &TrajectoryErrors::probes, {"probe"}},
    {"quantities", &TrajectoryErrors::quantities, {""}},
    {"phase", &TrajectoryErrors::phase, {"phase", "rad"}}};

template <>
const JsonFields<TrajectoryScales> json_fields<TrajectoryScales>{
    {"displacement", &TrajectoryScales::displacement},
    {"velocity", &TrajectoryScales::velocity},
    {"probes", &TrajectoryScales::probes},
    {"quantities", &TrajectoryScales::quantities},
    {"dominant_frequency", &TrajectoryScales::dominant_frequency}};

template <>
const JsonFields<compare::Drift> json_fields<compare::Drift>{
    {"energy", &compare::Drift::energy, {"energy"}},
    {"linear_momentum", &compare::Drift::linear_momentum, {"linear_momentum"}},
    {"angular_momentum", &compare::Drift::angular_momentum, {"angular_momentum"}}};

template <>
const JsonFields<compare::EnergyChange> json_fields<compare::EnergyChange>{{"t", &compare::EnergyChange::times},
                                                                           {"energy", &compare::EnergyChange::changes}};

// The members of a result that are not in point_fields().
template <>
const JsonFields<compare::MeasurementResult> json_fields<compare::MeasurementResult>{
    {"model", &compare::MeasurementResult::model},           {"kind", &compare::MeasurementResult::kind},
    {"own_errors", &compare::MeasurementResult::own_errors}, {"mesh_error", &compare::MeasurementResult::mesh_error},
    {"seconds", &compare::MeasurementResult::seconds},       {"scales", &compare::MeasurementResult::scales},
    {"at", &compare::MeasurementResult::at, Empty::omitted}};

namespace compare {

const JsonFields<MeasurementResult>& point_fields() {
  using R = MeasurementResult;
  static const JsonFields<R> fields{{"time_reached", &R::time_reached, {"time_reached", "s"}},
                                    {"repeats", &R::repeats, {"repeats"}},
                                    {"wall", &R::wall, {"wall", "s"}},
                                    {"cpu", &R::cpu, {"cpu", "s"}},
                                    {"statistics", &R::statistics, {""}},
                                    {"peak_memory_bytes", &R::peak_memory, {"peak_memory", "bytes"}},
                                    {"factor_bytes", &R::factor_bytes, {"factor", "bytes"}},
                                    {"errors", &R::errors, {"error"}},
                                    {"drift", &R::drift, {"drift"}},
                                    {"drift_over_time", &R::drift_over_time},
                                    {"smallest_det_f", &R::smallest_det_f, {"smallest_det_f"}},
                                    {"decisions", &R::decisions}};
  return fields;
}

Json to_json(const TrajectoryErrors& errors) { return JsonValue<TrajectoryErrors>::to(errors); }
Json to_json(const TrajectoryScales& scales) { return JsonValue<TrajectoryScales>::to(scales); }
Json to_json(const MeasurementInput& input) { return JsonValue<MeasurementInput>::to(input); }
MeasurementInput measurement_input_from(const Json& json) { return JsonValue<MeasurementInput>::from(json); }

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = values.size();
  const double median = n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
  return {median, values.front(), values.back()};
}

Json to_json(const MeasurementResult& result) {
  Json json = status_json(result.failure);
  point_fields().write(result, json);
  json_fields<MeasurementResult>.write(result, json);
  return json;
}

MeasurementResult measurement_from(const Json& json) {
  MeasurementResult result = json_fields<MeasurementResult>.read(json);
  point_fields().read(json, result);
  result.failure = failure_from(json);
  return result;
}

}  // namespace compare

}  // namespace orthodyn::study
