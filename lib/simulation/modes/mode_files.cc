#include "lib/simulation/modes/mode_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lib/core/errors.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/output/frames.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

void remove_earlier(const fs::path& folder) {
  std::error_code ec;
  for (const char* name :
       {"modes", "modes.pvd", "modes.png", "modes.log", "modes.csv", "sensitivities.csv", "shape_sensitivities.csv"})
    if (!ec) fs::remove_all(folder / name, ec);
  if (ec) throw RunError(fmt::format("cannot prepare the folder {}: {}", folder.string(), ec.message()));
}

void write_csv(const fs::path& path, const ModalAnalysis& analysis) {
  CsvFile file(path, {"mode", "frequency [Hz]", "angular_frequency [rad/s]", "participation.x [sqrt(kg)]",
                      "participation.y [sqrt(kg)]", "participation.z [sqrt(kg)]", "effective_mass.x [kg]",
                      "effective_mass.y [kg]", "effective_mass.z [kg]", "residual", "mesh_error"});
  file.begin();
  for (std::size_t k = 0; k < analysis.modes().modes.size(); ++k) {
    const Mode& mode = analysis.modes().modes[k];
    const Vec3 &p = mode.participation, m = mode.effective_mass();
    file.row({static_cast<double>(k + 1), mode.frequency(), mode.angular_frequency(), p[0], p[1], p[2], m[0], m[1],
              m[2], mode.residual, analysis.mesh_errors()[k]});
  }
}

// Displacements of all nodes for a small vector of unknowns.
std::vector<double> nodal_displacements(const Model& model, const State& about, const Vector& x) {
  auto moved = model.evaluate("displacement", {about.t, about.q + x, about.v});
  const auto before = model.evaluate("displacement", about);
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= before[i];
  return moved;
}

double largest_displacement(const std::vector<double>& nodal) {
  double largest = 0;
  for (std::size_t i = 0; i < nodal.size(); i += 3)
    largest = std::max(largest, Eigen::Map<const Vec3>(&nodal[i]).norm());
  return largest;
}

}  // namespace

void check_modes_folder(const fs::path& folder, bool replace) {
  std::error_code ec;
  if (!fs::exists(folder, ec)) return;
  if (!fs::is_directory(folder, ec))
    throw ConfigError(folder.string(), "is a file, expected a folder for the results; use --out");
  if (fs::is_empty(folder, ec)) return;
  if (!fs::exists(folder / "modes.csv", ec))
    throw ConfigError(folder.string(), "holds files other than modes; use --out with another folder");
  if (!replace)
    throw ConfigError(folder.string(),
                      "holds earlier modes; use --force to replace them, or --out with another folder");
}

void write_modes(const fs::path& folder, const ModalAnalysis& analysis) {
  remove_earlier(folder);
  write_csv(folder / "modes.csv", analysis);
  std::vector<Vector> shapes;
  for (const Mode& mode : analysis.modes().modes) shapes.push_back(mode.shape);
  write_shapes(folder, analysis.model(), analysis.about(), shapes);
}

void write_shapes(const fs::path& folder, const Model& model, const State& about, const std::vector<Vector>& shapes,
                  const std::vector<std::vector<ShapeField>>& more) {
  PvdFile collection(folder / "modes.pvd");
  collection.begin();
  const Geometry geometry = model.geometry();
  const auto displacement = model.evaluate("displacement", about);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const auto name = fmt::format("modes/mode_{:03}.vtu", k + 1);
    auto shape = nodal_displacements(model, about, shapes[k]);
    const double largest = largest_displacement(shape);
    const auto add = [&](std::vector<VtuField>& fields, const std::string& field, std::vector<double> nodal) {
      for (double& x : nodal) x /= largest;
      fields.push_back({field, Location::node, 3, std::move(nodal)});
    };
    std::vector<VtuField> fields;
    add(fields, "shape", std::move(shape));
    fields.push_back({"displacement", Location::node, 3, displacement});
    if (!more.empty())
      for (const ShapeField& field : more[k]) add(fields, field.name, nodal_displacements(model, about, field.values));
    write_vtu(folder / name, geometry, fields);
    collection.add(static_cast<double>(k + 1), name);
  }
}

}  // namespace orthodyn
