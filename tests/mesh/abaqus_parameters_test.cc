// Every known parameter of every Abaqus keyword changes the mesh, changes nothing, or is refused by name. A parameter
// of a material may also be the reason why the material is not read.
#include <gtest/gtest.h>

#include <algorithm>

#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/abaqus_lines.h"
#include "tests/mesh/refusal.h"

namespace orthodyn::abaqus_parameters_test {
namespace {

// Two stacked cubes; uses each keyword once.
const std::string kDeck = R"(*Part, name=P
*Node, nset=Nodes
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 0, 0, 2
10, 1, 0, 2
11, 1, 1, 2
12, 0, 1, 2
*Element, type=C3D8, elset=Both
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 5, 6, 7, 8, 9, 10, 11, 12
*Nset, nset=Foot
1, 2, 3, 4
*Elset, elset=Upper
2
*Surface, name=Top
2, S2
*Distribution table, name=Table
COORD3D, COORD3D
*Distribution, name=Grain, location=element, table=Table
, 1, 0, 0, 0, 1, 0
2, 0, 1, 0, 0, 0, 1
*Orientation, name=Wood
Grain
*Include, input=head.inc
*Solid section, elset=Both, material=Steel, orientation=Wood
*End part
*Assembly, name=A
*Instance, name=P-1, part=P
*End instance
*End assembly
*Material, name=Steel
*Elastic
2e11, 0.3
*Density
7800
)";

// Reads the deck in the folder of the included file.
LoadedMesh load(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("head.inc", "*Nset, nset=Head\n9, 10, 11, 12\n");
  LoadedMesh loaded = read_abaqus_text(folder.path("body.inp"), text);
  const std::string own = folder.path("");
  for (std::string& warning : loaded.warnings)
    if (warning.starts_with(own)) warning.erase(0, own.size());
  return loaded;
}

const MeshMaterial& material_of(const LoadedMesh& loaded) { return loaded.materials.begin()->second; }

bool same(const MeshMaterial& a, const MeshMaterial& b) {
  return a.kind == b.kind && a.young == b.young && a.nu12 == b.nu12 && a.g12 == b.g12 && a.stiffness == b.stiffness &&
         a.density == b.density && a.problem == b.problem;
}

bool same(const LoadedMesh& a, const LoadedMesh& b) {
  const Mesh &m = a.mesh, &n = b.mesh;
  std::vector<std::vector<double>> data_a, data_b;
  for (const CellData& data : a.cell_data) data_a.push_back(data.values);
  for (const CellData& data : b.cell_data) data_b.push_back(data.values);
  return m.nodes == n.nodes && m.cells == n.cells && m.region_names == n.region_names && m.region_of == n.region_of &&
         m.surfaces == n.surfaces && m.node_sets == n.node_sets && data_a == data_b && a.warnings == b.warnings &&
         same(material_of(a), material_of(b));
}

enum Effect { kChanges, kNothing, kRefused, kNamed };

struct Parameter {
  const char *keyword, *parameter;  // as in the deck, and what is added behind it
  Effect effect;
};
void PrintTo(const Parameter& p, std::ostream* os) { *os << p.keyword << ", " << p.parameter; }

// The deck with this parameter at the first occurrence of the keyword; replaces a parameter of the same name.
std::string deck_with(const std::string& keyword, const std::string& parameter) {
  const std::size_t with = kDeck.find(keyword + ",");
  const std::size_t begin = with != std::string::npos ? with : kDeck.find(keyword + "\n");
  const std::size_t end = kDeck.find('\n', begin);
  std::string line = kDeck.substr(begin, end - begin);
  const std::string name = parameter.substr(0, parameter.find('='));
  const std::size_t own = in_capitals(line).find(", " + name + "=");
  if (own != std::string::npos) line.erase(own, std::min(line.find(',', own + 1), line.size()) - own);
  return replaced(kDeck, kDeck.substr(begin, end - begin), line + ", " + parameter);
}

class EveryParameter : public testing::TestWithParam<Parameter> {};

TEST_P(EveryParameter, IsUsedOrMeansNothingOrIsRefusedByName) {
  const auto& [keyword, parameter, effect] = GetParam();
  const std::string deck = deck_with(keyword, parameter), message = refusal_of([&] { load(deck); });
  const std::string name = abaqus_word(std::string(parameter).substr(0, std::string(parameter).find('=')));
  if (effect == kRefused) {
    EXPECT_CONTAINS(message, "body.inp:");
    EXPECT_CONTAINS(abaqus_word(message), name);
  } else if (effect == kNamed) {
    EXPECT_EQ(message, "accepted");
    EXPECT_CONTAINS(abaqus_word(material_of(load(deck)).problem), name);
  } else if (message != "accepted") {
    EXPECT_EQ(effect, kChanges) << message;  // it is used, and asks for what it needs
  } else {
    EXPECT_EQ(same(load(deck), load(kDeck)), effect == kNothing);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Abaqus, EveryParameter,
    testing::Values(
        Parameter{"*Node", "NSET=Other", kChanges}, Parameter{"*Node", "SYSTEM=R", kNothing},
        Parameter{"*Node", "SYSTEM=C", kChanges}, Parameter{"*Node", "SYSTEM=S", kChanges},
        Parameter{"*Node", "SYSTEM=Q", kRefused}, Parameter{"*Node", "INPUT=none.txt", kRefused},
        Parameter{"*Node", "FRAME=2", kRefused},  // there is none
        Parameter{"*Element", "ELSET=Other", kChanges}, Parameter{"*Element", "TYPE=C3D20", kChanges},
        Parameter{"*Element", "OFFSET=10", kRefused}, Parameter{"*Element", "FILE=sub", kRefused},
        Parameter{"*Element", "INPUT=none.txt", kRefused},
        Parameter{"*Element", "SOLID ELEMENT NUMBERING=FORWARD", kNothing}, Parameter{"*Nset", "ELSET=Upper", kChanges},
        Parameter{"*Nset", "GENERATE", kChanges}, Parameter{"*Nset", "NSET=Other", kChanges},
        Parameter{"*Nset", "INSTANCE=Q-1", kRefused}, Parameter{"*Nset", "INTERNAL", kNothing},
        Parameter{"*Nset", "UNSORTED", kNothing}, Parameter{"*Nset", "INPUT=none.txt", kRefused},
        Parameter{"*Elset", "GENERATE", kChanges}, Parameter{"*Elset", "ELSET=Both", kChanges},
        Parameter{"*Elset", "INSTANCE=Q-1", kRefused}, Parameter{"*Elset", "INTERNAL", kNothing},
        Parameter{"*Elset", "UNSORTED", kNothing}, Parameter{"*Elset", "INPUT=none.txt", kRefused},
        Parameter{"*Surface", "TYPE=ELEMENT", kNothing}, Parameter{"*Surface", "TYPE=NODE", kChanges},
        Parameter{"*Surface", "NAME=Side", kChanges}, Parameter{"*Surface", "COMBINE=UNION", kRefused},
        Parameter{"*Surface", "COMPLEMENT", kRefused}, Parameter{"*Surface", "CROP", kRefused},
        Parameter{"*Surface", "DEFINITION=COORDINATES", kRefused},
        Parameter{"*Surface", "REGION TYPE=SLIDING", kRefused}, Parameter{"*Surface", "TRIM=YES", kRefused},
        Parameter{"*Surface", "INTERNAL", kNothing}, Parameter{"*Surface", "NO THICK", kNothing},
        Parameter{"*Surface", "NO OFFSET", kNothing}, Parameter{"*Surface", "PROPERTY=p", kNothing},
        Parameter{"*Surface", "SCALE THICK=2", kNothing}, Parameter{"*Surface", "MAX RATIO=2", kNothing},
        Parameter{"*Surface", "FILLET RADIUS=1", kNothing}, Parameter{"*Solid section", "COMPOSITE", kRefused},
        Parameter{"*Solid section", "SYMMETRIC", kNothing}, Parameter{"*Solid section", "STACK DIRECTION=1", kNothing},
        Parameter{"*Solid section", "ORDER=1", kRefused}, Parameter{"*Solid section", "ORIENTATION=None", kChanges},
        Parameter{"*Solid section", "ELSET=Upper", kChanges}, Parameter{"*Solid section", "CONTROLS=c", kNothing},
        Parameter{"*Solid section", "REF NODE=1", kNothing}, Parameter{"*Solid section", "LAYUP=l", kNothing},
        Parameter{"*Solid section", "THICKNESS=2", kRefused},  // there is none
        Parameter{"*Orientation", "SYSTEM=RECTANGULAR", kNothing},
        Parameter{"*Orientation", "SYSTEM=Z RECTANGULAR", kChanges},
        Parameter{"*Orientation", "SYSTEM=CYLINDRICAL", kChanges},
        Parameter{"*Orientation", "SYSTEM=SPHERICAL", kChanges}, Parameter{"*Orientation", "SYSTEM=USER", kRefused},
        Parameter{"*Orientation", "DEFINITION=COORDINATES", kNothing},
        Parameter{"*Orientation", "DEFINITION=NODES", kChanges},
        Parameter{"*Orientation", "DEFINITION=OFFSET TO NODES", kRefused},
        Parameter{"*Orientation", "LOCAL DIRECTIONS=2", kRefused},
        Parameter{"*Distribution", "LOCATION=NODE", kChanges}, Parameter{"*Distribution", "TABLE=None", kChanges},
        Parameter{"*Distribution", "INPUT=none.txt", kRefused}, Parameter{"*Distribution", "EXTERNAL FIELD", kRefused},
        Parameter{"*Distribution", "DESIGN VARIABLE", kRefused}, Parameter{"*Instance", "LIBRARY=old", kRefused},
        Parameter{"*Instance", "INSTANCE=old", kRefused}, Parameter{"*Instance", "PART=None", kChanges},
        Parameter{"*Part", "NAME=Q", kChanges}, Parameter{"*Assembly", "NAME=B", kNothing},
        Parameter{"*Instance", "NAME=P-2", kNothing}, Parameter{"*Orientation", "NAME=Q", kChanges},
        Parameter{"*Distribution", "NAME=Q", kChanges}, Parameter{"*Distribution table", "NAME=Q", kChanges},
        Parameter{"*Distribution table", "LENGTH=6", kRefused},  // there is none
        Parameter{"*Distribution", "TYPE=ELEMENT", kRefused},    // there is none
        Parameter{"*Orientation", "ANGLE=30", kRefused},         // there is none
        Parameter{"*Solid section", "MATERIAL=Brass", kChanges}, Parameter{"*Solid section", "ORDER=1", kRefused},
        Parameter{"*Include", "INPUT=none.inc", kRefused}, Parameter{"*Include", "PASSWORD=p", kRefused},
        Parameter{"*Include", "FORMAT=free", kRefused},  // there is none
        Parameter{"*Material", "NAME=Brass", kChanges}, Parameter{"*Material", "RTOL=0.1", kNothing},
        Parameter{"*Material", "SRATE FACTOR=2", kNothing},
        Parameter{"*Material", "STRAIN RATE REGULARIZATION=LINEAR", kNothing},
        Parameter{"*Material", "SCALE=2", kNamed},  // there is none
        Parameter{"*Elastic", "TYPE=ISOTROPIC", kNothing},
        Parameter{"*Elastic", "TYPE=ENGINEERING CONSTANTS", kChanges},
        Parameter{"*Elastic", "TYPE=ORTHOTROPIC", kChanges}, Parameter{"*Elastic", "TYPE=ANISOTROPIC", kChanges},
        Parameter{"*Elastic", "TYPE=LAMINA", kNamed}, Parameter{"*Elastic", "TYPE=SHORT FIBER", kNamed},
        Parameter{"*Elastic", "MODULI=LONG TERM", kNothing},  // of viscoelastic materials, which are named
        Parameter{"*Elastic", "DEPENDENCIES=1", kNamed}, Parameter{"*Elastic", "COMPRESSION FACTOR=0.5", kNamed},
        Parameter{"*Density", "DEPENDENCIES=1", kNamed}, Parameter{"*Density", "PORE FLUID", kNamed}));

}  // namespace
}  // namespace orthodyn::abaqus_parameters_test
