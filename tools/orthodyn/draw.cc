#include "tools/orthodyn/draw.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "lib/study/jobs/process.h"
#include "tools/orthodyn/installed_paths.h"
#include "tools/orthodyn/interrupt.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

constexpr const char* kReport = "report.html";
constexpr double kSeconds = 600, kSecondsWhenInterrupted = 3;  // before the program ends itself (interrupt.cc)

// Whether `draw` with these arguments ended well; its messages go to `log`.
bool draw(std::vector<std::string> arguments, const fs::path& log) {
  if (!fs::exists(draw_tool())) return false;
  const auto command = draw_command();
  arguments.insert(arguments.begin(), command.begin(), command.end());
  const std::atomic<bool> never{false};
  const std::atomic<bool>& interrupt = interrupted() ? never : interrupted();  // a second Ctrl-C ends it all
  const double seconds = interrupted() ? kSecondsWhenInterrupted : kSeconds;
  return run_process(arguments, log, {seconds, 16e9}, [&] { return interrupt.load(); }).succeeded();
}

}  // namespace

void draw_report(const fs::path& folder, bool quiet) {
  const fs::path log = folder / "report.log";
  if (draw({"report", folder.string()}, log)) {
    if (!quiet) fmt::print("report  {}\n", (folder / kReport).string());
    return;
  }
  fmt::print(stderr, "warning: no report was drawn (see {}); by hand: tools/draw/draw report {}\n", log.string(),
             folder.string());
  put_report_aside(folder, quiet);
}

void put_report_aside(const fs::path& folder, bool quiet) {
  std::error_code failed;
  if (!fs::exists(folder / kReport, failed)) return;
  fs::rename(folder / kReport, folder / "report.old.html", failed);
  if (failed) fmt::print(stderr, "warning: {} is of an earlier run\n", (folder / kReport).string());
  else if (!quiet) fmt::print("the report of an earlier run is now {}\n", (folder / "report.old.html").string());
}

void draw_axes(const fs::path& file) {
  const fs::path log = fs::path(file).replace_extension(".log"), picture = fs::path(file).replace_extension(".png");
  if (!draw({"axes", file.string(), "--out", picture.string()}, log)) {
    fmt::print(stderr, "warning: no picture was drawn (see {}); by hand: tools/draw/draw axes {}\n", log.string(),
               file.string());
    return;
  }
  fs::remove(log);
  fmt::print("picture {}\n", picture.string());
}

void draw_modes(const fs::path& folder) {
  const fs::path log = folder / "modes.log", picture = folder / "modes.png";
  if (!draw({"modes", folder.string(), "--out", picture.string()}, log)) {
    fmt::print(stderr, "warning: no picture was drawn (see {}); by hand: tools/draw/draw modes {}\n", log.string(),
               folder.string());
    return;
  }
  fs::remove(log);
  fmt::print("picture {}\n", picture.string());
}

}  // namespace orthodyn
