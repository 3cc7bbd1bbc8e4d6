// Files that the Gmsh reader refuses, with line and message.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <string>

#include "lib/core/errors.h"
#include "lib/mesh/io/gmsh.h"
#include "tests/mesh/gmsh_test_file.h"

namespace orthodyn::gmsh_refuses_test {
namespace {

std::string refusal_of_path(const std::string& path) {
  try {
    read_gmsh(path);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

// The message without the directory.
std::string refusal(const std::string& content) {
  const TemporaryFile file(content);
  const std::string message = refusal_of_path(file.path());
  const std::string directory = file.path().substr(0, file.path().size() - std::string("beam.msh").size());
  return message.rfind(directory, 0) == 0 ? message.substr(directory.size()) : message;
}

int line_of(const std::string& text, const std::string& part) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(part));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

// Replaces `from` by `to` in the file; the message must start with "beam.msh:<line of `from`
// + offset>: " and contain `words`.
void expect_refused(const std::string& file, const std::string& from, const std::string& to, const std::string& words,
                    int offset = 0) {
  const std::string message = refusal(replaced(file, from, to));
  const std::string start = "beam.msh:" + std::to_string(line_of(file, from) + offset) + ": ";
  EXPECT_EQ(message.substr(0, start.size()), start) << message;
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

TEST(GmshRefuses, AMissingFile) {
  EXPECT_EQ(refusal_of_path("no/such.msh"), "no/such.msh: cannot be opened: No such file or directory");
}

TEST(GmshRefuses, ADirectory) {
  const std::string directory = std::filesystem::temp_directory_path().string();
  EXPECT_NE(refusal_of_path(directory).find("a directory or device"), std::string::npos);
}

TEST(GmshRefuses, ADeviceThatNeverEnds) {
  if (!std::filesystem::exists("/dev/zero")) GTEST_SKIP() << "no such device here";
  EXPECT_NE(refusal_of_path("/dev/zero").find("a directory or device"), std::string::npos);
}

TEST(GmshRefuses, AnEmptyFile) {
  EXPECT_EQ(refusal(""), "beam.msh:1: no $MeshFormat: this is not a Gmsh mesh file (.msh)");
}

TEST(GmshRefuses, ForeignFiles) {
  EXPECT_NE(refusal("solid cube\n").find("beam.msh:1: no $MeshFormat"), std::string::npos);
  EXPECT_NE(refusal(std::string("\0\x01\xff\n", 4)).find("beam.msh:1: "), std::string::npos);
}

// A text file that claims to be binary.
TEST(GmshRefuses, BinaryFilesThatAreNone) {
  for (const std::string& file : {replaced(kFile22, "2.2 0 8", "2.2 1 8"), replaced(kFile41, "4.1 0 8", "4.1 1 8")})
    EXPECT_NE(refusal(file).find("beam.msh: byte 24 of a binary Gmsh file: the numbers have another byte order"),
              std::string::npos)
        << refusal(file);
  expect_refused(kFile22, "2.2 0 8", "2.2 2 8", "file type 2; save it as ASCII");
  EXPECT_NE(refusal(replaced(kFile22, "2.2 0 8", "4.0 1 8")).find("binary files of 2.2 and 4.1 are read"),
            std::string::npos);
}

TEST(GmshRefuses, OtherVersionsWithARemedy) {
  for (const std::string version : {"1.0", "3", "4", "4.0", "4.2", "5"}) {
    expect_refused(kFile22, "2.2 0 8", version + " 0 8", "supported: 2.0 to 2.2 and 4.1; save it as ASCII");
  }
  EXPECT_NE(
      refusal("$NOD\n1\n1 0 0 0\n$ENDNOD\n").find("beam.msh:1: Gmsh format 1 is not supported; supported: 2.0 to 2.2"),
      std::string::npos);
}

// If there are physical groups, Gmsh saves only their elements.
TEST(GmshRefuses, SurfacesWithoutVolumeByTheirReason) {
  const std::string head =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"fixed face\"\n"
      "$EndPhysicalNames\n$Entities\n0 0 1 ";
  const std::string face = "1 0 0 0 1 1 1 1 1 0 \n", volume = "1 0 0 0 1 1 1 0 1 1 \n";
  const std::string rest =
      "$EndEntities\n$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
      "$EndNodes\n$Elements\n1 2 1 2\n2 1 2 2\n1 1 2 3\n2 1 2 4\n$EndElements\n";
  EXPECT_NE(refusal(head + "1\n" + face + volume + rest)
                .find("physical groups (\"fixed face\") but no Physical Volume, and Gmsh saves only elements"),
            std::string::npos);
  EXPECT_NE(refusal(head + "0\n" + face + rest).find("did you mesh in 3D (gmsh -3)?"), std::string::npos);
  EXPECT_NE(refusal(head + "0\n" + face + replaced(rest, "0 0 1\n$End", "1 1 0\n$End")).find("a 2D mesh"),
            std::string::npos);
}

TEST(GmshRefuses, ElementsOfTwoOrders) {
  expect_refused(kFile22, "4 4 2 1 1 1 2 3 4", "4 11 2 1 1 1 2 3 4 1 2 3 4 5 1", "all must be of one order", 1);
  expect_refused(kFile41, "3 1 4 1", "3 1 11 1", "expected a node tag, found the end of the line", 1);
}

TEST(GmshRefuses, ElementsOfThirdOrder) {
  expect_refused(kFile22, "4 4 2 1 1 1 2 3 4", "4 29 2 1 1 1 2 3 4", "set Mesh.ElementOrder = 1 or 2");
}

TEST(GmshRefuses, ElementsInEntitiesOfAnotherDimension) {
  expect_refused(kFile41, "3 1 4 1", "2 1 5 1", "hexahedra in an entity of dimension 2");
  expect_refused(kFile41, "2 1 2 1", "3 1 3 1", "quadrangles in an entity of dimension 3");
}

TEST(GmshRefuses, UnknownElementTypes) {
  expect_refused(kFile22, "4 4 2 1 1", "4 20 2 1 1",
                 "element type 20 is not supported; supported: tetrahedra, hexahedra, prisms and pyramids");
  expect_refused(kFile22, "4 4 2 1 1", "4 -4 2 1 1",
                 "element type -4 is not supported; supported: tetrahedra, hexahedra, prisms and pyramids");
}

TEST(GmshRefuses, PartitionedMeshes) {
  expect_refused(kFile41, "$Nodes", "$PartitionedEntities\n$EndPartitionedEntities\n$Nodes", "a partitioned mesh");
}

TEST(GmshRefuses, ParametricNodes) { expect_refused(kFile22, "$Nodes", "$ParametricNodes", "Mesh.SaveParametric = 0"); }

TEST(GmshRefuses, AMeshOfTrianglesOnly) {
  const std::string file = replaced(kFile22, "4 4 2 1 1 1 2 3 4\n5 4 2 2 2 2 3 4 5\n", "");
  expect_refused(file, "$Elements\n5", "$Elements\n3", "no solid elements: did you mesh in 3D (gmsh -3)?");
}

TEST(GmshRefuses, FilesWithoutNodesOrElements) {
  EXPECT_NE(refusal("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n").find("beam.msh:3: the file ends without $Nodes"),
            std::string::npos);
}

TEST(GmshRefuses, EveryTruncationWithALine) {
  for (const std::string& file : {kFile22, kFile41}) {
    for (std::size_t length = 0; length + 1 < file.size(); ++length) {
      const std::string message = refusal(file.substr(0, length));
      EXPECT_TRUE(message.rfind("beam.msh:", 0) == 0 && std::isdigit(message[9])) << message;
    }
  }
}

TEST(GmshRefuses, ATruncatedListWithALine) {
  EXPECT_EQ(refusal(kFile22.substr(0, kFile22.find("4 0 0 1"))),
            "beam.msh:14: the file ends after 3 of 5 nodes ($Nodes in line 10); is it truncated?");
}

TEST(GmshRefuses, CountsThatAreTooLarge) {
  const std::string huge = "999999999999999999";
  expect_refused(kFile22, "$Nodes\n5", "$Nodes\n6",
                 "found \"$EndNodes\" after 5 of the 6 nodes announced ($Nodes in line 10)", 7);
  expect_refused(kFile22, "$Nodes\n5", "$Nodes\n" + huge, "$EndNodes", 7);
  expect_refused(kFile22, "$Elements\n5", "$Elements\n" + huge, "$EndElements", 7);
  expect_refused(kFile22, "3\n2 5", huge + "\n2 5", "$EndPhysicalNames", 4);
  expect_refused(kFile22, "4 4 2 1 1", "4 4 " + huge + " 1 1", "expected an element tag");
  expect_refused(kFile41, "3 1 0 4\n", "3 1 0 " + huge + "\n", "", 5);
  expect_refused(kFile41, "3 1 4 1\n", "3 1 4 " + huge + "\n", "", 2);
  expect_refused(kFile41, "1 1 1 2\n", huge + " 1 1 2\n", "entity 1 of dimension 0 is listed twice", 2);
  expect_refused(kFile41, "1 0 1 5 1 1", "1 0 " + huge + " 5 1 1", "expected a physical tag");
  expect_refused(kFile41, "2 5 1 5\n", huge + " 5 1 5\n", "$EndNodes", 13);
}

TEST(GmshRefuses, CountsThatAreTooSmall) {
  expect_refused(kFile22, "$Nodes\n5", "$Nodes\n4", "expected $EndNodes, found \"5\"", 6);
  expect_refused(kFile22, "$Elements\n5", "$Elements\n4", "expected $EndElements, found \"5\"", 6);
  expect_refused(kFile41, "2 5 1 5\n", "2 4 1 5\n", "$Nodes announces 4 nodes, but its blocks hold 5", -1);
  expect_refused(kFile41, "5 5 1 5\n", "5 6 1 5\n", "announces 6 elements, but its blocks hold 5", -1);
}

TEST(GmshRefuses, NegativeCounts) {
  expect_refused(kFile22, "$Nodes\n5", "$Nodes\n-5", "the number of nodes is -5", 1);
  expect_refused(kFile41, "3 1 0 4\n", "3 1 0 -4\n", "cannot be negative");
  expect_refused(kFile22, "4 4 2 1 1", "4 4 -2 1 1", "cannot be negative");
}

TEST(GmshRefuses, WordsThatAreNotNumbers) {
  expect_refused(kFile22, "3 0 1 0", "3 0 one 0", "expected a coordinate (a finite number), found \"one\"");
  expect_refused(kFile22, "3 0 1 0", "3 0 1e 0", "found \"1e\"");
  expect_refused(kFile22, "3 0 1 0", "3.5 0 1 0", "expected a node tag (an integer), found \"3.5\"");
  expect_refused(kFile22, "4 4 2 1 1", "4 tet 2 1 1", "expected an element type");
}

TEST(GmshRefuses, TagsThatOverflow) {
  expect_refused(kFile22, "3 0 1 0", "99999999999999999999 0 1 0", "expected a node tag (an integer)");
  expect_refused(kFile22, "4 4 2 1 1", "4 4 2 3000000000 1", "at most 2147483647");
}

TEST(GmshRefuses, CoordinatesThatAreNotFinite) {
  for (const std::string value : {"nan", "-nan", "inf", "-inf", "1e999"}) {
    expect_refused(kFile22, "3 0 1 0", "3 0 " + value + " 0", "a finite number");
    expect_refused(kFile41, "\n0 1 0\n", "\n0 " + value + " 0\n", "a finite number", 1);
  }
}

TEST(GmshRefuses, LinesThatAreTooShortOrTooLong) {
  expect_refused(kFile22, "3 0 1 0", "3 0 1", "expected a coordinate, found the end of the line");
  expect_refused(kFile22, "3 0 1 0", "3 0 1 0 7", "expected the end of the line, found \"7\"");
  expect_refused(kFile22, "4 4 2 1 1 1 2 3 4", "4 4 2 1 1 1 2 3", "expected a node tag");
}

TEST(GmshRefuses, NodesThatAreNotDefined) {
  expect_refused(kFile22, "1 2 3 4\n", "1 2 3 9\n", "element 4: node 9 is not defined in $Nodes");
  expect_refused(kFile22, "5 1 1 3 2\n", "5 1 1 3 0\n", "element 3: node 0 is not defined");
  expect_refused(kFile41, "4 1 2 3 4\n", "4 1 2 3 9223372036854775807\n", "is not defined in $Nodes");
  expect_refused(kFile41, "4 1 2 3 4\n", "4 1 2 3 -9223372036854775808\n", "is not defined in $Nodes");
}

TEST(GmshRefuses, NodesDefinedTwice) {
  expect_refused(kFile22, "5 1 1 1\n", "3 1 1 1\n", "node tag 3 is defined twice (first in line 14)");
  expect_refused(kFile41, "4\n5\n", "4\n2\n", "node tag 2 is defined twice", 5);
}

// A node was pushed through the opposite face: reoriented, the element overlaps its neighbour.
TEST(GmshRefuses, ElementsThatOverlapOnceTheyAreTurned) {
  EXPECT_NE(refusal(replaced(kFile22, "5 1 1 1\n", "5 -1 -1 -1\n")).find("element 5: overlaps"), std::string::npos);
}

TEST(GmshRefuses, DegenerateElements) { expect_refused(kFile22, "1 2 3 4\n", "1 2 3 3\n", "element 4: degenerate"); }

TEST(GmshRefuses, CoincidentNodes) {
  std::string file = replaced(kFile22, "$Nodes\n5", "$Nodes\n6");
  file = replaced(file, "2 2 3 4 5\n", "2 2 3 6 5\n");
  expect_refused(file, "5 1 1 1\n", "5 1 1 1\n6 0 0 1\n", "node 6: at exactly the same place", 1);
}

TEST(GmshRefuses, TrianglesOffTheMesh) {
  expect_refused(kFile22, "5 1 1 3 2\n", "5 1 1 2 5\n", "element 3: surface \"load\": not a face of any element");
}

TEST(GmshRefuses, TetsInTwoPhysicalVolumes) {
  const std::string file = replaced(kFile41, "1 1 1 1 1 1 1", "1 1 1 2 1 2 1 1");
  expect_refused(file, "4 1 2 3 4\n", "4 1 2 3 4\n", "element 4: in two physical volumes, \"left\" and \"right side\"");
  expect_refused(kFile22, "2 3 4 5\n", "1 2 3 4\n", "element 5: the same nodes as ");
}

TEST(GmshRefuses, EntitiesThatAreNotListed) {
  expect_refused(kFile41, "3 1 4 1\n", "3 8 4 1\n", "entity 8 of dimension 3 is not in $Entities");
}

TEST(GmshRefuses, EntitiesListedTwice) {
  expect_refused(kFile41, "2 0 0 0 1 1 1 1 2 0", "1 0 0 0 1 1 1 1 2 0", "listed twice");
}

TEST(GmshRefuses, EntitiesBehindTheElements) {
  const std::size_t entities = kFile41.find("$Entities"), nodes = kFile41.find("$Nodes");
  const std::string file =
      kFile41.substr(0, entities) + kFile41.substr(nodes) + kFile41.substr(entities, nodes - entities);
  EXPECT_NE(refusal(file).find("$Entities must come before $Elements"), std::string::npos);
}

TEST(GmshRefuses, TetsInASurface) {
  expect_refused(kFile41, "3 1 4 1\n", "2 1 4 1\n", "tetrahedra in an entity of dimension 2");
  expect_refused(kFile41, "3 1 4 1\n", "4 1 4 1\n", "dimension 4; expected 0 to 3");
}

TEST(GmshRefuses, ASectionGivenTwice) {
  expect_refused(kFile22, "$Elements", "$Nodes\n0\n$EndNodes\n$Elements",
                 "section $Nodes occurs twice (first in line 10)");
}

TEST(GmshRefuses, SectionsThatDoNotEnd) {
  const std::string file = kFile22 + "$Periodic\n1\n";
  const std::string message = refusal(file);
  const std::string line = std::to_string(line_of(file, "$Periodic"));
  EXPECT_NE(message.find("the file ends inside \"$Periodic\" (line " + line + ")"), std::string::npos) << message;
}

TEST(GmshRefuses, TextBetweenSections) {
  expect_refused(kFile22, "$Nodes", "hello\n$Nodes", "expected the start of a section ($...), found \"hello\"");
}

TEST(GmshRefuses, NamesThatAreNotNames) {
  expect_refused(kFile22, "2 5 \"load\"", "2 5 load", "expected a name in quotes, found \"load\"");
  expect_refused(kFile22, "2 5 \"load\"", "2 5", "expected a name in quotes");
  expect_refused(kFile22, "3 2 \"right side\"", "3 1 \"right side\"", "is named twice");
  expect_refused(kFile22, "2 5 \"load\"", "4 5 \"load\"", "dimension 4");
}

TEST(GmshRefuses, WithoutPrintingUnprintableBytes) {
  expect_refused(kFile22, "3 0 1 0", "3 0 \x1b[31m\xff 0", "found \"?[31m?\"");
  expect_refused(kFile22, "3 0 1 0", "3 0 " + std::string(5000, 'x') + " 0", std::string(40, 'x') + "...\"");
}

}  // namespace
}  // namespace orthodyn::gmsh_refuses_test
