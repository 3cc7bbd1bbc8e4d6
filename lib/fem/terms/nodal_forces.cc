// The term `nodal_forces`: dead forces on nodes from a CSV file, with nodes given by index or position.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "lib/config/csv_table.h"
#include "lib/core/spelling.h"
#include "lib/fem/term_choice.h"
#include "lib/fem/terms/dead_load.h"
#include "lib/mesh/near_nodes.h"
#include "lib/mesh/selection.h"

namespace orthodyn {
namespace {

const std::vector<std::string> kPlace{"x", "y", "z"}, kForce{"fx", "fy", "fz"};

Vec3 vector_at(const CsvTable& table, std::size_t row, const std::vector<std::string>& names) {
  return {table.at(row, table.column(names[0])), table.at(row, table.column(names[1])),
          table.at(row, table.column(names[2]))};
}

class NodalForcesChoice : public TermChoice {
 public:
  static const Spec<NodalForcesChoice>& spec() {
    using N = NodalForcesChoice;
    static const auto s =
        Spec<N>()
            .key("file", &N::file_,
                 "CSV with the columns node,fx,fy,fz (node index from 0, forces in N) or x,y,z,fx,fy,fz (rest position "
                 "of the node in m). The path is relative to the scene.",
                 {.required = true})
            .key("tolerance", &N::tolerance_,
                 "Largest distance from a position x,y,z to its node; default 1e-6 of the mesh's diagonal.",
                 {.unit = "m", .range = kNonNegative})
            .key("factor", &N::factor_, "Factor in time.", {.fallback = "{type: constant}"});
    return s;
  }

  std::unique_ptr<Term> make(const Discretization& body) const override {
    const auto name = "nodal forces of " + std::filesystem::path(file_.path).filename().string();
    NodalForces forces = read(body.mesh);
    std::string amount = counted(static_cast<long>(forces.size()), "node");
    return std::make_unique<DeadLoad>(name, std::move(forces), factor_, std::move(amount));
  }

  const TimeFunction* factor_in_time() const override { return factor_.get(); }
  void declare(Traits& traits) const override { declare_load(*factor_, traits); }

  SourceLocation origin;

 private:
  NodalForces read(const Mesh& mesh) const {
    std::vector<std::string> optional = kPlace;
    optional.insert(optional.begin(), "node");
    const CsvTable table = read_csv(file_, kForce, optional);
    const bool by_place = is_by_place(table);
    const std::optional<NearNodes> near = by_place ? std::optional<NearNodes>(std::in_place, mesh) : std::nullopt;
    const double tolerance = tolerance_.value_or(1e-6 * bounding_box(mesh).diagonal());
    std::map<int, std::size_t> row_of;
    NodalForces forces;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const int node = by_place ? node_near(*near, vector_at(table, row, kPlace), tolerance, mesh, table.where(row))
                                : node_numbered(table, row, mesh);
      const auto [first, is_new] = row_of.emplace(node, row);
      if (!is_new)
        throw ConfigError(table.where(row),
                          fmt::format("node {} already has a row, in line {}", node, table.lines[first->second]));
      forces.emplace_back(node, vector_at(table, row, kForce));
    }
    return forces;
  }

  bool is_by_place(const CsvTable& table) const {
    const auto count = std::count_if(kPlace.begin(), kPlace.end(), [&](const auto& name) { return table.has(name); });
    if (count != (table.has("node") ? 0 : 3))
      throw ConfigError(table.path,
                        "found the columns " + join(table.names, ",") + "; give node,fx,fy,fz or x,y,z,fx,fy,fz");
    if (count == 0 && tolerance_)
      origin.fail("tolerance is used with the columns x,y,z only, but " + table.path + " has node; remove tolerance");
    return count > 0;
  }

  static int node_numbered(const CsvTable& table, std::size_t row, const Mesh& mesh) {
    const int node = table.index(row, "node");
    if (static_cast<std::size_t>(node) >= mesh.nodes.size())
      throw ConfigError(table.where(row),
                        fmt::format("node {} does not exist; the mesh has 0 to {}", node, mesh.nodes.size() - 1));
    return node;
  }

  static int node_near(const NearNodes& near, const Vec3& place, double tolerance, const Mesh& mesh,
                       const std::string& where) {
    if (const auto node = near.within(tolerance, place)) return *node;
    const int nearest = nearest_node(mesh, place);
    const Vec3& there = mesh.nodes[static_cast<std::size_t>(nearest)];
    throw ConfigError(where, fmt::format("no node within {:.3g} m of {}; the nearest is node {} at {}, {:.3g} m away. "
                                         "Correct the position, or give a larger 'tolerance'",
                                         tolerance, Value<Vec3>::yaml(place), nearest, Value<Vec3>::yaml(there),
                                         (there - place).norm()));
  }

  FilePath file_;
  std::optional<double> tolerance_;
  std::shared_ptr<const TimeFunction> factor_;
};

const bool nodal_forces_registered =
    Registry<TermChoice>::add<NodalForcesChoice>("nodal_forces", "Dead forces on nodes from a file.");

}  // namespace
}  // namespace orthodyn
