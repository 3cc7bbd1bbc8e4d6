// Reads the scene named on the command line through the installed library and builds its model.
#include <fmt/format.h>

#include "lib/scene/build.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const auto built = orthodyn::build(orthodyn::read_scene(orthodyn::Config::from_file(argv[1])));
    fmt::print("{}: {} unknowns, {:.6g} kg\n", argv[1], built.model->num_dofs(), built.model->parts().mass->total());
    return built.initial.q.size() == built.model->num_dofs() ? 0 : 1;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return 1;
  }
}
