#include "lib/study/inputs/refined_mesh.h"

#include <fmt/format.h>

namespace orthodyn {

void refine_mesh(Config& scene, int levels) {
  const Config mesh = scene.at("mesh");
  if (mesh.has("cells")) {
    for (std::size_t i = 0; i < mesh.at("cells").size(); ++i)
      scene.set(fmt::format("mesh.cells.{}", i), mesh.at("cells").at(i).integer() * (1L << levels));
  } else if (mesh.has("file")) {
    const long own = mesh.has("refine") ? mesh.at("refine").integer() : 0;
    scene.set("mesh.refine", own + levels);
  } else {
    mesh.fail("has neither 'cells' nor 'file', so it cannot be refined");
  }
}

}  // namespace orthodyn
