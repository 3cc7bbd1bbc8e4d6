#include "tools/orthodyn/draw.h"

#include <fmt/format.h>

#include "lib/study/process.h"
#include "tools/orthodyn/interrupt.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// Installed beside the program, or in the tree that it was built from.
fs::path find_draw() {
  const fs::path installed = fs::read_symlink("/proc/self/exe").parent_path() / ORTHODYN_DRAW_FROM_BIN;
  return fs::exists(installed) ? installed : fs::path(ORTHODYN_DRAW_IN_SOURCE);
}

}  // namespace

void draw_report(const fs::path& folder, bool quiet) {
  const fs::path draw = find_draw(), log = folder / "report.log";
  const std::atomic<bool> never{false};
  const std::atomic<bool>& interrupt = interrupted() ? never : interrupted();  // a second Ctrl-C ends it all
  const bool drawn = fs::exists(draw) &&
                     run_process({draw.string(), "report", folder.string()}, log, {600, 16e9}, interrupt).succeeded();
  if (!drawn)
    fmt::print(stderr, "warning: no report was drawn (see {}); by hand: tools/draw/draw report {}\n", log.string(),
               folder.string());
  else if (!quiet)
    fmt::print("report  {}\n", (folder / "report.html").string());
}

}  // namespace orthodyn
