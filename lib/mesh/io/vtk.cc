#include "lib/mesh/io/vtk.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/io/vtk_grid.h"
#include "lib/mesh/io/vtu_bytes.h"

namespace orthodyn {
namespace {

class VtkReader {
 public:
  VtkReader(const std::string& path, std::string_view text) : tokens_(path, text), grid_{.path = path} {}

  VtkGrid read() {
    read_header();
    while (!tokens_.at_end()) read_section();
    return std::move(grid_);
  }

 private:
  void read_header() {
    if (tokens_.at_end() || !tokens_.rest_of_line().starts_with("# vtk DataFile"))
      tokens_.fail("no \"# vtk DataFile\": this is not a legacy VTK file (.vtk)");
    tokens_.skip_line();
    const int title_line = tokens_.line();
    std::string word = keyword();
    if (word != "ASCII" && word != "BINARY") {  // the title may be blank
      tokens_.skip_line();
      word = keyword();
    }
    if (word != "ASCII" && word != "BINARY") tokens_.fail_at(title_line, "expected a title and then ASCII or BINARY");
    binary_ = word == "BINARY";
    tokens_.finish_line();
    if (keyword() != "DATASET") tokens_.fail("expected DATASET");
    const std::string type = keyword();
    if (type != "UNSTRUCTURED_GRID") tokens_.fail("DATASET {}; expected UNSTRUCTURED_GRID", TextTokens::quoted(type));
    tokens_.finish_line();
  }

  std::string keyword() { return in_capitals(std::string(tokens_.word("a keyword"))); }

  void read_section() {
    const std::string word = keyword();
    if (word == "POINTS") {
      const std::uint64_t points = count("the number of points");
      grid_.points = read_array(points, 3);
    } else if (word == "CELLS") {
      read_cells();
    } else if (word == "CELL_TYPES") {
      const std::uint64_t cells = count("the number of cells");
      grid_.types = read_numbers(cells, {'i', 4});
    } else if (word == "CELL_DATA" || word == "POINT_DATA") {
      tuples_ = count("the number of values");
      target_ = word == "CELL_DATA" ? &grid_.cell_data : &grid_.point_data;
      tokens_.finish_line();
    } else if (word == "METADATA") {
      skip_to_blank_line();
    } else if (word == "FIELD") {
      read_field();
    } else if (word == "LOOKUP_TABLE") {
      tokens_.word("the name of a table");
      skip_colors(times(count("the number of colors"), 4));
    } else if (word == "COLOR_SCALARS") {
      tokens_.word("a name");
      skip_colors(times(tuples_, read_components()));
    } else {
      read_attribute(word);
    }
  }

  std::uint64_t count(const char* what) { return static_cast<std::uint64_t>(tokens_.count(what)); }

  bool next_line_begins(std::string_view word) const {
    const std::string_view rest = tokens_.rest_of_file();
    const std::size_t end = rest.find('\n');
    return end != std::string_view::npos && rest.substr(end + 1).starts_with(word);
  }

  // Up to version 4.2: "count size", then for each cell its number of points and the points. Later: "offsets entries",
  // then two arrays.
  void read_cells() {
    const std::uint64_t first = count("the number of cells");
    const std::uint64_t size = count("the number of entries");
    if (next_line_begins("OFFSETS")) {
      tokens_.finish_line();
      keyword();
      grid_.offsets = read_array(first, 1);
      if (!grid_.offsets.empty()) grid_.offsets.erase(grid_.offsets.begin());  // the leading zero
      if (keyword() != "CONNECTIVITY") tokens_.fail("expected CONNECTIVITY");
      grid_.connectivity = read_array(size, 1);
      return;
    }
    const std::vector<double> entries = read_numbers(size, {'i', 4});
    std::size_t at = 0;
    for (std::uint64_t c = 0; c < first; ++c) {
      if (at >= entries.size()) tokens_.fail("CELLS: {} entries are too few for {} cells", size, first);
      const double points = entries[at++];
      if (!(points >= 0 && points <= static_cast<double>(entries.size() - at)))
        tokens_.fail("CELLS: cell {} cannot have {} points; is the file damaged?", c, points);
      for (double k = 0; k < points; ++k) grid_.connectivity.push_back(entries[at++]);
      grid_.offsets.push_back(static_cast<double>(grid_.connectivity.size()));
    }
    if (at != entries.size()) tokens_.fail("CELLS: {} entries are too many for {} cells", size, first);
  }

