#include "lib/mesh/io/abaqus_orientations.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace orthodyn {

bool AbaqusOrientationReader::read(const AbaqusKeyword& keyword) {
  if (keyword.name == "ORIENTATION") read_orientation(keyword);
  else if (keyword.name == "DISTRIBUTION") read_distribution(keyword);
  else if (keyword.name == "DISTRIBUTIONTABLE") read_table(keyword);
  else return false;
  return true;
}

// First line: the points a, b and optionally c, their nodes, or the name of a distribution. Optional second line: the
// axis to rotate about, and an angle in degrees or the name of a distribution.
void AbaqusOrientationReader::read_orientation(const AbaqusKeyword& keyword) {
  using System = AbaqusOrientation::System;
  AbaqusOrientation out{
      .name = lines_.name_of(keyword), .placement = scopes_.current().placement, .place = keyword.place};
  static const std::vector<std::string> systems{"RECTANGULAR", "Z RECTANGULAR", "CYLINDRICAL", "SPHERICAL"};
  const auto system = std::find(systems.begin(), systems.end(), lines_.choice(keyword, "SYSTEM", systems));
  out.system = static_cast<System>(system - systems.begin());
  const bool by_nodes = lines_.choice(keyword, "DEFINITION", {"COORDINATES", "NODES"}) == "NODES";
  if (lines_.at_keyword()) lines_.fail("*ORIENTATION without points");
  const auto fields = lines_.data();
  if (by_nodes) {
    for (const std::string_view field : fields) out.nodes.push_back(scopes_.number(field, "a node"));
    check_points(out, fields.size());
  } else if (!fields.empty() && abaqus_is_name(fields[0])) {
    out.distribution = scopes_.current().key(std::string(fields[0]));
  } else {
    check_points(out, fields.size() / 3);
    if (fields.size() % 3 != 0)
      lines_.fail("*ORIENTATION with {} coordinates; expected two points, or three", fields.size());
    for (std::size_t k = 0; k < fields.size(); ++k)
      out.points[k / 3][static_cast<Eigen::Index>(k % 3)] = lines_.real(k, "a coordinate");
  }
  for (Vec3& point : out.points) point = scopes_.current().placement(point);
  if (!lines_.at_keyword()) read_rotation(out);
  lines_.skip_data();
  file_.orientations[scopes_.current().key(out.name)] = std::move(out);
}

void AbaqusOrientationReader::check_points(const AbaqusOrientation& orientation, std::size_t points) const {
  using enum AbaqusOrientation::System;
  const bool may_have_origin = orientation.system == rectangular || orientation.system == z_rectangular;
  if (points == 2 || (points == 3 && may_have_origin)) return;
  lines_.fail(
      "*ORIENTATION with {}; expected two points{}",
      orientation.nodes.empty() ? fmt::format("{} coordinates", lines_.size()) : fmt::format("{} nodes", points),
      may_have_origin ? ", or three" : "");
}

void AbaqusOrientationReader::read_rotation(AbaqusOrientation& out) {
  const auto fields = lines_.data();
  const std::int64_t axis =
      fields.empty() || fields[0].empty() ? 1 : lines_.integer(fields[0], "the axis to rotate about");
  if (axis < 1 || axis > 3) lines_.fail("axis {} of *ORIENTATION; expected 1, 2 or 3", axis);
  out.axis = axis - 1;
  if (fields.size() > 1 && abaqus_is_name(fields[1])) out.angles = scopes_.current().key(std::string(fields[1]));
  else out.degrees = lines_.real(1, "an angle in degrees");
}

void AbaqusOrientationReader::read_table(const AbaqusKeyword& keyword) {
  std::vector<std::string>& labels = tables_[in_capitals(lines_.name_of(keyword))];
  while (!lines_.at_keyword())
    for (const std::string_view field : lines_.data()) labels.push_back(abaqus_word(field));
}

// CalculiX has no tables: its distributions contain axes only.
std::size_t AbaqusOrientationReader::values_per_row(const AbaqusKeyword& keyword) const {
  if (!keyword.has("TABLE")) return 6;
  const auto table = tables_.find(in_capitals(keyword.parameter("TABLE")));
  if (table == tables_.end())
    lines_.fail("*DISTRIBUTION: no *DISTRIBUTION TABLE {}", TextTokens::quoted(keyword.parameter("TABLE")));
  if (table->second == std::vector<std::string>{"COORD3D", "COORD3D"}) return 6;
  return table->second == std::vector<std::string>{"ANGLE"} ? 1 : 0;
}

void AbaqusOrientationReader::read_distribution(const AbaqusKeyword& keyword) {
  AbaqusDistribution out{.name = lines_.name_of(keyword), .place = keyword.place};
  const std::string location = abaqus_word(keyword.parameter("LOCATION"));
  if (location.empty() || location == "ELEMENT") out.count = values_per_row(keyword);
  if (out.count == 0) {
    file_.skipped.try_emplace("*DISTRIBUTION " + TextTokens::quoted(out.name), lines_.place());
    lines_.skip_data();
  }
  while (!lines_.at_keyword()) {
    const auto& fields = lines_.data();
    if (fields.size() > out.count + 1)
      lines_.fail("{} values; a row of distribution {} has {}", fields.size() - 1, TextTokens::quoted(out.name),
                  out.count);
    AbaqusDistribution::Row row;
    for (std::size_t k = 0; k < out.count; ++k) row.values[k] = lines_.real(k + 1, "a value");
    const bool is_default = fields.empty() || fields[0].empty();
    if (!is_default) row.elements = scopes_.member(fields[0]);
    if (is_default) out.default_row = {row};
    else out.rows.push_back(std::move(row));
  }
  file_.distributions[scopes_.current().key(out.name)] = std::move(out);
}

}  // namespace orthodyn
