// VTK's XML format, ASCII: exact to the last digit and readable by every version.
#include <fmt/format.h>

#include <iterator>

#include "lib/mesh/io/mesh_writer.h"

namespace orthodyn {
namespace {

std::string escaped(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '"') out += "&quot;";
    else out += c;
  }
  return out;
}

class Arrays {
 public:
  template <class Values>
  void add(const std::string& name, const char* type, int components, const Values& values) {
    fmt::format_to(std::back_inserter(text_),
                   "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type,
                   escaped(name), components);
    std::size_t count = 0;
    for (const auto value : values) {
      fmt::format_to(std::back_inserter(text_), "{}{}", value, ++count % 12 == 0 ? '\n' : ' ');
    }
    text_ += "\n</DataArray>\n";
  }
  void tag(const std::string& text) { text_ += text; }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

// As codes of characters, each name ended by a zero: not every reader takes arrays of strings.
void add_region_names(Arrays& arrays, const std::vector<std::string>& names) {
  std::size_t codes = names.size();
  for (const std::string& name : names) codes += name.size();
  arrays.tag(fmt::format("<FieldData>\n<DataArray type=\"UInt8\" Name=\"region_names\" NumberOfTuples=\"{}\" "
                         "format=\"ascii\">\n", codes));
  for (const std::string& name : names) {
    for (const char c : name) arrays.tag(fmt::format("{} ", static_cast<int>(static_cast<unsigned char>(c))));
    arrays.tag("0\n");
  }
  arrays.tag("</DataArray>\n</FieldData>\n");
}

}  // namespace

WrittenMesh write_vtu(const LoadedMesh& loaded) {
  const TetMesh& mesh = loaded.mesh;
  Arrays arrays;
  arrays.tag("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
             "<UnstructuredGrid>\n");
  add_region_names(arrays, mesh.region_names);
  arrays.tag(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n", mesh.nodes.size(), mesh.tets.size()));
  for (const auto& [name, nodes] : mesh.node_sets) {
    std::vector<int> inside(mesh.nodes.size(), 0);
    for (const int n : nodes) inside[static_cast<std::size_t>(n)] = 1;
    arrays.add("nodes:" + name, "UInt8", 1, inside);
  }
  arrays.tag("</PointData>\n<CellData>\n");
  arrays.add("region", "Int32", 1, mesh.region_of);
  for (const CellData& data : loaded.cell_data) {
    if (data.name != "region") arrays.add(data.name, "Float64", data.components, data.values);
  }
  std::vector<double> points;
  for (const Vec3& x : mesh.nodes) points.insert(points.end(), x.begin(), x.end());
  arrays.tag("</CellData>\n<Points>\n");
  arrays.add("Points", "Float64", 3, points);
  std::vector<int> connectivity, offsets;
  for (const Tet& t : mesh.tets) {
    connectivity.insert(connectivity.end(), t.begin(), t.end());
    offsets.push_back(static_cast<int>(connectivity.size()));
  }
  arrays.tag("</Points>\n<Cells>\n");
  arrays.add("connectivity", "Int32", 1, connectivity);
  arrays.add("offsets", "Int32", 1, offsets);
  arrays.add("types", "UInt8", 1, std::vector<int>(mesh.tets.size(), 10));
  arrays.tag("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  WrittenMesh written;
  written.files.push_back({".vtu", arrays.take()});
  note_loss(written, "surfaces", names_of(mesh.surfaces));
  note_loss(written, "materials", names_of(loaded.materials));
  return written;
}

}  // namespace orthodyn