  void read_attribute(const std::string& kind) {
    if (kind != "SCALARS" && kind != "VECTORS" && kind != "NORMALS" && kind != "TENSORS")
      tokens_.fail("unknown or unsupported keyword {}; save the file with plain scalars, vectors, tensors or fields",
                   TextTokens::quoted(kind));
    if (!target_) tokens_.fail("{} before CELL_DATA or POINT_DATA", kind);
    CellData data{.name = std::string(tokens_.word("a name"))};
    const VtkType type = read_type();
    data.components = kind == "SCALARS" ? 1 : kind == "TENSORS" ? 9 : 3;
    if (kind == "SCALARS" && tokens_.peek()) data.components = read_components();
    if (kind == "SCALARS" && next_line_begins("LOOKUP_TABLE")) {
      tokens_.finish_line();
      tokens_.word("LOOKUP_TABLE");
      tokens_.word("the name of a table");
    }
    data.values = read_numbers(times(tuples_, data.components), type);
    target_->push_back(std::move(data));
  }

  void read_field() {
    tokens_.word("a name");
    const std::uint64_t arrays = count("the number of arrays");
    tokens_.finish_line();
    for (std::uint64_t a = 0; a < arrays; ++a) {
      CellData data{.name = std::string(tokens_.word("a name"))};
      if (data.name == "METADATA") {
        skip_to_blank_line();
        --a;
        continue;
      }
      data.components = read_components();
      const std::uint64_t tuples = count("the number of values");
      data.values = read_numbers(times(tuples, data.components), read_type());
      if (target_ && tuples == tuples_)
        target_->push_back(std::move(data));  // otherwise the array belongs to the whole file
    }
  }

  // Colors are bytes in a binary file, real numbers in a text file.
  void skip_colors(std::uint64_t numbers) { read_numbers(numbers, {'u', 1}); }

  int read_components() {
    const std::int64_t components = tokens_.integer("the number of components");
    if (components < 1 || components > 1000) tokens_.fail("{} components", components);
    return static_cast<int>(components);
  }

  std::uint64_t times(std::uint64_t tuples, int components) const {
    if (tuples > (std::uint64_t{1} << 40)) tokens_.fail("{} values announced; is the file damaged?", tuples);
    return tuples * static_cast<std::uint64_t>(components);
  }

  VtkType read_type() {
    const std::string name(tokens_.word("a type"));
    const auto type = vtk_type(name);
    if (!type) tokens_.fail("unknown type {}", TextTokens::quoted(name));
    return *type;
  }

  std::vector<double> read_array(std::uint64_t tuples, int components) {
    const VtkType type = read_type();
    return read_numbers(times(tuples, components), type);
  }

  // Reads numbers that start on the next line.
  std::vector<double> read_numbers(std::uint64_t numbers, VtkType type) {
    return binary_ ? read_binary(numbers, type) : read_ascii(numbers);
  }

  std::vector<double> read_ascii(std::uint64_t numbers) {
    std::vector<double> out;
    tokens_.finish_line();
    for (std::uint64_t k = 0; k < numbers; ++k) {
      if (!tokens_.at_end() && tokens_.peek() == '\0') tokens_.skip_line();
      out.push_back(tokens_.real("a number"));
    }
    if (!tokens_.at_end() && tokens_.peek() == '\0') tokens_.skip_line();
    return out;
  }

  // Binary numbers are big-endian.
  std::vector<double> read_binary(std::uint64_t numbers, VtkType type) {
    const std::string_view rest = tokens_.rest_of_file();
    const std::size_t begin = std::min(rest.find('\n'), rest.size());
    const std::size_t available = rest.size() - std::min(begin + 1, rest.size());
    if (numbers > available / type.width)
      tokens_.fail("{} binary numbers announced, but the file ends before; is it truncated?", numbers);
    const std::size_t bytes = static_cast<std::size_t>(numbers) * type.width;
    std::string block(rest.substr(std::min(begin + 1, rest.size()), bytes));
    tokens_.skip_bytes(begin + 1 + bytes);
    if (std::endian::native == std::endian::little) swap_bytes(block, type.width);
    return vtk_numbers(block, type);
  }

  void skip_to_blank_line() {
    const std::string_view rest = tokens_.rest_of_file();
    const std::size_t blank = std::min(rest.find("\n\n"), rest.find("\n\r\n"));
    tokens_.skip_bytes(std::min(blank, rest.size()));
  }

  TextTokens tokens_;
  VtkGrid grid_;
  bool binary_ = false;
  std::uint64_t tuples_ = 0;
  std::vector<CellData>* target_ = nullptr;
};

const bool vtk_registered = register_mesh_format({.name = "VTK legacy", .endings = {".vtk"}, .read = read_vtk});

}  // namespace

LoadedMesh read_vtk(const std::string& path, FileCells cells) {
  return read_vtk_text(path, read_text_file(path), cells);
}

LoadedMesh read_vtk_text(const std::string& path, std::string_view text, FileCells cells) {
  return build_vtk_mesh(VtkReader(path, text).read(), cells);
}

}  // namespace orthodyn
