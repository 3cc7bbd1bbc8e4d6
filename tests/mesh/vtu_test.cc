#include "lib/mesh/io/vtu.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "lib/mesh/io/vtk.h"
#include "tests/mesh/refusal.h"
#include "tests/mesh/tets.h"

namespace orthodyn::vtu_test {
namespace {

const std::string kAscii = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1">
<UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="2">
<CellData>
<DataArray type="Int32" Name="region" format="ascii">7 -3</DataArray>
<DataArray type="Float64" Name="axis" NumberOfComponents="3" format="ascii">1 0 0 0 0.5 nan</DataArray>
</CellData>
<Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataArray>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 1 2 3 4</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 10</DataArray>
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

LoadedMesh load(const std::string& text) { return read_vtu_text("body.vtu", text); }
std::string refusal(const std::string& text) {
  return refusal_of([&] { load(text); });
}

// The same mesh with appended data, raw or base64, in either byte order and with either width of lengths.
class Appended {
 public:
  Appended(bool big, bool wide, bool base64)
      : swap_(big != (std::endian::native == std::endian::big)), wide_(wide), base64_(base64) {
    text_ = std::string("<VTKFile type=\"UnstructuredGrid\" byte_order=\"") + (big ? "Big" : "Little") +
            "Endian\" header_type=\"" + (wide ? "UInt64" : "UInt32") + "\"><UnstructuredGrid><Piece><Points>";
    add<double>("Float64", "points", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
    text_ += "</Points><Cells>";
    add<std::int32_t>("Int32", "connectivity", {0, 1, 2, 3, 1, 2, 3, 4});
    add<std::int32_t>("Int32", "offsets", {4, 8});
    add<std::uint8_t>("UInt8", "types", {10, 10});
    text_ += std::string("</Cells></Piece></UnstructuredGrid><AppendedData encoding=\"") + (base64 ? "base64" : "raw") +
             "\">\n_" + data_ + "\n</AppendedData></VTKFile>";
  }
  const std::string& text() const { return text_; }

 private:
  template <class T>
  std::string bytes_of(T value) const {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (swap_) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  }

  template <class T>
  void add(const char* type, const char* name, const std::vector<T>& values) {
    text_ += std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"appended\" offset=\"" +
             std::to_string(data_.size()) + "\"/>";
    std::string block = wide_ ? bytes_of(std::uint64_t{values.size() * sizeof(T)})
                              : bytes_of(static_cast<std::uint32_t>(values.size() * sizeof(T)));
    for (const T value : values) block += bytes_of(value);
    data_ += base64_ ? encoded(block) : block;
  }

  static std::string encoded(const std::string& bytes) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      unsigned bits = 0;
      for (std::size_t k = 0; k < 3; ++k)
        bits = (bits << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
      for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? digits[(bits >> (18 - 6 * k)) & 63] : '=';
    }
    return out;
  }

