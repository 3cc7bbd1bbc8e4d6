#include "lib/mesh/io/vega_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "lib/mesh/io/text_tokens.h"

namespace orthodyn {
namespace {

constexpr Punctuation kPunctuation{.commas = true, .comment = "#"};
constexpr std::size_t kMaxIncludes = 1000;
// A file may be included several times, within a bound on memory: included bytes <= kFreeIncludedBytes +
// kMaxIncludeRatio * (bytes of distinct files).
constexpr std::uintmax_t kMaxIncludeRatio = 10;
constexpr std::uintmax_t kFreeIncludedBytes = 1'000'000;

enum class Section { none, vertices, element_type, elements, set, material, region };

// The path without "./", "..", and links.
std::string canonical_path(const std::string& path) {
  std::error_code error;
  const std::string canonical = std::filesystem::weakly_canonical(path, error).string();
  return error ? path : canonical;
}

// Vega ignores blanks in names.
std::string name_on_line(TextTokens& tokens) {
  std::string name;
  while (tokens.peek() != '\0') name += tokens.word("a name");
  return name;
}

class VegaReader {
 public:
  VegaFile read(const std::string& path, std::string_view text) {
    file_.draft.nodes_section = "*VERTICES";
    read_lines(path, text);
    finish_section(last_);
    if (!has_vertices_ || !has_elements_)
      file_.draft.fail(last_, "the file ends without *{}; is it truncated?", has_vertices_ ? "ELEMENTS" : "VERTICES");
    return std::move(file_);
  }

 private:
  void read_lines(const std::string& path, std::string_view text) {
    const int number = static_cast<int>(file_.draft.files.size());
    file_.draft.files.push_back(path);
    const std::string canonical = canonical_path(path);
    open_files_.push_back(canonical);
    if (known_files_.insert(canonical).second) known_bytes_ += text.size();
    TextTokens tokens(path, text, kPunctuation);
    while (!tokens.at_end()) {
      last_ = {tokens.line(), number};
      if (tokens.peek() == '*') {
        read_keyword(tokens);
      } else {
        read_data(tokens);
      }
    }
    open_files_.pop_back();
  }

  void read_keyword(TextTokens& tokens) {
    const FilePlace place = last_;
    const std::string keyword(tokens.word("a keyword"));
    if (keyword == "*INCLUDE") return include(tokens);
    finish_section(place);
    section_place_ = place;
    if (keyword == "*VERTICES") {
      begin_once(has_vertices_, "*VERTICES", Section::vertices);
    } else if (keyword == "*ELEMENTS") {
      begin_once(has_elements_, "*ELEMENTS", Section::element_type);
    } else if (keyword == "*SET") {
      section_ = Section::set;
      begin_set(name_on_line(tokens), place);
      if (file_.sets[set_].name.empty()) tokens.fail("*SET without a name");
    } else if (keyword == "*MATERIAL") {
      section_ = Section::material;
      material_name_ = name_on_line(tokens);
      if (material_name_.empty()) tokens.fail("*MATERIAL without a name");
    } else if (keyword == "*REGION") {
      section_ = Section::region;
    } else {
      tokens.fail("unknown keyword {}; known: *VERTICES, *ELEMENTS, *MATERIAL, *SET, *REGION, *INCLUDE",
                  TextTokens::quoted(keyword));
    }
    tokens.finish_line();
  }

  // A second *SET of a name continues the first.
  void begin_set(const std::string& name, FilePlace place) {
    const auto same =
        std::find_if(file_.sets.begin(), file_.sets.end(), [&](const VegaSet& s) { return s.name == name; });
    set_ = static_cast<std::size_t>(same - file_.sets.begin());
    if (same == file_.sets.end()) {
      file_.sets.push_back({name, {}, place});
    } else {
      file_.draft.warn(place, "a second *SET {}: its elements are added to those of line {}", TextTokens::quoted(name),
                       same->place.line);
    }
  }

  void begin_once(bool& seen, const char* keyword, Section section) {
    if (seen) file_.draft.fail(section_place_, "a second {}", keyword);
    seen = true;
    section_ = section;
    announced_ = -1;
  }

  void include(TextTokens& tokens) {
    namespace fs = std::filesystem;
    const std::string name(tokens.word("a file name"));
    const std::string path = (fs::path(tokens.path()).parent_path() / name).string();
    if (std::count(open_files_.begin(), open_files_.end(), canonical_path(path)) > 0)
      tokens.fail("{} includes itself", TextTokens::quoted(name));
    if (file_.draft.files.size() >= kMaxIncludes) tokens.fail("more than {} included files", kMaxIncludes);
    std::error_code error;  // so that nothing is thrown, even for a name that is too long
    if (!fs::is_regular_file(path, error)) tokens.fail("*INCLUDE {}: no such file: {}", TextTokens::quoted(name), path);
    tokens.finish_line();
    const std::string text = read_text_file(path);
    included_bytes_ += text.size();
    if (included_bytes_ > kFreeIncludedBytes + kMaxIncludeRatio * (known_bytes_ + text.size()))
      tokens.fail("*INCLUDE {}: the included text is more than {} times the size of the files; include each file once",
                  TextTokens::quoted(name), kMaxIncludeRatio);
    read_lines(path, text);
  }

