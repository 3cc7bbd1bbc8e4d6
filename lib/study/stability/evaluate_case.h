// One run of a matrix of hard cases, in a process of its own.
#pragma once

#include <filesystem>

namespace orthodyn::study::stability {

// The last state of a run, in its folder.
inline constexpr const char* kEndState = "end.vtu";

// Does the job of a folder: runs the scene and grades what it shows (stability_result.h), and leaves the last state.
// Throws as serve_job() does.
void evaluate_case(const std::filesystem::path& folder);

}  // namespace orthodyn::study::stability
