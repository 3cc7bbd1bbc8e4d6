// Harmonic analysis of a scene: writes response.csv, the natural modes in the range as modes.csv and modes.pvd, and
// the sounds of taps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <exception>
#include <numbers>
#include <optional>

#include "lib/core/spelling.h"
#include "lib/simulation/harmonic/harmonic_response.h"
#include "lib/simulation/harmonic/tap.h"
#include "lib/simulation/modes/mode_files.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/run/kinematics.h"
#include "lib/simulation/run/model_summary.h"
#include "lib/simulation/run/run_context.h"
#include "lib/simulation/run/run_record.h"
#include "lib/simulation/sensitivity/response_sensitivity.h"

namespace orthodyn {

namespace {

// Materials of the body that have no entry in `losses`, although others have one.
std::vector<std::string> lossless(const Scene& scene) {
  std::vector<std::string> names;
  if (scene.harmonic->losses.empty()) return names;
  for (const auto& [region, entry] : scene.regions)
    for (const std::string& material : entry.materials()) {
      const auto is_it = [&](const auto& other) { return other.first == material; };
      if (std::none_of(scene.harmonic->losses.begin(), scene.harmonic->losses.end(), is_it) &&
          std::find(names.begin(), names.end(), material) == names.end())
        names.push_back(material);
    }
  return names;
}

std::vector<std::string> warnings_of(const HarmonicResponse& response, const FrequencyErrors& errors,
                                     const Setup& setup) {
  const Scene& scene = setup.scene;
  const Mesh& mesh = setup.built.model->parts().mesh;
  std::vector<std::string> all;
  if (const auto names = lossless(scene); !names.empty())
    all.push_back(
        fmt::format("harmonic.losses has no entry for {}: computed without loss. Give `factor: 0` if this is "
                    "intended",
                    join(names)));
  if (response.is_loaded() && has_linear_region(scene))
    all.push_back(
        "the steady loads do not stiffen or soften the body, because kinematics: linear have no stress stiffness; "
        "remove kinematics: linear");
  if (response.is_loaded() && has_unsymmetric_load(scene, mesh))
    all.push_back(
        "a steady load that follows the body makes the stiffness unsymmetric; the vibration is that of its symmetric "
        "part, without flutter");
  for (const std::string& warning : {frequency_warning(errors, mesh.order()), locking_warning(errors.locking_risk)})
    if (!warning.empty()) all.push_back(warning);
  return all;
}

HarmonicResult describe(const HarmonicResponse& response, const Setup& setup) {
  HarmonicResult result{.is_loaded = response.is_loaded(),
                        .frequencies = response.frequencies().size(),
                        .lowest = response.frequencies().front(),
                        .highest = response.frequencies().back(),
                        .basis = response.basis_size(),
                        .error = response.error(),
                        .rtol = setup.scene.harmonic->rtol,
                        .missed = missed_resonances(response.frequencies(), response.resonances())};
  const FrequencyErrors errors = response.mesh_errors();
  result.stagnated = response.end() == FrequencyResponse::End::stagnated;
  result.warnings = warnings_of(response, errors, setup);
  for (std::size_t k = 0; k < response.modes_in_range(); ++k) {
    const Resonance& resonance = response.resonances()[k];
    result.modes.push_back({resonance.frequency, resonance.loss_factor / 2, errors.shares[k]});
  }
  for (std::size_t c = 0; c < response.columns().size(); ++c) {
    const auto [frequency, amplitude] = response.peak(c);
    result.peaks.push_back({response.columns()[c].name, response.columns()[c].unit, frequency, amplitude});
  }
  return result;
}

// Amplitude, and phase in degrees, of each column.
void write_response(const std::filesystem::path& path, const HarmonicResponse& response) {
  std::vector<std::string> header{"frequency [Hz]"};
  for (const ResponseColumn& column : response.columns()) {
    header.push_back(fmt::format("{} [{}]", column.name, column.unit.empty() ? "1" : column.unit));
    header.push_back(column.name + ".phase [deg]");
  }
  CsvFile file(path, header);
  file.begin();
  for (std::size_t f = 0; f < response.frequencies().size(); ++f) {
    std::vector<double> row{response.frequencies()[f]};
    for (const std::complex<double>& x : response.amplitudes().col(static_cast<Eigen::Index>(f))) {
      row.push_back(std::abs(x));
      row.push_back(std::arg(x) * 180 / std::numbers::pi);
    }
    file.row(row);
  }
}

// Columns whose derivatives are computed.
std::vector<std::size_t> sensitive_columns(const std::vector<ResponseColumn>& columns) {
  std::vector<std::size_t> out;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (has_sensitivity(columns[c])) out.push_back(c);
  return out;
}

void require_sensitivities(const Setup& setup) {
  const auto& paths = setup.scene.sensitivities;
  if (paths.empty()) return;
  if (!setup.built.model->traits().smooth)
    paths.origin.fail("are not computed with contact: the force has kinks, at which the response has no derivative");
  if (sensitive_columns(response_columns(setup.scene, *setup.built.model)).empty())
    paths.origin.fail(
        "of a harmonic analysis are those of displacements, velocities and accelerations: give a probe one of these "
        "fields");
}

// For each column, derivatives of its amplitude and of its phase in degrees by each parameter.
void write_sensitivities(const std::filesystem::path& path, const Setup& setup, const HarmonicResponse& response) {
  const Config config = with_chosen_kinematics(setup.config);
  const auto parameters = model_parameters(config, setup.scene.sensitivities, setup.scene.sensitivities.origin);
  const auto columns = sensitive_columns(response.columns());
  const ResponseSensitivity sensitivity(config, setup, response, columns, parameters);
  std::vector<std::string> header{"frequency [Hz]"};
  for (const std::size_t c : columns)
    for (const SceneParameter& parameter : parameters) {
      const ResponseColumn& column = response.columns()[c];
      header.push_back(fmt::format("d {} / d {} [{} / SI unit]", column.name, parameter.path(), column.unit));
      header.push_back(fmt::format("d {}.phase / d {} [deg / SI unit]", column.name, parameter.path()));
    }
  CsvFile file(path, header);
  file.begin();
  for (std::size_t f = 0; f < response.frequencies().size(); ++f) {
    std::vector<double> row{response.frequencies()[f]};
    for (const std::size_t c : columns) {
      const std::complex<double> amplitude =
          response.amplitudes()(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(f));
      for (const std::complex<double>& slope : sensitivity.derivatives(c, response.frequencies()[f])) {
        row.push_back(amplitude_slope(amplitude, slope));
        row.push_back(phase_slope(amplitude, slope) * 180 / std::numbers::pi);
      }
    }
    file.row(row);
  }
}

// Without derivatives, the response is still a result.
void try_to_write_sensitivities(const RunContext& context, const HarmonicResponse& response) {
  if (context.setup.scene.sensitivities.empty()) return;
  try {
    write_sensitivities(context.folder.path() / "sensitivities.csv", context.setup, response);
  } catch (const std::runtime_error& e) {  // ConfigError or RunError
    context.listener.on_warning(fmt::format("the sensitivities could not be computed: {}", e.what()));
  }
}

void write_modes(const std::filesystem::path& folder, const HarmonicResponse& response, const FemModel& model,
                 const HarmonicResult& result) {
  CsvFile file(folder / "modes.csv", {"mode", "frequency [Hz]", "damping_ratio", "mesh_error"});
  file.begin();
  std::vector<Vector> shapes;
  for (std::size_t k = 0; k < result.modes.size(); ++k) {
    const auto& [frequency, damping_ratio, mesh_error] = result.modes[k];
    file.row({static_cast<double>(k + 1), frequency, damping_ratio, mesh_error});
    shapes.push_back(response.modes().modes[k].shape);
  }
  if (!shapes.empty()) write_shapes(folder, model, response.about(), shapes);
}

}  // namespace

RunResult run_harmonic_analysis(RunContext context) {
  const Setup& setup = context.setup;
  require_sensitivities(setup);
  std::optional<HarmonicResponse> response;
  std::exception_ptr input_error;
  RunResult result{.scene = context.scene, .folder = context.folder.path()};
  result.harmonic = HarmonicResult{};
  result.outcome = supervise(setup.built.initial, {}, [&](Outcome&) {
    try {
      response.emplace(setup);
      result.harmonic = describe(*response, setup);
    } catch (const ConfigError&) {
      input_error = std::current_exception();
    }
  });
  if (input_error) std::rethrow_exception(input_error);  // an earlier result stays
  context.folder.prepare();
  const RunRecord record(result.folder, context.scene, context.set, {}, setup.config);
  write_file(result.folder / "scene.yaml", {context.resolved});
  if (result.outcome.status == Outcome::Status::completed) {
    write_response(result.folder / "response.csv", *response);
    if (const auto seconds = setup.scene.harmonic->tap_seconds) write_taps(result.folder, *response, *seconds);
    write_modes(result.folder, *response, *setup.built.model, *result.harmonic);
    try_to_write_sensitivities(context, *response);
  }
  result.model = summarize(setup);
  record.finish(result);
  context.listener.on_result(result);
  return result;
}

}  // namespace orthodyn
