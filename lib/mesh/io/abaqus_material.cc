#include "lib/mesh/io/abaqus_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace orthodyn {
namespace {

bool is_listed(const std::string& name, const std::string& names) {
  return (" " + names).find(" " + name + " ") != std::string::npos;
}

// Keywords that end a material, beside those that are read. Source: Abaqus keywords reference, "model data" and
// "history data".
bool ends_material(const AbaqusKeyword& keyword) {
  static const std::string names =
      "STEP HEADING PREPRINT BOUNDARY AMPLITUDE INITIALCONDITIONS SURFACEINTERACTION CONTACT CONTACTPAIR TIE COUPLING "
      "KINEMATICCOUPLING DISTRIBUTINGCOUPLING EQUATION MPC RIGIDBODY SHELLSECTION SHELLGENERALSECTION BEAMSECTION "
      "BEAMGENERALSECTION MEMBRANESECTION SURFACESECTION COHESIVESECTION CONNECTORSECTION CONNECTORBEHAVIOR MASS "
      "ROTARYINERTIA SPRING DASHPOT GAP TIMEPOINTS PHYSICALCONSTANTS FILTER TRANSFORM PARAMETER RESTART "
      "SECTIONCONTROLS PRETENSIONSECTION EMBEDDEDELEMENT SYSTEM NGEN NFILL NCOPY NMAP ELGEN ELCOPY SUBMODEL IMPORT "
      "SYMMETRICMODELGENERATION CLOAD DLOAD DSLOAD OUTPUT NODEPRINT ELPRINT NODEFILE ELFILE ";
  return keyword.is_read || is_listed(keyword.name, names);
}

bool is_inert(const std::string& name) {
  static const std::string names =
      "EXPANSION CONDUCTIVITY SPECIFICHEAT LATENTHEAT INELASTICHEATFRACTION JOULEHEATFRACTION ELECTRICALCONDUCTIVITY "
      "MAGNETICPERMEABILITY DIFFUSIVITY SOLUBILITY DEPVAR USEROUTPUTVARIABLES ";
  return is_listed(name, names);
}

// The `count` constants of a single row, eight per line; a temperature may follow. Empty if there are several rows.
std::vector<double> row_of(const AbaqusMaterial::Rows& lines, std::size_t count) {
  std::vector<double> out;
  if (lines.empty() || lines.size() > (count + 7) / 8) return {};
  for (std::size_t l = 0; l < lines.size(); ++l) {
    out.insert(out.end(), lines[l].begin(), lines[l].end());
    if (l + 1 < lines.size()) out.resize(8 * (l + 1));
  }
  if (out.size() > count + 1) return {};
  out.resize(count);
  return out;
}

void set_isotropic(const std::vector<double>& c, MeshMaterial& m) {
  m.kind = MeshMaterial::Kind::isotropic;
  m.young.setConstant(c[0]);
  m.nu12 = m.nu23 = m.nu31 = c[1];
  m.g12 = m.g23 = m.g31 = c[0] / (2 * (1 + c[1]));
}

// Order of the constants: E1, E2, E3, nu12, nu13, nu23, G12, G13, G23.
void set_engineering_constants(const std::vector<double>& c, MeshMaterial& m) {
  m.kind = MeshMaterial::Kind::orthotropic;
  m.young = {c[0], c[1], c[2]};
  m.nu12 = c[3];
  m.nu13 = c[4];
  m.nu31 = c[4] * c[2] / c[0];
  m.nu23 = c[5];
  m.g12 = c[6];
  m.g31 = c[7];
  m.g23 = c[8];
}

// C11, C12, C22, C13, C23, C33, C44, C55, C66, at these indices of the 21 constants.
void set_orthotropic(const std::vector<double>& c, MeshMaterial& m) {
  constexpr std::array<std::size_t, 9> kPlaces{0, 1, 2, 3, 4, 5, 9, 14, 20};
  m.kind = MeshMaterial::Kind::anisotropic;
  for (std::size_t k = 0; k < kPlaces.size(); ++k) m.stiffness[kPlaces[k]] = c[k];
}

void set_anisotropic(const std::vector<double>& c, MeshMaterial& m) {
  m.kind = MeshMaterial::Kind::anisotropic;
  std::copy(c.begin(), c.end(), m.stiffness.begin());
}

struct Type {
  std::string_view name;
  std::size_t count;
  void (*set)(const std::vector<double>& constants, MeshMaterial& material);
};
constexpr std::array<Type, 4> kTypes{{{"ISOTROPIC", 2, set_isotropic},
                                      {"ENGINEERINGCONSTANTS", 9, set_engineering_constants},
                                      {"ORTHOTROPIC", 9, set_orthotropic},
                                      {"ANISOTROPIC", 21, set_anisotropic}}};

// Returns "", or why the elasticity cannot be read.
std::string set_elasticity(const AbaqusMaterial& given, MeshMaterial& material) {
  if (given.elastic.empty()) return "it has no *ELASTIC";
  for (const Type& type : kTypes) {
    if (!type.name.starts_with(given.type)) continue;  // types may be abbreviated
    const std::vector<double> constants = row_of(given.elastic, type.count);
    if (constants.empty()) return fmt::format("*ELASTIC is not one set of {} constants", type.count);
    type.set(constants, material);
    return "";
  }
  return fmt::format("*ELASTIC, TYPE={} is not read", given.type);
}

}  // namespace

