#include "lib/simulation/preflight/output_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/simulation/output/run_observers.h"

namespace orthodyn {

namespace {

constexpr double kNumber = 4, kIndex = 4;  // bytes of a number and of an index in a frame
constexpr double kColumn = 20;             // bytes of a number in a table
constexpr double kEnergyColumns = 7, kMomentumColumns = 13;
constexpr int kUsualFrames = 50;

// Size of a frame (bytes) with fields and mesh: coordinates, connectivity, offsets, types and regions.
double frame_bytes_of(const FemModel& model, const std::vector<std::string>& fields) {
  const auto& mesh = model.parts().mesh;
  const auto nodes = static_cast<double>(mesh.nodes.size()), cells = static_cast<double>(mesh.cells.size());
  double bytes =
      kNumber * 3 * nodes + kIndex * static_cast<double>(mesh.cells.nodes().size()) + cells * (2 * kIndex + 1);
  for (const auto& info : model.outputs())
    if (std::find(fields.begin(), fields.end(), info.name) != fields.end())
      bytes += kNumber * info.components * (info.location == Location::node ? nodes : cells);
  return bytes;
}

double row_bytes_of(const Setup& setup) {
  const auto& output = setup.scene.output;
  double columns = 1 + 3 * static_cast<double>(probe_columns(setup.scene, *setup.built.model).size());
  if (output.energy) columns += kEnergyColumns;
  if (output.momentum) columns += kMomentumColumns;
  return kColumn * columns;
}

double frames_of(const Scene& scene) {
  if (scene.buckling) return scene.buckling->count;
  if (scene.harmonic) return 0;
  if (scene.is_static()) return fewest_load_steps(*scene.statics);
  const double span = scene.time.end - scene.time.start;
  return scene.output.interval ? std::ceil(span / *scene.output.interval) : scene.output.frames.value_or(kUsualFrames);
}

double rows_of(const Scene& scene, double frames) {
  const auto& history = scene.output.history;
  if (!history || scene.is_static()) return frames;
  const auto apart = history->steps ? scene.integrator->settings().step : history->interval;
  return apart ? std::ceil((scene.time.end - scene.time.start) / *apart) : 0;
}

[[noreturn]] void refuse(const Setup& setup, const char* section, double count, const char* what, double bytes_each,
                         const char* remedy) {
  (setup.config.has(section) && !setup.config.at(section).is_null() ? setup.config.at(section) : setup.config)
      .fail(fmt::format("requests {:.7g} {} ({} of disk): {}; add --yes if intended", count, what,
                        shown_bytes(count * bytes_each), remedy));
}

}  // namespace

double fewest_load_steps(const Statics& statics) {
  const double doubled = std::ceil(std::log2(1 + 1 / statics.first_step));
  return std::min(std::max(std::ceil(1 / statics.max_step), doubled), static_cast<double>(statics.max_steps));
}

std::string shown_bytes(double bytes) {
  for (const auto& [size, unit] : {std::pair{1e12, "TB"}, {1e9, "GB"}, {1e6, "MB"}})
    if (bytes >= size) return fmt::format("{:.3g} {}", bytes / size, unit);
  return fmt::format("{:.3g} kB", bytes / 1e3);
}

OutputSize output_size_of(const Setup& setup) {
  const Scene& scene = setup.scene;
  OutputSize size;
  size.frames = frames_of(scene);
  size.rows = rows_of(scene, size.frames);
  size.frame_bytes = scene.output.fields.empty() ? 0 : frame_bytes_of(*setup.built.model, scene.output.fields);
  size.row_bytes = row_bytes_of(setup);
  if (scene.checkpoint)
    size.checkpoint_bytes = sizeof(double) * (2 * static_cast<double>(setup.built.model->num_dofs_of_all()) +
                                              static_cast<double>(setup.built.initial.z.size()));
  return size;
}

void require_allowed_output_size(const Setup& setup) {
  const OutputSize size = output_size_of(setup);
  if (setup.scene.is_static() && size.frames >= kConfirmationThreshold)
    refuse(setup, "statics", size.frames, "load steps", size.frame_bytes + size.row_bytes,
           "use a larger statics.max_step");
  if (size.frames >= kConfirmationThreshold)
    refuse(setup, "output", size.frames, "frames", size.frame_bytes,
           "use fewer output.frames or a longer output.interval");
  if (size.rows >= kConfirmationThreshold)
    refuse(setup, "output", size.rows, "rows of tables", size.row_bytes,
           setup.scene.output.history && setup.scene.output.history->steps
               ? "use output.history.interval instead of output.history.steps"
               : "use a longer output.history.interval");
}

std::string output_size_error(const Setup& setup) {
  try {
    require_allowed_output_size(setup);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

}  // namespace orthodyn
