// `orthodyn view`: results as a page with a 3D view. The drawing tool takes this process's place.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include "lib/core/errors.h"
#include "tools/orthodyn/command.h"
#include "tools/orthodyn/installed_paths.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

struct ViewArguments {
  std::vector<std::string> results;
  std::optional<std::string> out, fields, color, png;
  std::optional<std::string> every, time, scale, size;  // the drawing tool reads them
  bool volume = false;
};

std::vector<std::string> for_draw(const ViewArguments& arguments) {
  std::vector<std::string> all = draw_command();
  all.push_back("view");
  all.insert(all.end(), arguments.results.begin(), arguments.results.end());
  const auto add = [&](const char* name, const std::optional<std::string>& value) {
    if (value) all.push_back(fmt::format("{}={}", name, *value));
  };
  add("--out", arguments.out);
  add("--fields", arguments.fields);
  add("--every", arguments.every);
  add("--time", arguments.time);
  add("--color", arguments.color);
  add("--scale", arguments.scale);
  add("--png", arguments.png);
  add("--size", arguments.size);
  if (arguments.volume) all.push_back("--volume");
  return all;
}

int view(const ViewArguments& arguments) {
  std::vector<std::string> words = for_draw(arguments);
  if (!fs::exists(draw_tool())) throw RunError(draw_tool().string() + ": the drawing tool is not there");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execvp(argv.front(), argv.data());
  throw RunError(fmt::format("{}: {}", words.front(), std::strerror(errno)));
}

void declare(ViewArguments& arguments, CommandOptions& options) {
  options
      .list("result", arguments.results,
            "Folders that run, modes, sweep, compare or stability wrote. Two are side by side; of more the page offers "
            "all.")
      .type("RESULT")
      .required();
  options.value("--out", arguments.out, "The page; default RESULT/view.html.").type("FILE");
  options.flag("--volume", arguments.volume, "Also what is inside, for the clip plane; a larger page.");
  options.value("--fields", arguments.fields, "These fields only; default all but material axes.").type("F1,F2,...");
  options.value("--every", arguments.every, "Every K-th frame, and the last; default 1.").type("K");
  options.value("--time", arguments.time, "Begins at the frame nearest to T seconds.").type("T");
  options.value("--color", arguments.color, "Begins with this colour, as `draw frame --help` has them.")
      .type("FIELD[.COMPONENT]");
  options
      .value("--scale", arguments.scale,
             "Enlarges deflections S times; default 1, or as much as shows one below 2 % of the body.")
      .type("S");
  options.value("--png", arguments.png, "A still in place of the page; needs Chromium.").type("FILE");
  options.value("--size", arguments.size, "Pixels of the still; default 1600x1000.").type("WxH").needs("--png");
}

const CommandRegistration view_command({.order = 15,
                                        .name = "view",
                                        .sentence = "Results as an HTML page with a 3D view: one, or two side by side.",
                                        .examples = R"(
  orthodyn view out/cantilever                            out/cantilever/view.html, opens offline
  orthodyn view out/cantilever --volume --time 0.13
  orthodyn view out/comparisons/free_flight               each run beside the reference, and how far apart they are
  orthodyn view out/coarse out/fine --out out/both.html   side by side, one camera
  orthodyn view out/cantilever --png tip.png --color nodal_stress_material.11)"},
                                       declare, view);

}  // namespace

}  // namespace orthodyn
