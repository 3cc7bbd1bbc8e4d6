#include "lib/simulation/modes/shape_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "lib/simulation/output/files.h"
#include "lib/simulation/output/frames.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// The shape at all nodes, its largest displacement 1.
std::vector<double> nodal_shape(const Model& model, const State& about, const Vector& shape) {
  auto moved = model.evaluate("displacement", {about.t, about.q + shape, about.v});
  const auto before = model.evaluate("displacement", about);
  double largest = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= before[i];
  for (std::size_t i = 0; i < moved.size(); i += 3)
    largest = std::max(largest, Eigen::Map<const Vec3>(&moved[i]).norm());
  for (double& x : moved) x /= largest;
  return moved;
}

}  // namespace

void write_shapes(const fs::path& folder, const Model& model, const State& about, const std::vector<Vector>& shapes) {
  GrowingFile collection(folder / "modes.pvd",
                         "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n",
                         "</Collection>\n</VTKFile>\n");
  collection.begin();
  const Geometry geometry = model.geometry();
  const auto displacement = model.evaluate("displacement", about);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const auto name = fmt::format("modes/mode_{:03}.vtu", k + 1);
    write_vtu(folder / name, geometry,
              {{"shape", Location::node, 3, nodal_shape(model, about, shapes[k])},
               {"displacement", Location::node, 3, displacement}});
    collection.append(fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", k + 1, name));
  }
}

}  // namespace orthodyn
