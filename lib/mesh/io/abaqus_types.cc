#include "lib/mesh/io/abaqus_types.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "lib/core/spelling.h"

namespace orthodyn {
namespace {

// Types with the same nodes that differ in their formulation.
struct SolidFamily {
  AbaqusShape shape;
  std::vector<std::string> types;
};

const std::vector<SolidFamily>& solid_families() {
  static const std::vector<SolidFamily> families{
      {{4, 4, CellKind::tet}, {"C3D4", "C3D4H", "C3D4T", "C3D4P", "C3D4PH", "C3D4PT", "C3D4PHT", "C3D4E"}},
      {{10, 4, CellKind::tet},
       {"C3D10", "C3D10H", "C3D10HS", "C3D10I", "C3D10M", "C3D10MH", "C3D10T", "C3D10HT", "C3D10MT", "C3D10MHT",
        "C3D10P", "C3D10PH", "C3D10MP", "C3D10MPH", "C3D10PT", "C3D10PHT", "C3D10MPT", "C3D10E"}},
      {{8, 8, CellKind::hexahedron}, {"C3D8",   "C3D8H",   "C3D8I",  "C3D8IH",  "C3D8R",   "C3D8RH",   "C3D8S",
                                      "C3D8HS", "C3D8T",   "C3D8HT", "C3D8RT",  "C3D8RHT", "C3D8P",    "C3D8PH",
                                      "C3D8RP", "C3D8RPH", "C3D8PT", "C3D8PHT", "C3D8RPT", "C3D8RPHT", "C3D8E"}},
      {{20, 8, CellKind::hexahedron},
       {"C3D20", "C3D20H", "C3D20R", "C3D20RH", "C3D20T", "C3D20HT", "C3D20RT", "C3D20RHT", "C3D20P", "C3D20PH",
        "C3D20RP", "C3D20RPH", "C3D20E", "C3D20RE"}},
      {{6, 6, CellKind::wedge}, {"C3D6", "C3D6H", "C3D6T", "C3D6HT", "C3D6P", "C3D6PH", "C3D6PT", "C3D6E"}},
      {{27, 8, CellKind::hexahedron}, {"C3D27", "C3D27H", "C3D27R", "C3D27RH"}},
      {{15, 6, CellKind::wedge}, {"C3D15", "C3D15H", "C3D15E"}},
      {{18, 6, CellKind::wedge}, {"C3D15V", "C3D15VH"}},
      {{5, 5, CellKind::pyramid}, {"C3D5", "C3D5H"}}};
  return families;
}

// Whether a face type is `name`, possibly followed by letters.
bool is_face_type(const std::string& type, std::string_view name) {
  return type.starts_with(name) && type.find_first_of("0123456789V", name.size()) == std::string::npos;
}

std::optional<AbaqusShape> face_shape(const std::string& type) {
  static const std::vector<std::pair<std::size_t, std::vector<const char*>>> faces{
      {3, {"CPS3", "CPE3", "CPEG3", "CAX3", "S3", "STRI3", "M3D3", "R3D3", "DS3", "SFM3D3", "DC2D3"}},
      {6, {"CPS6", "CPE6", "CPEG6", "CAX6", "STRI65", "M3D6", "DS6", "SFM3D6", "DC2D6"}},
      {4, {"CPS4", "CPE4", "CPEG4", "CAX4", "S4", "M3D4", "R3D4", "DS4", "SFM3D4", "DC2D4"}},
      {8, {"CPS8", "CPE8", "CPEG8", "CAX8", "S8", "M3D8", "DS8", "SFM3D8", "DC2D8"}}};
  for (const auto& [nodes, names] : faces)
    for (const char* name : names)
      if (is_face_type(type, name)) return AbaqusShape{nodes, nodes % 3 == 0 ? 3u : 4u};
  return std::nullopt;
}

}  // namespace

std::optional<AbaqusShape> abaqus_shape(const std::string& type) {
  for (const SolidFamily& family : solid_families())
    if (std::find(family.types.begin(), family.types.end(), type) != family.types.end()) return family.shape;
  return face_shape(type);
}

std::string abaqus_solids() {
  std::vector<std::string> kinds;
  for (const CellKind kind : {CellKind::tet, CellKind::hexahedron, CellKind::wedge, CellKind::pyramid}) {
    std::vector<std::string> types;
    for (const SolidFamily& family : solid_families())
      if (family.shape.solid == kind) types.insert(types.end(), family.types.begin(), family.types.end());
    kinds.push_back(fmt::format("{} ({})", name_of(kind, 2), join(types)));
  }
  return join(kinds);
}

}  // namespace orthodyn
