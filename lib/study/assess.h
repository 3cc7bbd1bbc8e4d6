// One trial of a matrix of hard cases, in a process of its own.
#pragma once

#include <filesystem>

namespace orthodyn {

// The last state of a trial, in its folder.
inline constexpr const char* kEndState = "end.vtu";

// Runs the scene of a folder and leaves result.json there: {"status": "completed" | "failed" | "refused", "grade",
// "reason", "worst", "time_reached", "wall", "statistics"}; and the last state. Throws RunError if files cannot be
// written.
void assess(const std::filesystem::path& folder);

}  // namespace orthodyn
