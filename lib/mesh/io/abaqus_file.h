// The content of an Abaqus input file (.inp). Names are compared in capitals. Names within an instance get its name as
// a prefix, "PART-1-1.SIDE", as in Abaqus.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lib/mesh/io/abaqus_material.h"
#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// Members of a set: the numbers first, first + step, ..., last, or the members of another set.
struct AbaqusMembers {
  std::int64_t first = 0, last = 0, step = 1;
  std::string set = {};  // in capitals; empty for numbers
  FilePlace place = {};
  bool listed = false;       // listed, not from GENERATE, so that each number must exist
  bool of_elements = false;  // in a node set: the nodes of the elements of `set`
};

struct AbaqusSet {
  std::string name;  // as first spelled
  std::vector<AbaqusMembers> members = {};
  int order = 0;              // larger for sets to which members were added later
  std::string instance = {};  // the instance that contains the set, as spelled; may be empty
  bool of_condition = false;  // created for the nodes that a condition lists
};

struct AbaqusFace {
  static constexpr std::size_t kPositive = 6, kNegative = 7;  // SPOS, SNEG of a shell
  AbaqusMembers elements;
  std::size_t side = 0;  // 0 to 5 for S1 to S6
};

struct AbaqusSurface {
  std::string name;
  std::vector<AbaqusFace> faces = {};
  std::string instance = {};
  bool of_condition = false;  // created for the faces that a *DLOAD lists
};

// Rigid motion x -> R x + t that places an instance.
struct AbaqusPlacement {
  Mat3 R = Mat3::Identity();
  Vec3 t = Vec3::Zero();
  Vec3 operator()(const Vec3& x) const { return R * x + t; }
};

// A data line of *SOLID SECTION, COMPOSITE. Names are in capitals.
struct AbaqusPly {
  double thickness = 0;  // m, or in the proportion to other plies
  std::string material;
  double degrees = 0;            // from the section's axes, about axis 3
  std::string orientation = {};  // replaces `degrees`; "" for none
  FilePlace place = {};
};

// *SOLID SECTION: an element set, and names in capitals ("" for none).
struct AbaqusSection {
  AbaqusMembers elements;
  std::string orientation = {}, material = {};
  std::vector<AbaqusPly> plies = {};  // of a composite; `material` is then empty
  int stack_direction = 3;            // 1, 2 or 3: a natural coordinate of the elements
};

// *ORIENTATION: a coordinate system through the points a, b and c. They are given here, by nodes, or by a distribution.
struct AbaqusOrientation {
  enum class System { rectangular, z_rectangular, cylindrical, spherical };

  std::string name;  // as spelled
  System system = System::rectangular;
  std::array<Vec3, 3> points = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // a, b, c in global coordinates, m
  std::vector<std::int64_t> nodes = {};        // tags of a, b, c, used in place of `points`; may be empty
  std::string distribution = {}, angles = {};  // names of the *DISTRIBUTION of points and of that of angles, or ""
  Eigen::Index axis = 0;                       // index 0 to 2 of the axis about which `degrees` or `angles` rotate
  double degrees = 0;
  AbaqusPlacement placement = {};
  FilePlace place = {};
};

// *DISTRIBUTION by element: six coordinates of the points a and b, or an angle (degrees).
struct AbaqusDistribution {
  struct Row {
    AbaqusMembers elements;
    std::array<double, 6> values = {};
  };
  std::string name;
  std::size_t count = 0;  // values per row: 6 or 1; 0 for a distribution that is skipped
  std::vector<Row> rows = {};
  std::vector<Row> default_row = {};  // at most one: the default row
  FilePlace place = {};
};

// A line of *BOUNDARY, *CLOAD, *DLOAD or *DSLOAD. Lines that list numbers and have the same remaining fields are merged
// into one, with a set or surface created for it ("boundary_1").
struct AbaqusCondition {
  AbaqusKeyword keyword;
  std::size_t step = 0;                  // 0: model data, 1: first step
  std::string target = {};               // key of node_sets, element_sets or surfaces; "" for all
  std::vector<std::string> fields = {};  // after the target
  FilePlace place = {};
};

// *AMPLITUDE: a time factor of conditions. Linear between the points, constant before the first and after the last.
struct AbaqusAmplitude {
  std::string name = {};                           // as spelled
  std::vector<std::array<double, 2>> points = {};  // time (s), factor; times ascend
  std::string problem = {};  // why the points are missing: "SMOOTH of *AMPLITUDE Pulse (line 12) is not read"; or ""
  FilePlace place = {};
};

using AbaqusAmplitudes = std::map<std::string, AbaqusAmplitude>;  // by name in capitals

// *TRANSFORM: local directions of displacements and forces at the nodes of a set.
struct AbaqusTransform {
  std::string set = {};      // key of a node set
  bool is_identity = false;  // the directions are the global ones, to 1e-6 rad
  FilePlace place = {};
};

using AbaqusSets = std::map<std::string, AbaqusSet>;

// Offset of the node and element numbers of an assembly that has instances.
inline constexpr std::int64_t kAbaqusAssembly = 1'000'000'000'000'000;

struct AbaqusFile {
  MeshDraft draft;                                      // nodes, solid elements
  std::vector<FileFace> faces;                          // shells and plane elements: triangles, quadrilaterals
  std::vector<std::vector<std::int64_t>> face_middles;  // mid-edge nodes of each face
  std::vector<FileNodeUse> ignored_elements;            // tags of elements of other types
  AbaqusSets node_sets, element_sets;
  std::map<std::string, AbaqusSurface> surfaces;
  std::vector<AbaqusSection> sections;
  std::map<std::string, AbaqusOrientation> orientations;
  std::map<std::string, AbaqusDistribution> distributions;
  AbaqusMaterials materials;
  std::vector<AbaqusCondition> conditions;
  std::vector<AbaqusKeyword> steps;
  double first_period = 1;  // duration of the first step, s; from its procedure (*STATIC, ...)
  AbaqusAmplitudes amplitudes;
  std::vector<AbaqusTransform> transforms;
  std::map<std::string, FilePlace> skipped;  // by keyword ("*OUTPUT"): where it first occurs
};

// Looks up "PART-1-1.SIDE", then "SIDE"; null if there is neither.
template <class Value>
const Value* find_abaqus(const std::map<std::string, Value>& all, const std::string& name) {
  auto found = all.find(name);
  const std::size_t dot = name.rfind('.');
  if (found == all.end() && dot != std::string::npos) found = all.find(name.substr(dot + 1));
  return found == all.end() ? nullptr : &found->second;
}

// Reads the file and those it includes; `path` is for messages and includes. Throws ConfigError.
AbaqusFile read_abaqus_keywords(const std::string& path, std::string_view text);

}  // namespace orthodyn
