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
constexpr double kSeconds = 600;
constexpr double kSecondsWhenInterrupted = 3;  // less than the 4 s of interrupt.cc

// Runs the drawing tool; its messages go to `log`. Returns whether it succeeded.
bool draw(std::vector<std::string> arguments, const fs::path& log) {
  if (!fs::exists(draw_tool())) return false;
  const auto command = draw_command();
  arguments.insert(arguments.begin(), command.begin(), command.end());
  const std::atomic<bool> never{false};
  const std::atomic<bool>& interrupt =
      interrupted() ? never : interrupted();  // already interrupted: a second Ctrl-C ends the program
  const double seconds = interrupted() ? kSecondsWhenInterrupted : kSeconds;
  return run_process(arguments, log, {seconds, 16e9}, [&] { return interrupt.load(); }).succeeded();
}

void draw_picture(const std::string& kind, const fs::path& input, const fs::path& picture) {
  const fs::path log = fs::path(picture).replace_extension(".log");
  if (!draw({kind, input.string(), "--out", picture.string()}, log)) {
    fmt::print(stderr, "warning: no picture was drawn (see {}); to draw it by hand: tools/draw/draw {} {}\n",
               log.string(), kind, input.string());
    return;
  }
  fs::remove(log);
  fmt::print("picture {}\n", picture.string());
}

}  // namespace

void draw_report(const fs::path& folder, bool quiet) {
  const fs::path log = folder / "report.log";
  if (draw({"report", folder.string()}, log)) {
    if (!quiet) fmt::print("report  {}\n", (folder / kReport).string());
    return;
  }
  fmt::print(stderr, "warning: no report was drawn (see {}); to draw it by hand: tools/draw/draw report {}\n",
             log.string(), folder.string());
  rename_old_report(folder, quiet);
}

void rename_old_report(const fs::path& folder, bool quiet) {
  std::error_code failed;
  if (!fs::exists(folder / kReport, failed)) return;
  fs::rename(folder / kReport, folder / "report.old.html", failed);
  if (failed) fmt::print(stderr, "warning: {} is outdated: it shows an earlier run\n", (folder / kReport).string());
  else if (!quiet) fmt::print("the report of an earlier run is now {}\n", (folder / "report.old.html").string());
}

void draw_axes(const fs::path& file) { draw_picture("axes", file, fs::path(file).replace_extension(".png")); }

void draw_modes(const fs::path& folder) { draw_picture("modes", folder, folder / "modes.png"); }

}  // namespace orthodyn
