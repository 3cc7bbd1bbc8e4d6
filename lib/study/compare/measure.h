// Measures one point of a comparison: integrates a scene, timed and undisturbed, then once more with
// everything that looks on.
#pragma once

#include <filesystem>
#include <functional>

#include "lib/config/config.h"
#include "lib/study/compare/point_result.h"

namespace orthodyn {

// The names of the files of a point.
inline constexpr const char* kSceneFile = "scene.yaml";
inline constexpr const char* kJobFile = "job.json";
inline constexpr const char* kResultFile = "result.json";
inline constexpr const char* kTrajectoryFile = "trajectory.bin";

// The work that a folder's job.json asks for, by the program that wrote it. What goes wrong in the scene or in the run
// is a result: {"status": "failed", "reason", "message"}; a ConfigError has the reason "refused". Leaves result.json with
// the time of day, "at". Throws RunError if that cannot be written, or if the program has changed.
void do_job(const std::filesystem::path& folder, const std::function<Json(const Json& job)>& work);

// Does the job of a folder and leaves result.json there, and the trajectory if it is to be kept. What
// goes wrong in the scene or in the run is a result. Throws RunError if that cannot be written.
void measure(const std::filesystem::path& folder);

}  // namespace orthodyn
