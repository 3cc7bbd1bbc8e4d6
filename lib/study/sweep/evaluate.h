// One point of a sweep: the figures that are wanted of a scene. What none of them needs is not computed.
#pragma once

#include <filesystem>
#include <optional>

#include "lib/study/compare/point_result.h"
#include "lib/study/sweep/sweep.h"

namespace orthodyn {

// What is to be done in a point's folder.
struct PointJob {
  Named<WantedFigure> figures;
  std::optional<std::string> frame;  // the field that its picture shows
  std::optional<double> frame_at;    // s; default the end
  double seconds = 60;               // limit of the integration
  std::string code;                  // fingerprint of the program that is to do it

  Json json() const;
  static PointJob from(const Json& json);
};

inline constexpr const char* kFrameFile = "frame.vtu";

// Does the job of a folder (measure.h names its files) and leaves result.json there, with the frame if it is wanted.
// What goes wrong in the scene or in the run is a result. Throws RunError if that cannot be written.
void evaluate(const std::filesystem::path& folder);

// {"status", "figures": {name: number or null}, "units": {name: unit}, "cost": {...}, "model": {...}}. Throws
// ConfigError, RunError.
Json evaluate(const Config& scene, const PointJob& job, const std::filesystem::path& folder);

}  // namespace orthodyn
