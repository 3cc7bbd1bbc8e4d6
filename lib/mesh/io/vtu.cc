#include "lib/mesh/io/vtu.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <pugixml.hpp>
#include <stdexcept>
#include <utility>

#include "lib/core/errors.h"
#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/io/vtk_grid.h"
#include "lib/mesh/io/vtu_bytes.h"
#include "lib/mesh/io/vtu_text.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {
namespace {

// Bound on the unpacked size of all arrays, relative to the file size: zlib packs zeros about 1000:1. The bound is on
// the sum, because arrays may share their bytes.
constexpr std::uint64_t kMaxUnpackRatio = 1000;
constexpr std::uint64_t kFreeUnpackedBytes = 1'000'000;

class VtuReader {
 public:
  VtuReader(const std::string& path, std::string_view text)
      : path_(path), text_(text), budget_(kFreeUnpackedBytes + kMaxUnpackRatio * text.size()) {}

  VtkGrid read() {
    split_appended_data();
    const pugi::xml_parse_result parsed =
        document_.load_buffer(xml_.data(), xml_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed) fail_at(parsed.offset, "not well-formed XML ({}); is the file truncated?", parsed.description());
    const pugi::xml_node file = document_.child("VTKFile");
    if (!file) throw ConfigError(path_, "no <VTKFile>: this is not a VTK XML file (.vtu)");
    read_encoding(file);
    return read_grid(file);
  }

 private:
  // Raw data are not XML: cuts them off and closes the document.
  void split_appended_data() {
    const std::size_t tag = text_.find("<AppendedData");
    const std::size_t close = text_.find('>', tag == std::string_view::npos ? text_.size() : tag);
    if (close == std::string_view::npos) {
      xml_ = std::string(text_);
      return;
    }
    xml_ = std::string(text_.substr(0, close + 1)) + "</AppendedData></VTKFile>";
    const std::size_t mark = text_.find('_', close);
    if (mark == std::string_view::npos)
      fail_at(static_cast<std::ptrdiff_t>(tag), "<AppendedData> without its mark \"_\"; is the file truncated?");
    appended_ = text_.substr(mark + 1);
  }

  void read_encoding(const pugi::xml_node& file) {
    const std::string type = file.attribute("type").value();
    if (type != "UnstructuredGrid")
      fail(file, "a VTK file of type {}; expected UnstructuredGrid", TextTokens::quoted(type));
    const std::string order = file.attribute("byte_order").as_string("LittleEndian");
    encoding_.swap = (order == "BigEndian") != (std::endian::native == std::endian::big);
    const std::string header = file.attribute("header_type").as_string("UInt32");
    if (header != "UInt32" && header != "UInt64")
      fail(file, "header_type {}; expected UInt32 or UInt64", TextTokens::quoted(header));
    encoding_.header_width = header == "UInt32" ? 4 : 8;
    const std::string compressor = file.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
      fail(file, "compressor {}; only vtkZLibDataCompressor is read: save again with zlib or without compression",
           TextTokens::quoted(compressor));
    encoding_.zlib = !compressor.empty();
    const std::string appended = file.child("AppendedData").attribute("encoding").as_string("base64");
    appended_base64_ = appended != "raw";
  }

  VtkGrid read_grid(const pugi::xml_node& file) {
    const pugi::xml_node grid_node = child(file, "UnstructuredGrid");
    const pugi::xml_node piece = child(grid_node, "Piece");
    if (piece.next_sibling("Piece"))
      fail(piece, "several pieces; only one is read: merge them (ParaView: Merge Blocks, Clean to Grid)");
    VtkGrid grid{.path = path_};
    grid.points = read_array(child(child(piece, "Points"), "DataArray")).values;
    const pugi::xml_node cells = child(piece, "Cells");
    grid.connectivity = read_array(named(cells, "connectivity")).values;
    grid.offsets = read_array(named(cells, "offsets")).values;
    grid.types = read_array(named(cells, "types")).values;
    check_count(piece, "NumberOfPoints", grid.points.size() / 3);
    check_count(piece, "NumberOfCells", grid.types.size());
    for (const pugi::xml_node& array : piece.child("CellData").children("DataArray"))
      grid.cell_data.push_back(read_array(array, grid.types.size()));
    for (const pugi::xml_node& array : piece.child("PointData").children("DataArray"))
      if (std::string_view(array.attribute("Name").value()).starts_with("nodes:"))
        grid.point_data.push_back(read_array(array, grid.points.size() / 3));
    for (const pugi::xml_node& array : grid_node.child("FieldData").children())
      if (std::string_view(array.attribute("Name").value()) == "region_names") read_region_names(array, grid);
    return grid;
  }

  // Character codes, with a zero after each name.
  void read_region_names(const pugi::xml_node& array, VtkGrid& grid) {
    std::string name;
    for (const double code : read_array(array).values) {
      if (code != 0) {
        name += static_cast<char>(static_cast<int>(std::clamp(code, -128.0, 255.0)));
      } else {
        grid.region_names.push_back(std::exchange(name, {}));
      }
    }
  }

  void check_count(const pugi::xml_node& piece, const char* attribute, std::size_t found) const {
    const pugi::xml_attribute given = piece.attribute(attribute);
    if (given && given.as_ullong() != found)
      fail(piece, "{}=\"{}\", but the arrays hold {}", attribute, given.value(), found);
  }

