#include "lib/study/fit/field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lib/scene/build.h"
#include "lib/scene/elastic_parts.h"
#include "lib/simulation/sensitivity/scene_parameter.h"

namespace orthodyn::study::fit {

namespace {

constexpr std::string_view kBegin = "regions.", kEnd = ".stiffness_factors";

std::string region_of(const std::string& path) {
  return path.substr(kBegin.size(), path.size() - kBegin.size() - kEnd.size());
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> ParameterField::neighbours() const {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t cell = 0; cell < size(); ++cell)
    for (const int other : factors.neighbours(static_cast<int>(cell)))
      pairs.emplace_back(first + cell, first + static_cast<std::size_t>(other));
  return pairs;
}

bool is_field(const std::string& path, const Config& scene) {
  return path.starts_with(kBegin) && path.ends_with(kEnd) && has_value_at(scene, path) &&
         value_at(scene, path).is_map();
}

void fill_values(const std::string& path, Config& scene) {
  const Config section = value_at(scene, path);
  if (section.has("file"))
    section.at("file").fail("factors from a file cannot be fitted; give 'grid', and 'values' if the start is not 1");
  if (section.has("values")) return;
  const std::size_t cells = StiffnessFactors::spec().read(section.resolving()).all().size();
  scene.set_yaml(path + ".values", fmt::format("[{}]", fmt::join(std::vector<int>(cells, 1), ", ")),
                 path + ".values of the fit");
}

ParameterField read_field(const std::string& path, const Config& scene) {
  const Scene read = read_scene(scene);
  const BuiltScene built = build(read);
  ParameterField out;
  out.path = path;
  const std::string name = region_of(path);
  for (const auto& [region, entry] : read.regions)
    if (region == name) out.factors = *entry.stiffness_factors;
  out.box = grid_box(read, name, built.model->parts().mesh);
  return out;
}

}  // namespace orthodyn::study::fit
