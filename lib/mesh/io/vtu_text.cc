#include "lib/mesh/io/vtu_text.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string_view>
#include <type_traits>
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

template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, float>) return "Float32";
  else if constexpr (std::is_same_v<T, double>) return "Float64";
  else if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  else return "UInt8";
}

// The XML, and the blocks of bytes that it points into: each has its length in front.
class VtuFile {
 public:
  explicit VtuFile(VtuStorage storage) : storage_(storage) {}

  void text(std::string_view xml) { xml_ += xml; }

  // As numbers of type T.
  template <class T, class Number>
  void array(const std::string& name, int components, const std::vector<Number>& values) {
    xml_ += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" ", type_name<T>(), escaped(name),
                        components);
    if (storage_ == VtuStorage::ascii) {
      add_ascii(values);
    } else {
      add_block<T>(values);
    }
  }

  void array(const VtuArray& data) {
    switch (data.type) {
      case VtuNumber::uint8: return array<std::uint8_t>(data.name, data.components, data.values);
      case VtuNumber::int32: return array<std::int32_t>(data.name, data.components, data.values);
      case VtuNumber::float32: return array<float>(data.name, data.components, data.values);
      case VtuNumber::float64: return array<double>(data.name, data.components, data.values);
    }
  }

  std::vector<std::string> finish() {
    if (storage_ == VtuStorage::ascii) return {std::move(xml_) + "</VTKFile>\n"};
    blocks_.insert(blocks_.begin(), std::move(xml_) + "<AppendedData encoding=\"raw\">\n_");
    blocks_.emplace_back("\n</AppendedData>\n</VTKFile>\n");
    return std::move(blocks_);
  }

 private:
  template <class Number>
  void add_ascii(const std::vector<Number>& values) {
    xml_ += "format=\"ascii\">\n";
    std::size_t count = 0;
    for (const Number value : values) {
      fmt::format_to(std::back_inserter(xml_), "{}", value);
      xml_ += ++count % 12 == 0 ? '\n' : ' ';
    }
    xml_ += "\n</DataArray>\n";
  }

  template <class T, class Number>
  void add_block(const std::vector<Number>& values) {
    xml_ += "format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
    const std::uint64_t bytes = values.size() * sizeof(T);
    std::string block(sizeof bytes + bytes, '\0');
    std::memcpy(block.data(), &bytes, sizeof bytes);
    char* place = block.data() + sizeof bytes;
    for (const Number value : values) {
      const T number = static_cast<T>(value);
      std::memcpy(place, &number, sizeof number);
      place += sizeof number;
    }
    offset_ += block.size();
    blocks_.push_back(std::move(block));
  }

  VtuStorage storage_;
  std::string xml_;
  std::vector<std::string> blocks_;
  std::size_t offset_ = 0;
};

void add_head(VtuFile& file, VtuStorage storage) {
  file.text("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" ");
  if (storage == VtuStorage::ascii) return file.text("version=\"0.1\" byte_order=\"LittleEndian\">\n");
  const bool little = std::endian::native == std::endian::little;
  file.text(fmt::format("version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n", little ? "LittleEndian" : "BigEndian"));
}

// As codes of characters, each name ended by a zero: not every reader takes arrays of strings.
void add_region_names(VtuFile& file, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::size_t codes = names.size();
  for (const std::string& name : names) codes += name.size();
  file.text(fmt::format("<FieldData>\n<DataArray type=\"UInt8\" Name=\"region_names\" NumberOfTuples=\"{}\" "
                        "format=\"ascii\">\n", codes));
  for (const std::string& name : names) {
    for (const char c : name) file.text(std::to_string(static_cast<unsigned char>(c)) + " ");
    file.text("0\n");
  }
  file.text("</DataArray>\n</FieldData>\n");
}

void add_points(VtuFile& file, const VtuGrid& grid, VtuStorage storage) {
  std::vector<double> points;
  points.reserve(3 * grid.points.size());
  for (const Vec3& x : grid.points) points.insert(points.end(), x.begin(), x.end());
  file.text("<Points>\n");
  file.array<double>(storage == VtuStorage::ascii ? "Points" : "points", 3, points);
  file.text("</Points>\n");
}

void add_cells(VtuFile& file, const VtuGrid& grid, std::size_t cells) {
  std::vector<int> offsets(cells);
  for (std::size_t c = 0; c < cells; ++c) offsets[c] = static_cast<int>((c + 1) * grid.points_per_cell);
  file.text("<Cells>\n");
  file.array<std::int32_t>("connectivity", 1, grid.connectivity);
  file.array<std::int32_t>("offsets", 1, offsets);
  file.array<std::uint8_t>("types", 1, std::vector<int>(cells, grid.cell_type));
  file.text("</Cells>\n");
}

}  // namespace

std::vector<std::string> vtu_text(const VtuGrid& grid, VtuStorage storage) {
  const std::size_t cells = grid.connectivity.size() / grid.points_per_cell;
  VtuFile file(storage);
  add_head(file, storage);
  file.text("<UnstructuredGrid>\n");
  add_region_names(file, grid.region_names);
  file.text(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n", grid.points.size(), cells));
  for (const VtuArray& data : grid.point_data) file.array(data);
  file.text("</PointData>\n<CellData>\n");
  for (const VtuArray& data : grid.cell_data) file.array(data);
  file.text("</CellData>\n");
  add_points(file, grid, storage);
  add_cells(file, grid, cells);
  file.text("</Piece>\n</UnstructuredGrid>\n");
  return file.finish();
}

}  // namespace orthodyn