  // `tuples`: the expected number of tuples, if known.
  CellData read_array(const pugi::xml_node& array, std::optional<std::size_t> tuples = {}) {
    const std::string name = array.attribute("Name").value();
    CellData data{.name = name, .components = array.attribute("NumberOfComponents").as_int(1)};
    if (data.components < 1)
      fail(array, "array {}: {} components; there must be at least 1", TextTokens::quoted(name), data.components);
    try {
      data.values = read_values(array, data.components, tuples);
    } catch (const std::runtime_error& error) {
      fail(array, "array {}: {}", TextTokens::quoted(name), error.what());
    }
    return data;
  }

  void admit(std::uint64_t values, int components, std::optional<std::size_t> tuples) {
    const auto width = static_cast<std::uint64_t>(components);
    if (tuples && (values % width != 0 || values / width != *tuples))
      throw std::runtime_error(fmt::format("{} values; expected {} with {} components", values, *tuples, components));
    if (values > budget_ / sizeof(double))
      throw std::runtime_error(
          fmt::format("the arrays unpack to more than {} times the size of the file; do several share an offset? Write "
                      "each separately",
                      kMaxUnpackRatio));
    budget_ -= values * sizeof(double);
  }

  std::vector<double> read_values(const pugi::xml_node& array, int components, std::optional<std::size_t> tuples) {
    const std::string type_name = array.attribute("type").value();
    const auto type = vtk_type(type_name);
    if (!type) throw std::runtime_error("unknown type " + TextTokens::quoted(type_name));
    const std::string format = array.attribute("format").as_string("ascii");
    if (format == "ascii") return vtk_numbers(std::string_view(array.child_value()));
    const auto admit_bytes = [&](std::uint64_t bytes) { admit(bytes / type->width, components, tuples); };
    VtuEncoding encoding = encoding_;
    std::string bytes;
    if (format == "appended") {
      encoding.base64 = appended_base64_;
      const std::uint64_t offset = array.attribute("offset").as_ullong();
      if (offset >= appended_.size())
        throw std::runtime_error(fmt::format("offset {} is beyond the end of the file; is it truncated?", offset));
      bytes = vtu_bytes(appended_.substr(static_cast<std::size_t>(offset)), encoding, admit_bytes);
    } else if (format == "binary") {
      encoding.base64 = true;
      bytes = vtu_bytes(array.child_value(), encoding, admit_bytes);
    } else {
      throw std::runtime_error("unknown format " + TextTokens::quoted(format));
    }
    if (bytes.size() % type->width != 0)
      throw std::runtime_error(fmt::format("{} bytes are not whole numbers of type {}", bytes.size(), type_name));
    if (encoding.swap) swap_bytes(bytes, type->width);
    return vtk_numbers(bytes, *type);
  }

  pugi::xml_node child(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node found = parent.child(name);
    if (!found) fail(parent, "<{}> has no <{}>", parent.name(), name);
    return found;
  }

  pugi::xml_node named(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node found = parent.find_child_by_attribute("DataArray", "Name", name);
    if (!found) fail(parent, "<{}> has no array \"{}\"", parent.name(), name);
    return found;
  }

  template <class... Args>
  [[noreturn]] void fail(const pugi::xml_node& node, fmt::format_string<Args...> message, Args&&... args) const {
    fail_at(node.offset_debug(), message, std::forward<Args>(args)...);
  }
  // Throws a ConfigError at a byte offset of the file; -1 for unknown.
  template <class... Args>
  [[noreturn]] void fail_at(std::ptrdiff_t offset, fmt::format_string<Args...> message, Args&&... args) const {
    const auto end = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
    const std::string_view before = text_.substr(0, std::min(end, text_.size()));
    throw ConfigError(fmt::format("{}:{}", path_, 1 + std::count(before.begin(), before.end(), '\n')),
                      fmt::format(message, std::forward<Args>(args)...));
  }

  std::string path_;
  std::string_view text_, appended_;
  std::string xml_;
  pugi::xml_document document_;
  VtuEncoding encoding_;
  bool appended_base64_ = false;
  std::uint64_t budget_;  // unpacked bytes still allowed
};

VtuArray membership(const std::string& name, const std::vector<int>& nodes, std::size_t num_nodes) {
  VtuArray inside{.name = "nodes:" + name, .type = VtuNumber::uint8, .values = std::vector<double>(num_nodes, 0)};
  for (const int n : nodes) inside.values[static_cast<std::size_t>(n)] = 1;
  return inside;
}

const bool vtu_registered = register_mesh_format({.name = "VTK XML",
                                                  .endings = {".vtu"},
                                                  .read = read_vtu,
                                                  .write = write_vtu,
                                                  .holds_surfaces = false,
                                                  .holds_cell_data = true});

}  // namespace

LoadedMesh read_vtu(const std::string& path, FileCells cells) {
  return read_vtu_text(path, read_text_file(path), cells);
}

LoadedMesh read_vtu_text(const std::string& path, std::string_view text, FileCells cells) {
  return build_vtk_mesh(VtuReader(path, text).read(), cells);
}

WrittenMesh write_vtu(const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  VtuGrid grid{.points = mesh.nodes, .cells = mesh.cells};
  for (const auto& [name, nodes] : mesh.node_sets)
    grid.point_data.push_back(membership(name, nodes, mesh.nodes.size()));
  grid.cell_data.push_back(
      {.name = "region", .type = VtuNumber::int32, .values = {mesh.region_of.begin(), mesh.region_of.end()}});
  for (const CellData& data : loaded.cell_data) {
    if (data.name == "region") continue;
    grid.cell_data.push_back({.name = data.name, .components = data.components, .values = data.values});
  }
  grid.region_names = mesh.region_names;
  return {.files = {{".vtu", std::move(vtu_text(grid, VtuStorage::ascii).front())}}};
}

}  // namespace orthodyn
