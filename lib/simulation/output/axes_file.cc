#include "lib/simulation/output/axes_file.h"

#include <fmt/format.h>

#include "lib/simulation/output/frames.h"

namespace orthodyn {

void write_axes(const std::filesystem::path& file, const FemModel& model) {
  const Vector zero = Vector::Zero(model.num_dofs());
  const State rest{0, zero, zero};
  std::vector<VtuField> fields;
  for (const int axis : {1, 2, 3})
    fields.push_back(
        {fmt::format("axis_{}", axis), Location::cell, 3, model.evaluate(fmt::format("material_axis_{}", axis), rest)});
  fields.push_back({"region", Location::cell, 1, model.evaluate("region", rest)});
  write_vtu(file, model.geometry(), fields, &model.parts().mesh);
}

}  // namespace orthodyn
