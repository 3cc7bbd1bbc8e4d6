// What an Abaqus input file says of its mesh. Names are compared in capitals; those of an instance begin with its name,
// "PART-1-1.SIDE", as Abaqus itself refers to them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lib/mesh/io/abaqus_amplitude.h"
#include "lib/mesh/io/abaqus_material.h"
#include "lib/mesh/io/abaqus_transform.h"
#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// Numbers first, first + step, ... up to last, or the members of another set.
struct AbaqusMembers {
  std::int64_t first = 0, last = 0, step = 1;
  std::string set = {};  // in capitals; empty for numbers
  FilePlace place = {};
  bool listed = false;       // not by GENERATE: each number must exist
  bool of_elements = false;  // of a node set: the nodes of the elements of `set`
};

struct AbaqusSet {
  std::string name;  // as first spelled
  std::vector<AbaqusMembers> members = {};
  int order = 0;              // of the last line that added to it
  std::string instance = {};  // as spelled, of a set within one
  bool of_condition = false;  // made of the nodes that a condition lists
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
  bool of_condition = false;  // made of the faces that a *DLOAD lists
};

// x -> R x + t, of an instance.
struct AbaqusPlacement {
  Mat3 R = Mat3::Identity();
  Vec3 t = Vec3::Zero();
  Vec3 operator()(const Vec3& x) const { return R * x + t; }
};

// *SOLID SECTION: an element set, and names in capitals ("" for none).
struct AbaqusSection {
  AbaqusMembers elements;
  std::string orientation = {}, material = {};
};

// *ORIENTATION: a system through the points a, b and c, which stand here, are those of nodes, or are listed by element.
struct AbaqusOrientation {
  enum class System { rectangular, z_rectangular, cylindrical, spherical };

  std::string name;  // as spelled
  System system = System::rectangular;
  std::array<Vec3, 3> points = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // where they lie once placed
  std::vector<std::int64_t> nodes = {};                                     // instead of points
  std::string distribution = {}, angles = {};                               // in capitals
  Eigen::Index axis = 0;                                                    // turned about by `degrees` or `angles`
  double degrees = 0;
  AbaqusPlacement placement = {};
  FilePlace place = {};
};

// *DISTRIBUTION by element: six coordinates of the points a and b, or an angle.
struct AbaqusDistribution {
  struct Row {
    AbaqusMembers elements;
    std::array<double, 6> values = {};
  };
  std::string name;
  std::size_t count = 0;  // of values in a row, 6 or 1; 0 of one that is not read
  std::vector<Row> rows = {};
  std::vector<Row> others = {};  // one, of the elements that no row names, or none
  FilePlace place = {};
};

// A line of *BOUNDARY, *CLOAD, *DLOAD or *DSLOAD. Numbers that share what stands behind them are one line with a set,
// or a surface, of their own ("boundary_1").
struct AbaqusCondition {
  AbaqusKeyword keyword;
  std::size_t step = 0;                  // 0 of the model, 1 of the first step
  std::string target = {};               // a key of node_sets, element_sets or surfaces, or "" for all
  std::vector<std::string> fields = {};  // behind that
  FilePlace place = {};
};

using AbaqusSets = std::map<std::string, AbaqusSet>;

// Is added to the numbers of nodes and elements of an assembly that has instances.
inline constexpr std::int64_t kAbaqusAssembly = 1'000'000'000'000'000;

struct AbaqusFile {
  MeshDraft draft;                                      // nodes and solid elements
  std::vector<FileFace> faces;                          // elements of three or four corners, of shells and the like
  std::vector<std::vector<std::int64_t>> face_middles;  // of each the other nodes
  std::vector<FileNodeUse> left_out;                    // numbers of elements of other types
  AbaqusSets node_sets, element_sets;
  std::map<std::string, AbaqusSurface> surfaces;
  std::vector<AbaqusSection> sections;
  std::map<std::string, AbaqusOrientation> orientations;
  std::map<std::string, AbaqusDistribution> distributions;
  AbaqusMaterials materials;
  std::vector<AbaqusCondition> conditions;
  std::vector<AbaqusKeyword> steps;
  double first_period = 1;  // s, of the first step: that of its procedure, such as *STATIC, or Abaqus' default
  AbaqusAmplitudes amplitudes;
  std::vector<AbaqusTransform> transforms;
  std::map<std::string, FilePlace> skipped;  // "*OUTPUT", ... with the first place
};

// The entry of a name, which is that of its instance or else that of the model: "PART-1-1.SIDE", then "SIDE". Null if
// there is none.
template <class Value>
const Value* find_abaqus(const std::map<std::string, Value>& all, const std::string& name) {
  auto found = all.find(name);
  const std::size_t dot = name.rfind('.');
  if (found == all.end() && dot != std::string::npos) found = all.find(name.substr(dot + 1));
  return found == all.end() ? nullptr : &found->second;
}

// Throws ConfigError.
AbaqusFile read_abaqus_keywords(const std::string& path, std::string_view text);

}  // namespace orthodyn
