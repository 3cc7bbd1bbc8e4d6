// Every parameter of every keyword that the reader of Abaqus files knows: it changes what is read, changes nothing, or
// is refused by name.
#include <gtest/gtest.h>

#include <algorithm>

#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/abaqus_lines.h"
#include "tests/mesh/refusal.h"

namespace orthodyn::abaqus_parameters_test {
namespace {

// Two cubes on each other, with each keyword once.
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
*Solid section, elset=Both, material=Steel, orientation=Wood
*End part
*Assembly, name=A
*Instance, name=P-1, part=P
*End instance
*End assembly
)";

LoadedMesh load(const std::string& text) { return read_abaqus_text("body.inp", text); }

bool same(const LoadedMesh& a, const LoadedMesh& b) {
  const TetMesh &m = a.mesh, &n = b.mesh;
  std::vector<std::vector<double>> data_a, data_b;
  for (const CellData& data : a.cell_data) data_a.push_back(data.values);
  for (const CellData& data : b.cell_data) data_b.push_back(data.values);
  return m.nodes == n.nodes && m.tets == n.tets && m.region_names == n.region_names && m.region_of == n.region_of &&
         m.surfaces == n.surfaces && m.node_sets == n.node_sets && data_a == data_b && a.warnings == b.warnings;
}

enum Effect { kChanges, kNothing, kRefused };

struct Parameter {
  const char *keyword, *parameter;  // as in the deck, and what is added behind it
  Effect effect;
};
void PrintTo(const Parameter& p, std::ostream* os) { *os << p.keyword << ", " << p.parameter; }

// The deck with this parameter of the first such keyword, instead of one of the same name.
std::string deck_with(const std::string& keyword, const std::string& parameter) {
  const std::size_t begin = kDeck.find(keyword + ","), end = kDeck.find('\n', begin);
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
  if (effect == kRefused) {
    EXPECT_CONTAINS(message, "body.inp:");
    const std::string name(parameter);
    EXPECT_CONTAINS(abaqus_word(message), abaqus_word(name.substr(0, name.find('='))));
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
        Parameter{"*Solid section", "SYMMETRIC", kRefused}, Parameter{"*Solid section", "STACK DIRECTION=1", kRefused},
        Parameter{"*Solid section", "ORIENTATION=None", kChanges}, Parameter{"*Solid section", "ELSET=Upper", kChanges},
        Parameter{"*Solid section", "CONTROLS=c", kNothing}, Parameter{"*Solid section", "REF NODE=1", kNothing},
        Parameter{"*Solid section", "LAYUP=l", kNothing},
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
        Parameter{"*Distribution", "NAME=Q", kChanges}));

}  // namespace
}  // namespace orthodyn::abaqus_parameters_test
