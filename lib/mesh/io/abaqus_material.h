// *MATERIAL of an Abaqus input file: *ELASTIC, *DENSITY, and the names of its other keywords.
//
// Source: Abaqus keywords reference, *MATERIAL, *ELASTIC, *DENSITY.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lib/mesh/io/abaqus_lines.h"
#include "lib/mesh/loaded_mesh.h"

namespace orthodyn {

struct AbaqusMaterial {
  // A message and its place in the file.
  struct Problem {
    std::string what;
    FilePlace place;
  };
  using Rows = std::vector<std::vector<double>>;

  std::string name = {};
  std::string type = {};  // TYPE of *ELASTIC in capitals without blanks: "ISOTROPIC"
  Rows elastic = {}, density = {};
  std::vector<Problem> problems = {};   // why the constants cannot be read
  std::vector<Problem> beyond = {};     // keywords beyond linear elasticity, which change the motion: "*PLASTIC"
  std::vector<std::string> inert = {};  // keywords without effect if there are no temperatures or fields: "*EXPANSION"
  FilePlace place = {}, elastic_place = {}, density_place = {};
};

using AbaqusMaterials = std::map<std::string, AbaqusMaterial>;  // by name in capitals

class AbaqusMaterialReader {
 public:
  // Both must outlive the reader.
  AbaqusMaterialReader(AbaqusLines& lines, AbaqusMaterials& materials) : lines_(lines), materials_(materials) {}

  // Reads the keyword and its data lines if it begins or continues a material; otherwise returns false, and the
  // material ends. Unsupported parameters and tables become problems of the material, which are errors only if it is
  // used.
  bool read(const AbaqusKeyword& keyword);

 private:
  void add_problem(std::string what);  // at the line read last
  // Adds a problem for each parameter that is not in `known`.
  void check_parameters(const AbaqusKeyword& keyword, const std::vector<std::string>& known);
  AbaqusMaterial::Rows constants(const AbaqusKeyword& keyword, const std::vector<std::string>& known);

  AbaqusLines& lines_;
  AbaqusMaterials& materials_;
  AbaqusMaterial* current_ = nullptr;
};

// The constants of *ELASTIC and *DENSITY in the units of the file, or the first problem, with its place. Supported
// types: ISOTROPIC, ENGINEERING CONSTANTS, ORTHOTROPIC and ANISOTROPIC.
MeshMaterial mesh_material(const AbaqusMaterial& material, const MeshDraft& draft);

}  // namespace orthodyn
