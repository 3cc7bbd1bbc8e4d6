// The drawing tool, which is no part of this program but stands beside it.
#pragma once

#include <filesystem>

namespace orthodyn {

// Has report.html drawn in a comparison's folder, and says where; a warning if that is not possible.
void draw_report(const std::filesystem::path& folder, bool quiet);

// The report of an earlier run would show other results than those beside it: renames it to report.old.html, and says
// so.
void put_report_aside(const std::filesystem::path& folder, bool quiet);

// Has <file>.png drawn beside a file of axes, <file>.vtu, and says where; a warning if that is not possible.
void draw_axes(const std::filesystem::path& file);

// Has modes.png drawn in a folder that `orthodyn modes` wrote, and says where; a warning if that is not possible.
void draw_modes(const std::filesystem::path& folder);

}  // namespace orthodyn
