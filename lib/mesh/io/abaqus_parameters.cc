// Implements check_abaqus_parameters().
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "lib/core/spelling.h"
#include "lib/mesh/io/abaqus_lines.h"

namespace orthodyn {
namespace {

struct Parameters {
  std::vector<std::string> used, harmless;
  std::map<std::string, const char*> refused = {};  // each with the remedy
};

// By keyword. Source: Abaqus keywords reference, 2016 to 2024.
const std::map<std::string, Parameters>& parameter_table() {
  constexpr const char* kWhole = "only surfaces that list faces of elements are supported; list the faces";
  constexpr const char* kImport = "results of an earlier analysis are not read; write the part itself";
  static const std::map<std::string, Parameters> all{
      {"NODE", {{"NSET", "SYSTEM", "INPUT"}, {}}},
      {"ELEMENT",
       {{"TYPE", "ELSET", "INPUT"},
        {"SOLIDELEMENTNUMBERING"},  // affects the output of acoustic infinite elements and cohesive layers
        {{"FILE", "elements of a substructure are not supported"},
         {"OFFSET", "offsets of node numbers are not supported; write the numbers themselves"}}}},
      {"NSET", {{"NSET", "ELSET", "GENERATE", "INSTANCE", "INPUT"}, {"INTERNAL", "UNSORTED"}}},
      {"ELSET", {{"ELSET", "GENERATE", "INSTANCE", "INPUT"}, {"INTERNAL", "UNSORTED"}}},
      {"SURFACE",
       {{"NAME", "TYPE"},
        {"INTERNAL", "NOOFFSET", "NOTHICK", "PROPERTY", "SCALETHICK", "MAXRATIO", "FILLETRADIUS", "TRACKING"},
        {{"COMBINE", kWhole},
         {"COMPLEMENT", kWhole},
         {"CROP", kWhole},
         {"DEFINITION", kWhole},
         {"REGIONTYPE", kWhole},
         {"TRIM", kWhole}}}},
      {"SOLIDSECTION",
       {{"ELSET", "MATERIAL", "ORIENTATION", "COMPOSITE", "STACKDIRECTION", "SYMMETRIC"},
        {"CONTROLS", "LAYUP", "REFNODE"},
        {{"ORDER", "it is for acoustic infinite elements only"}}}},
      {"ORIENTATION",
       {{"NAME", "SYSTEM", "DEFINITION"},
        {},
        {{"LOCALDIRECTIONS",
          "fibre directions relative to the axes are not supported; rotate the orientation itself"}}}},
      {"DISTRIBUTION",
       {{"NAME", "LOCATION", "TABLE", "INPUT"},
        {},
        {{"DESIGNVARIABLE", "it is for adjoint analyses only"},
         {"EXTERNALFIELD", "values of an output database are not read; list them"}}}},
      {"DISTRIBUTIONTABLE", {{"NAME"}, {}}},
      {"PART", {{"NAME"}, {}}},
      {"ASSEMBLY", {{"NAME"}, {}}},
      {"INSTANCE", {{"NAME", "PART"}, {}, {{"INSTANCE", kImport}, {"LIBRARY", kImport}}}},
      {"ENDPART", {}},
      {"ENDINSTANCE", {}},
      {"ENDASSEMBLY", {}},
      {"INCLUDE", {{"INPUT"}, {}, {{"PASSWORD", "encrypted files are not supported"}}}},
  };
  return all;
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

bool check_abaqus_parameters(const AbaqusKeyword& keyword, const std::function<void(const std::string&)>& fail) {
  const auto found = parameter_table().find(keyword.name);
  if (found == parameter_table().end()) return false;
  const Parameters& known = found->second;
  for (const auto& [name, value] : keyword.parameters) {
    if (is_among(known.used, name) || is_among(known.harmless, name)) continue;
    const auto refused = known.refused.find(name);
    if (refused != known.refused.end()) fail(fmt::format("{}, {}: {}", keyword.spelled, name, refused->second));
    std::vector<std::string> names = known.used;
    names.insert(names.end(), known.harmless.begin(), known.harmless.end());
    fail(fmt::format("{} has no parameter {}; {}", keyword.spelled, TextTokens::quoted(name),
                     names.empty() ? "it has none" : "known: " + join(names)));
  }
  return true;
}

}  // namespace orthodyn