  void read_data(TextTokens& tokens) {
    switch (section_) {
      case Section::none:
        tokens.fail("expected a keyword (*VERTICES), found {}; this is not a Vega mesh file (.veg)",
                    TextTokens::quoted(tokens.word("a keyword")));
      case Section::vertices: return read_vertex(tokens);
      case Section::element_type: return read_element_type(tokens);
      case Section::elements: return read_element(tokens);
      case Section::set: return read_set(tokens);
      case Section::material: return read_material(tokens);
      case Section::region: return read_region(tokens);
    }
  }

  // "count 3 0 0" for vertices, "count 4 0" or "count 8 0" for elements; only the first two numbers are used.
  void read_header(TextTokens& tokens, const char* what, std::size_t width) {
    announced_ = tokens.count(what);
    if (tokens.peek() != '\0') {
      const std::int64_t found = tokens.integer("the numbers per line");
      if (found != static_cast<std::int64_t>(width)) tokens.fail("{} numbers per line; expected {}", found, width);
    }
    tokens.skip_line();
  }

  // The first column: consecutive numbers from 0 or 1.
  std::int64_t read_number(TextTokens& tokens, const char* what, std::size_t done, std::int64_t& first) {
    if (static_cast<std::int64_t>(done) >= announced_) {
      const char* records = section_ == Section::vertices ? "vertices" : "elements";
      tokens.fail("more than the {} {} announced after line {}", announced_, records, section_place_.line);
    }
    const std::int64_t number = tokens.integer(what);
    if (done == 0) {
      if (number != 0 && number != 1) tokens.fail("the first {} is {}; numbers must start at 0 or 1", what, number);
      first = number;
    }
    const std::int64_t expected = first + static_cast<std::int64_t>(done);
    if (number != expected)
      tokens.fail("{} {} where {} is expected; numbers must have no gaps", what, number, expected);
    return number;
  }

  void read_vertex(TextTokens& tokens) {
    if (announced_ < 0) return read_header(tokens, "the number of vertices", 3);
    FileNode node{.place = last_};
    node.tag = read_number(tokens, "vertex", file_.draft.nodes.size(), first_vertex_);
    for (double& x : node.x) x = tokens.real("a coordinate");
    tokens.finish_line();
    file_.draft.nodes.push_back(node);
  }

  void read_element_type(TextTokens& tokens) {
    const std::string type(tokens.word("TET"));
    if (type != "TET" && type != "TETS" && type != "CUBIC")
      tokens.fail("element type {}; expected TET or CUBIC", TextTokens::quoted(type));
    kind_ = type == "CUBIC" ? CellKind::hexahedron : CellKind::tet;
    tokens.finish_line();
    section_ = Section::elements;
  }

  void read_element(TextTokens& tokens) {
    if (announced_ < 0) return read_header(tokens, "the number of elements", corners_of(kind_));
    FileCell cell{.kind = kind_, .place = last_};
    cell.tag = read_number(tokens, "element", file_.draft.cells.size(), file_.first_element);
    for (std::int64_t& node : cell.corners()) node = tokens.integer("a vertex");
    tokens.finish_line();
    file_.draft.cells.push_back(cell);
  }

  void read_set(TextTokens& tokens) {
    while (tokens.peek() != '\0') file_.sets[set_].elements.push_back({tokens.integer("an element"), last_});
    tokens.skip_line();
  }

  void read_material(TextTokens& tokens) {
    MeshMaterial material = read_vega_material(tokens, material_name_, file_.draft.warnings);
    if (!file_.materials.emplace(material_name_, std::move(material)).second)
      file_.draft.fail(section_place_, "a second *MATERIAL {}", TextTokens::quoted(material_name_));
    section_ = Section::none;
  }

  void read_region(TextTokens& tokens) {
    VegaRegion region{.set = std::string(tokens.word("a set")), .material = name_on_line(tokens), .place = last_};
    if (region.material.empty()) tokens.fail("expected \"set, material\"; the material is missing");
    tokens.finish_line();
    file_.regions.push_back(std::move(region));
    section_ = Section::none;
  }

  void finish_section(FilePlace next) {
    const auto expect = [&](const char* keyword, const char* what, std::size_t found) {
      if (announced_ < 0)
        file_.draft.fail(next, "{} (line {}) ends without its count of {}", keyword, section_place_.line, what);
      if (static_cast<std::int64_t>(found) == announced_) return;
      file_.draft.fail(next, "{} of the {} {} announced after line {}; is the file truncated?", found, announced_, what,
                       section_place_.line);
    };
    switch (section_) {
      case Section::vertices: expect("*VERTICES", "vertices", file_.draft.nodes.size()); break;
      case Section::elements: expect("*ELEMENTS", "elements", file_.draft.cells.size()); break;
      case Section::element_type:
      case Section::material:
      case Section::region:
        file_.draft.fail(next, "the section of line {} is empty; is the file truncated?", section_place_.line);
      case Section::none:
      case Section::set: break;
    }
    section_ = Section::none;
  }

  VegaFile file_;
  std::vector<std::string> open_files_;
  std::set<std::string> known_files_;
  std::uintmax_t known_bytes_ = 0, included_bytes_ = 0;  // bytes of distinct files; of all *INCLUDEs
  Section section_ = Section::none;
  FilePlace section_place_, last_;
  bool has_vertices_ = false, has_elements_ = false;
  std::int64_t announced_ = -1;    // -1: not read yet
  CellKind kind_ = CellKind::tet;  // of all elements
  std::int64_t first_vertex_ = 1;
  std::string material_name_;
  std::size_t set_ = 0;  // index of the current set
};

}  // namespace

VegaFile read_vega_sections(const std::string& path, std::string_view text) { return VegaReader().read(path, text); }

}  // namespace orthodyn
