#include "tools/orthodyn/draw.h"

#include <fmt/format.h>

#include "lib/study/process.h"
#include "tools/orthodyn/interrupt.h"
#include "tools/orthodyn/places.h"

namespace orthodyn {

namespace fs = std::filesystem;

void draw_report(const fs::path& folder, bool quiet) {
  const fs::path draw = draw_tool(), log = folder / "report.log";
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