  bool swap_, wide_, base64_;
  std::string text_, data_;
};

TEST(Vtu, AppendedDataOfEveryEncodingGiveTheSameMesh) {
  const Mesh mesh = load(kAscii).mesh;
  for (const bool big : {false, true}) {
    for (const bool wide : {false, true}) {
      for (const bool base64 : {false, true}) {
        const Mesh other = load(Appended(big, wide, base64).text()).mesh;
        EXPECT_EQ(other.nodes, mesh.nodes) << big << wide << base64;
        EXPECT_EQ(other.cells, mesh.cells) << big << wide << base64;
      }
    }
  }
}

TEST(Vtu, TruncatedAppendedDataAreRefused) {
  for (const bool base64 : {false, true}) {
    const std::string text = Appended(false, true, base64).text();
    EXPECT_CONTAINS(refusal(text.substr(0, text.find("\n_") + 60)), "is it truncated?");
  }
}

// Lengths and data in one base64 text, as some writers do: a group may contain bytes of both.
TEST(Vtu, AHeaderAndASingleByteMayShareAGroupOfBase64) {
  std::string one = replaced(kAscii, "NumberOfCells=\"2\"", "NumberOfCells=\"1\"");
  one = replaced(replaced(one, "7 -3", "7"), "1 0 0 0 0.5 nan", "1 0 0");
  one = replaced(replaced(one, "0 1 2 3 1 2 3 4", "0 1 2 3"), "4 8", "4");
  one = replaced(one, "format=\"ascii\">10 10<", "format=\"binary\">AQAAAAo=<");  // 1 0 0 0, 10
  one = replaced(one, "0 0 0 1 1 1 1<", "0 0 0 1<");
  one = replaced(one, "NumberOfPoints=\"5\"", "NumberOfPoints=\"4\"");
  one = replaced(one, "type=\"UnstructuredGrid\"", "type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"");
  EXPECT_EQ(tets_of(load(one).mesh), (std::vector<Tet>{{0, 1, 2, 3}}));
  EXPECT_CONTAINS(refusal(replaced(one, "AQAAAAo=", "AgAAAAo=")), "is it truncated?");
}

// A zlib stream of this many zeros (at least one), about 1:159: one block of fixed codes (RFC 1951, 3.2.6).
std::string packed_zeros(std::uint32_t count) {
  std::string bits = "110";  // the last block; fixed codes
  const std::uint32_t literals = 1 + (count - 1) % 258;
  for (std::uint32_t k = 0; k < literals; ++k) bits += "00110000";                // a zero
  for (std::uint32_t k = literals; k < count; k += 258) bits += "1100010100000";  // 258 bytes as the one before
  bits += "0000000";                                                              // the end
  std::string bytes = "\x78\x9c";
  for (std::size_t b = 0; b < bits.size(); b += 8) {
    int byte = 0;
    for (std::size_t k = b; k < std::min(b + 8, bits.size()); ++k) byte |= (bits[k] - '0') << (k - b);
    bytes += static_cast<char>(byte);
  }
  const std::uint32_t sum = (count % 65521) << 16 | 1;  // Adler-32
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>((sum >> shift) & 0xff);
  return bytes;
}

// Two cells with `arrays` arrays of zeros that share one compressed block.
std::string zeros(int arrays, int components, std::string (*change)(std::string) = nullptr) {
  const auto size = static_cast<std::uint32_t>(2 * 8 * components);
  std::string block = packed_zeros(size);
  if (change) block = change(block);
  const std::uint32_t header[] = {1, size, size, static_cast<std::uint32_t>(block.size())};
  const std::string order = std::endian::native == std::endian::big ? "Big" : "Little";
  std::string text =
      replaced(kAscii, "version=\"0.1\"", "compressor=\"vtkZLibDataCompressor\" byte_order=\"" + order + "Endian\"");
  std::string cells = "<CellData>\n";
  for (int a = 0; a < arrays; ++a) {
    cells += "<DataArray type=\"Float64\" Name=\"z" + std::to_string(a) + "\" NumberOfComponents=\"" +
             std::to_string(components) + "\" format=\"appended\" offset=\"0\"/>\n";
  }
  return replaced(replaced(text, "<CellData>\n", cells), "</VTKFile>\n", "<AppendedData encoding=\"raw\">_") +
         std::string(reinterpret_cast<const char*>(header), sizeof header) + block + "\n</AppendedData></VTKFile>";
}

TEST(Vtu, ArraysThatShareTheirBytesAreBoundedByTheSizeOfTheFile) {
  EXPECT_EQ(load(zeros(2, 50'000)).cell_data.size(), 4u);
  EXPECT_CONTAINS(refusal(zeros(40, 50'000)), "the arrays unpack to more than 1000 times the size of the file");
}

TEST(Vtu, ArraysOfTheWrongLengthAreRefusedBeforeTheyAreUnpacked) {
  const auto damaged = [](std::string block) { return block.substr(0, 2) + std::string(block.size() - 2, '?'); };
  EXPECT_CONTAINS(refusal(zeros(1, 100, damaged)), "a damaged compressed block");
  EXPECT_CONTAINS(refusal(replaced(zeros(1, 100, damaged), "Components=\"100\"", "Components=\"90\"")),
                  "array \"z0\": 200 values; expected 2 with 90 components");
}

TEST(Vtu, IntegersOfTheCellDataRegionAreTheRegions) {
  const LoadedMesh loaded = load(kAscii);
  EXPECT_EQ(loaded.mesh.region_names, (std::vector<std::string>{"region-3", "region7"}));
  EXPECT_EQ(loaded.mesh.region_of, (std::vector<int>{1, 0}));
  ASSERT_TRUE(find_cell_data(loaded, "axis"));
  EXPECT_EQ(find_cell_data(loaded, "axis")->components, 3);
  EXPECT_EQ(find_cell_data(loaded, "axis")->values[4], 0.5);
}

TEST(Vtu, CellDataFollowTheTetsWhereOtherCellsAreIgnored) {
  std::string text = replaced(kAscii, "NumberOfCells=\"2\"", "NumberOfCells=\"3\"");
  text = replaced(text, "7 -3", "0 7 -3");
  text = replaced(text, "1 0 0 0 0.5 nan", "9 9 9 1 0 0 0 0.5 0");
  text = replaced(text, "0 1 2 3 1 2 3 4", "0 1 2 0 1 2 3 1 2 3 4");
  text = replaced(replaced(text, "4 8", "3 7 11"), "10 10", "5 10 10");
  const LoadedMesh loaded = load(text);
  EXPECT_EQ(find_cell_data(loaded, "axis")->values, (std::vector<double>{1, 0, 0, 0, 0.5, 0}));
  EXPECT_EQ(loaded.mesh.cells, load(kAscii).mesh.cells);
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(Vtu, TurnsElementsThatCountTheOtherWayRound) {
  const LoadedMesh loaded = load(replaced(kAscii, "0 1 2 3 1 2 3 4", "0 1 3 2 1 2 4 3"));
  EXPECT_EQ(loaded.mesh.cells, load(kAscii).mesh.cells);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_CONTAINS(loaded.warnings[0], "all 2 elements list their nodes in inverted order");
  const LoadedMesh one = load(replaced(kAscii, "0 1 2 3 1 2 3 4", "0 1 2 3 1 2 4 3"));
  EXPECT_EQ(one.mesh.cells, load(kAscii).mesh.cells);
  EXPECT_CONTAINS(one.warnings.at(0), "1 of 2 elements list their nodes in inverted order, the first is element 1");
}

struct BadVtu {
  const char *name, *from, *to, *message;
};
class RefusedVtu : public testing::TestWithParam<BadVtu> {};

TEST_P(RefusedVtu, SaysWhatIsWrongAndWhere) {
  const BadVtu& bad = GetParam();
  EXPECT_CONTAINS(refusal(replaced(kAscii, bad.from, bad.to)), bad.message);
}

INSTANTIATE_TEST_SUITE_P(
    Vtu, RefusedVtu,
    testing::Values(
        BadVtu{"polyhedron", "10 10", "10 42",
               "body.vtu: cell 1: a polyhedron (type 42); only tetrahedra, hexahedra, wedges and pyramids"},
        BadVtu{"second_order", "10 10", "10 24", "cell 1: a tetrahedron (type 24) of 4 points; expected 10"},
        BadVtu{"point", "2 3 4<", "2 3 5<", "body.vtu: element 1: a point is 5; expected an integer from 0 to 4"},
        BadVtu{"offset", "4 8", "4 9", "the offset of cell 1 is 9"},
        BadVtu{"count", "NumberOfCells=\"2\"", "NumberOfCells=\"3\"",
               "body.vtu:4: NumberOfCells=\"3\", but the arrays hold 2"},
        BadVtu{"short_data", "7 -3", "7", "array \"region\" has 1 values; expected 2 cells with 1 components"},
        BadVtu{"fraction", "7 -3", "7.5 -3", "cell data \"region\" of cell 0 is 7.5"},
        BadVtu{"word", "0 0 1 1 1 1<", "0 0 1 1 1 up<", "body.vtu:10: array \"\": expected a number, found \"up\""},
        BadVtu{"type", "Int32", "Int31", "body.vtu:6: array \"region\": unknown type \"Int31\""},
        BadVtu{"no_array", "Name=\"offsets\"", "Name=\"ends\"", "body.vtu:12: <Cells> has no array \"offsets\""},
        BadVtu{"polydata", "UnstructuredGrid", "PolyData",
               "a VTK file of type \"PolyData\"; expected UnstructuredGrid"},
        BadVtu{"compressor", "version=\"0.1\"", "compressor=\"vtkLZ4DataCompressor\"",
               "only vtkZLibDataCompressor is read"},
        BadVtu{"xml", "</Points>", "", "body.vtu:17: not well-formed XML"}),
    [](const auto& test) { return test.param.name; });

TEST(Vtk, RefusesWhatIsNoLegacyFileOfTets) {
  const auto refused = [](const std::string& text) { return refusal_of([&] { read_vtk_text("body.vtk", text); }); };
  const std::string good =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
      "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
  EXPECT_EQ(refused(good), "accepted");
  EXPECT_CONTAINS(refused("hello"), "body.vtk:1: no \"# vtk DataFile\"");
  EXPECT_CONTAINS(refused(replaced(good, "UNSTRUCTURED_GRID", "POLYDATA")), "body.vtk:4: DATASET \"POLYDATA\"");
  EXPECT_CONTAINS(refused(replaced(good, "CELLS 1 5", "CELLS 2 5")), "5 entries are too few for 2 cells");
  EXPECT_CONTAINS(refused(replaced(good, "POINTS 4", "POINTS 5")),
                  "body.vtk:7: expected a number (a finite number), found \"CELLS\"");
  EXPECT_CONTAINS(refused(good.substr(0, good.find("CELL_TYPES"))), "0 cell types, but 1 cell offsets");
  EXPECT_CONTAINS(refused(replaced(good, "\n10\n", "\n42\n")), "polyhedron");
}

// LOOKUP_TABLE is optional; without it, numbers start on the next line.
TEST(Vtk, ScalarsMayHaveNoLookupTable) {
  const std::string mesh =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
      "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
  const std::string data =
      "CELL_DATA 1\nSCALARS a float 1\n7\nSCALARS b float\nLOOKUP_TABLE default\n8\nSCALARS c int 2\n3 4\n";
  const LoadedMesh loaded = read_vtk_text("body.vtk", mesh + data);
  ASSERT_EQ(loaded.cell_data.size(), 3u);
  EXPECT_EQ(loaded.cell_data[0].values, std::vector<double>{7});
  EXPECT_EQ(loaded.cell_data[1].values, std::vector<double>{8});
  EXPECT_EQ(loaded.cell_data[2].values, (std::vector<double>{3, 4}));
}

}  // namespace
}  // namespace orthodyn::vtu_test
