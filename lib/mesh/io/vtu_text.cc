#include "lib/mesh/io/vtu_text.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string_view>
#include <utility>

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

constexpr std::array<const char*, 4> kTypeNames{"UInt8", "Int32", "Float32", "Float64"};  // in the order of VtuNumber

// The number of bytes, then the values as numbers of type T.
template <class T>
std::string block_of(const std::vector<double>& values) {
  const std::uint64_t bytes = values.size() * sizeof(T);
  std::string block(sizeof bytes + bytes, '\0');
  std::memcpy(block.data(), &bytes, sizeof bytes);
  char* place = block.data() + sizeof bytes;
  for (const double value : values) {
    const T number = static_cast<T>(value);
    std::memcpy(place, &number, sizeof number);
    place += sizeof number;
  }
  return block;
}

std::string block_of(const VtuArray& data) {
  switch (data.type) {
    case VtuNumber::uint8: return block_of<std::uint8_t>(data.values);
    case VtuNumber::int32: return block_of<std::int32_t>(data.values);
    case VtuNumber::float32: return block_of<float>(data.values);
    case VtuNumber::float64: break;
  }
  return block_of<double>(data.values);
}

// The XML text and the blocks of appended bytes that it refers to.
class VtuFile {
 public:
  explicit VtuFile(VtuStorage storage) : ascii_(storage == VtuStorage::ascii) {
    const bool little = ascii_ || std::endian::native == std::endian::little;
    xml_ = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"{}\" byte_order=\"{}\"{}>\n",
        ascii_ ? "0.1" : "1.0", little ? "LittleEndian" : "BigEndian", ascii_ ? "" : " header_type=\"UInt64\"");
  }

  void text(std::string_view xml) { xml_ += xml; }

  void array(const VtuArray& data) {
    xml_ += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" ",
                        kTypeNames[static_cast<std::size_t>(data.type)], escaped(data.name), data.components);
    if (ascii_) return add_ascii(data.values);
    xml_ += "format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
    blocks_.push_back(block_of(data));
    offset_ += blocks_.back().size();
  }

  std::vector<std::string> finish() {
    if (ascii_) return {std::move(xml_) + "</VTKFile>\n"};
    blocks_.insert(blocks_.begin(), std::move(xml_) + "<AppendedData encoding=\"raw\">\n_");
    blocks_.emplace_back("\n</AppendedData>\n</VTKFile>\n");
    return std::move(blocks_);
  }

 private:
  void add_ascii(const std::vector<double>& values) {
    xml_ += "format=\"ascii\">\n";
    std::size_t count = 0;
    for (const double value : values) {
      fmt::format_to(std::back_inserter(xml_), "{}", value);
      xml_ += ++count % 12 == 0 ? '\n' : ' ';
    }
    xml_ += "\n</DataArray>\n";
  }

  bool ascii_;
  std::string xml_;
  std::vector<std::string> blocks_;
  std::size_t offset_ = 0;
};

// Character codes with a zero after each name: not every reader supports string arrays.
void add_region_names(VtuFile& file, const std::vector<std::string>& names) {
  if (names.empty()) return;
  file.text(
      fmt::format("<FieldData>\n<Array type=\"String\" Name=\"region_names\" NumberOfTuples=\"{}\" format=\"ascii\">\n",
                  names.size()));
  for (const std::string& name : names) {
    for (const char c : name) file.text(std::to_string(static_cast<unsigned char>(c)) + " ");
    file.text("0\n");
  }
  file.text("</Array>\n</FieldData>\n");
}

void add_points(VtuFile& file, const VtuGrid& grid, VtuStorage storage) {
  VtuArray points{.name = storage == VtuStorage::ascii ? "Points" : "points", .components = 3};
  points.values.reserve(3 * grid.points.size());
  for (const Vec3& x : grid.points) points.values.insert(points.values.end(), x.begin(), x.end());
  file.text("<Points>\n");
  file.array(points);
  file.text("</Points>\n");
}

void add_cells(VtuFile& file, const Cells& cells) {
  std::vector<double> ends, types;
  double end = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    ends.push_back(end += static_cast<double>(cells[c].size()));
    types.push_back(topology(cells.shape(c)).vtk_type);
  }
  file.text("<Cells>\n");
  file.array({"connectivity", 1, VtuNumber::int32, {cells.nodes().begin(), cells.nodes().end()}});
  file.array({"offsets", 1, VtuNumber::int32, std::move(ends)});
  file.array({"types", 1, VtuNumber::uint8, std::move(types)});
  file.text("</Cells>\n");
}

}  // namespace

std::vector<std::string> vtu_text(const VtuGrid& grid, VtuStorage storage) {
  VtuFile file(storage);
  file.text("<UnstructuredGrid>\n");
  add_region_names(file, grid.region_names);
  file.text(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n", grid.points.size(),
                        grid.cells.size()));
  for (const VtuArray& data : grid.point_data) file.array(data);
  file.text("</PointData>\n<CellData>\n");
  for (const VtuArray& data : grid.cell_data) file.array(data);
  file.text("</CellData>\n");
  add_points(file, grid, storage);
  add_cells(file, grid.cells);
  file.text("</Piece>\n</UnstructuredGrid>\n");
  return file.finish();
}

}  // namespace orthodyn
