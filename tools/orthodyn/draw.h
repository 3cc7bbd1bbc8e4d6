// Runs the drawing tool (tools/draw). If it is missing or fails, a warning says where its messages are.
#pragma once

#include <filesystem>

namespace orthodyn {

// Draws report.html in a study's folder.
void draw_report(const std::filesystem::path& folder, bool quiet);

// Renames report.html of an earlier run, which would not match the new results, to report.old.html.
void rename_old_report(const std::filesystem::path& folder, bool quiet);

// Draws the material axes in `file`, a .vtu, as a .png of the same name.
void draw_axes(const std::filesystem::path& file);

// Draws modes.png in a folder written by `orthodyn modes`.
void draw_modes(const std::filesystem::path& folder);

}  // namespace orthodyn
