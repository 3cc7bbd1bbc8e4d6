// `orthodyn view`: makes an HTML page with a 3D view, by replacing this process with the drawing tool.
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
  std::optional<std::string> every, time, scale, size;  // text: parsed by the drawing tool
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
  if (!fs::exists(draw_tool()))
    throw RunError(draw_tool().string() + ": the drawing tool is missing; install orthodyn with its folder share");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execvp(argv.front(), argv.data());
  throw RunError(fmt::format("{}: {}", words.front(), std::strerror(errno)));
}

void declare(ViewArguments& arguments, CommandOptions& options) {
  options
      .list("result", arguments.results,
            "Result folders of run, modes, sweep, compare or stability. Two are shown side by side; of more, the page "
            "lets you choose.")
      .type("RESULT")
      .required();
  options.value("--out", arguments.out, "HTML file to write; default RESULT/view.html.").type("FILE");
  options.flag("--volume", arguments.volume,
               "Include the interior of the body, for cuts with the clip plane. Makes the page larger.");
  options
      .value("--fields", arguments.fields,
             "Include only these fields, for a smaller page; default: all but material axes.")
      .type("F1,F2,...");
  options.value("--every", arguments.every, "Include every K-th frame and the last one, for a smaller page; default 1.")
      .type("K");
  options.value("--time", arguments.time, "Open the page at the frame nearest to T seconds.").type("T");
  options.value("--color", arguments.color, "Open the page coloured by this field (see `draw frame --help`).")
      .type("FIELD[.COMPONENT]");
  options
      .value("--scale", arguments.scale,
             "Magnify displacements S times; default 1, or more if they are below 2 % of the body's size.")
      .type("S");
  options.value("--png", arguments.png, "Write a picture instead of the page; needs Chromium.").type("FILE");
  options.value("--size", arguments.size, "Size of the picture in pixels; default 1600x1000.")
      .type("WxH")
      .needs("--png");
}

const CommandRegistration view_command(
    {.order = 15,
     .name = "view",
     .sentence = "Make an HTML page with a 3D view of results, one or two side by side.",
     .examples = R"(
  orthodyn view out/cantilever                            out/cantilever/view.html, opens offline
  orthodyn view out/cantilever --volume --time 0.13
  orthodyn view out/comparisons/free_flight               each run beside the reference, with their distance
  orthodyn view out/coarse out/fine --out out/both.html   side by side, one camera
  orthodyn view out/cantilever --png tip.png --color nodal_stress_material.11)"},
    declare, view);

}  // namespace

}  // namespace orthodyn