bool AbaqusMaterialReader::read(const AbaqusKeyword& keyword) {
  if (keyword.name == "MATERIAL") {
    const std::string name = keyword.parameter("NAME");
    if (name.empty()) lines_.fail("*MATERIAL without NAME=name");
    current_ = &materials_[in_capitals(name)];
    *current_ = {.name = name, .place = keyword.place, .elastic_place = keyword.place, .density_place = keyword.place};
    // The parameters beside NAME concern strain-rate tables, which are in other keywords.
    check_parameters(keyword, {"NAME", "RTOL", "SRATEFACTOR", "STRAINRATEREGULARIZATION"});
    lines_.skip_data();
    return true;
  }
  if (!current_ || ends_material(keyword)) {
    current_ = nullptr;
    return false;
  }
  if (keyword.name == "ELASTIC") {
    current_->type = abaqus_word(keyword.parameter("TYPE"));
    current_->elastic_place = keyword.place;
    current_->elastic = constants(keyword, {"TYPE", "MODULI"});
  } else if (keyword.name == "DENSITY") {
    current_->density_place = keyword.place;
    current_->density = constants(keyword, {});
  } else if (is_inert(keyword.name)) {
    current_->inert.push_back(keyword.spelled);
  } else {
    current_->beyond.push_back({keyword.spelled, keyword.place});
  }
  lines_.skip_data();
  return true;
}

void AbaqusMaterialReader::add_problem(std::string what) {
  current_->problems.push_back({std::move(what), lines_.place()});
}

void AbaqusMaterialReader::check_parameters(const AbaqusKeyword& keyword, const std::vector<std::string>& known) {
  for (const auto& [name, value] : keyword.parameters)
    if (std::find(known.begin(), known.end(), name) == known.end())
      add_problem(fmt::format("{}, {} is not read", keyword.spelled, name));
}

AbaqusMaterial::Rows AbaqusMaterialReader::constants(const AbaqusKeyword& keyword,
                                                     const std::vector<std::string>& known) {
  check_parameters(keyword, known);
  AbaqusMaterial::Rows rows;
  while (!lines_.at_keyword()) {
    const auto& fields = lines_.data();
    if (!fields.empty() && abaqus_is_name(fields[0])) {
      add_problem(fmt::format("{} by a distribution is not read", keyword.spelled));
      continue;
    }
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < fields.size(); ++k) row.push_back(lines_.real(k, "a constant"));
  }
  return rows;
}

MeshMaterial mesh_material(const AbaqusMaterial& given, const MeshDraft& draft) {
  MeshMaterial material{.name = given.name, .where = draft.where(given.elastic_place)};
  material.without_effect = given.inert;
  const auto refuse = [&](FilePlace place, std::string why) {
    material.where = draft.where(place);
    material.problem = std::move(why);
  };
  for (const auto& [what, place] : given.beyond) material.beyond.push_back({draft.where(place), what});
  if (!given.problems.empty()) {
    refuse(given.problems.front().place, given.problems.front().what);
  } else if (const std::string why = set_elasticity(given, material); !why.empty()) {
    refuse(given.elastic_place, why);
  } else if (given.density.size() != 1 || given.density[0].empty()) {
    refuse(given.density_place, given.density.empty() ? "it has no *DENSITY" : "*DENSITY is not one value");
  } else if (!(given.density[0][0] > 0)) {
    refuse(given.density_place, fmt::format("*DENSITY is {}; it must be positive", given.density[0][0]));
  } else {
    material.density = given.density[0][0];
  }
  return material;
}

}  // namespace orthodyn
