// One trial of a matrix of hard cases, in a process of its own.
#pragma once

#include <filesystem>

namespace orthodyn {

// The last state of a trial, in its folder.
inline constexpr const char* kEndState = "end.vtu";

// Runs the scene of a folder and leaves result.json there: {"status": "completed" | "failed", "grade", "reason",
// "worst", "time_reached" [s], "wall" [s], "cpu" [s], "statistics", "at"}, or what do_job() leaves of a run without a
// grade; and the last state. Throws as do_job() does.
void assess(const std::filesystem::path& folder);

}  // namespace orthodyn
