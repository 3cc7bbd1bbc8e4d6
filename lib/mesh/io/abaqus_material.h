// *MATERIAL of an Abaqus input file: its *ELASTIC and *DENSITY, and what it has beside them.
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
  // Why there are no constants, and where that stands.
  struct Problem {
    std::string what;
    FilePlace place;
  };
  using Rows = std::vector<std::vector<double>>;

  std::string name = {};
  std::string type = {};  // of *ELASTIC: "ISOTROPIC", or another word in capitals without blanks
  Rows elastic = {}, density = {};
  std::vector<Problem> problems = {};
  std::vector<Problem> beyond = {};     // what is more than linear elasticity: "*PLASTIC", which changes the motion
  std::vector<std::string> inert = {};  // what changes nothing without temperatures and fields: "*EXPANSION"
  FilePlace place = {}, elastic_place = {}, density_place = {};
};

using AbaqusMaterials = std::map<std::string, AbaqusMaterial>;  // by name in capitals

// Takes what belongs to materials out of the keywords of a file.
class AbaqusMaterialReader {
 public:
  // Both must outlive this.
  AbaqusMaterialReader(AbaqusLines& lines, AbaqusMaterials& materials) : lines_(lines), materials_(materials) {}

  // Whether this keyword begins a material or belongs to the one that began last; its lines of data are taken then. A
  // material ends with a keyword of another part of the model. What is no number, or depends on more than its place,
  // is a problem only for those who want the material.
  bool read(const AbaqusKeyword& keyword);

 private:
  void add_problem(std::string what);  // at the line that was last taken
  // Parameters that are not known are problems.
  void name_others(const AbaqusKeyword& keyword, const std::vector<std::string>& known);
  AbaqusMaterial::Rows constants(const AbaqusKeyword& keyword, const std::vector<std::string>& known);

  AbaqusLines& lines_;
  AbaqusMaterials& materials_;
  AbaqusMaterial* current_ = nullptr;
};

// The constants of *ELASTIC and *DENSITY in the file's own units, or the first problem that prevents it, each with its
// place in the draft's files. ISOTROPIC, ENGINEERING CONSTANTS, ORTHOTROPIC and ANISOTROPIC are read.
MeshMaterial mesh_material(const AbaqusMaterial& material, const MeshDraft& draft);

}  // namespace orthodyn
