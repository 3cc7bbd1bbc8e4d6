// An Abaqus input file line by line: keyword lines with their parameters, and lines of data. Files that *INCLUDE and
// INPUT= name are read in their place.
//
// Syntax: Abaqus analysis user's guide, "Input syntax rules". Blanks within keywords and names of parameters do not
// matter, nor do capitals.
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lib/mesh/io/text_tokens.h"
#include "lib/mesh/mesh_draft.h"

namespace orthodyn {

// "*ELEMENT, TYPE=C3D4, ELSET=body"
struct AbaqusKeyword {
  std::string name = {};                               // in capitals, without the star and blanks: "SOLIDSECTION"
  std::string spelled = {};                            // for messages: "*SOLID SECTION"
  std::map<std::string, std::string> parameters = {};  // by name in capitals without blanks; "" of those without value
  FilePlace place = {};
  bool is_read = false;  // abaqus_parameters.h has it

  bool has(const std::string& key) const { return parameters.contains(key); }
  std::string parameter(const std::string& key) const {
    const auto found = parameters.find(key);
    return found == parameters.end() ? "" : found->second;
  }
};

// In capitals and without blanks.
std::string abaqus_word(std::string_view text);

// A field as a finite number, which may have Fortran's D for the exponent; zero where it is empty, none if it is none.
std::optional<double> abaqus_number(std::string_view field);

class AbaqusLines {
 public:
  // Of the first file of the draft, to which those that are included are added. Draft and text must outlive this.
  AbaqusLines(MeshDraft& draft, std::string_view text);

  // Whether no line of data comes next; also true at the end.
  bool at_keyword();
  bool at_end();

  // Precondition: at_keyword(), and not at the end. Refuses parameters by abaqus_parameters.h.
  AbaqusKeyword keyword();

  // The next line of data: what stands between its commas, without blanks and quotes around it; fields at the end that
  // are empty are left out. Valid until the next call. Precondition: not at_keyword().
  const std::vector<std::string_view>& data();
  FilePlace place() const { return place_; }  // of the line that was last taken

  void skip_data();

  // The value of a parameter that the keyword must have, such as NAME. Throws ConfigError.
  std::string name_of(const AbaqusKeyword& keyword, const char* parameter = "NAME") const;
  // One of the values of a parameter, which may be shortened; the first without the parameter. Throws ConfigError.
  std::string choice(const AbaqusKeyword& keyword, const char* parameter, const std::vector<std::string>& values) const;

  // Of the next line.
  std::string_view rest_of_line() const { return sources_.back().tokens.rest_of_line(); }

  // Fields of the last line of data as numbers. An empty or missing real number is zero.
  std::size_t size() const { return fields_.size(); }
  std::int64_t integer(std::string_view field, const char* what) const;
  double real(std::size_t field, const char* what) const;

  // A place to which a reader may go back, as often as it likes: enter() goes there, leave() back to where it was.
  struct Source {
    TextTokens tokens;
    int file;
    bool only_data;  // of INPUT=
  };
  using Mark = std::vector<Source>;
  Mark mark() const { return sources_; }
  void enter(const Mark& mark);
  void leave();

  [[noreturn]] void fail(const std::string& message) const { draft_.fail(place_, message); }

 private:
  void settle();
  AbaqusKeyword take_keyword();
  void open(const std::string& file, const AbaqusKeyword& keyword, bool only_data);

  MeshDraft& draft_;
  std::string folder_;  // of the first file
  std::vector<Source> sources_;
  std::vector<Mark> left_;
  std::map<std::string, std::pair<int, std::string>> texts_;  // by path: index among the files, content
  std::vector<std::string_view> fields_;
  FilePlace place_;
  int opened_ = 0;
};

}  // namespace orthodyn
