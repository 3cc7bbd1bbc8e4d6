// Reads an Abaqus input file line by line: keyword lines with parameters, and data lines. Files named by *INCLUDE and
// INPUT= are read in place.
//
// Syntax: Abaqus analysis user's guide, "Input syntax rules". Blanks and case do not matter in keywords and parameter
// names.
#pragma once

#include <cstdint>
#include <functional>
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
  std::map<std::string, std::string> parameters = {};  // by name in capitals without blanks; "" if it has no value
  FilePlace place = {};
  bool is_read = false;  // false: the keyword is skipped

  bool has(const std::string& key) const { return parameters.contains(key); }
  std::string parameter(const std::string& key) const {
    const auto found = parameters.find(key);
    return found == parameters.end() ? "" : found->second;
  }
};

// The text in capitals and without blanks.
std::string abaqus_word(std::string_view text);

// A field as a number, possibly with Fortran's exponent D. Zero if the field is empty; nullopt if it is not a finite
// number.
std::optional<double> abaqus_number(std::string_view field);

// Whether a field is a name (begins with a letter or _), not a number.
bool abaqus_is_name(std::string_view field);

// Checks the parameters of a keyword against the table in abaqus_parameters.cc, where each parameter is used, harmless
// or unsupported. Calls `fail` with a message for unsupported and unknown parameters. Returns false for keywords that
// are skipped; these may have any parameters.
bool check_abaqus_parameters(const AbaqusKeyword& keyword, const std::function<void(const std::string&)>& fail);

class AbaqusLines {
 public:
  // `text` is the content of the draft's first file; included files are added to the draft. Both arguments must
  // outlive this object.
  AbaqusLines(MeshDraft& draft, std::string_view text);

  // True if the next line is a keyword or the end of the input.
  bool at_keyword();
  bool at_end();

  // Reads a keyword and checks its parameters. Precondition: at_keyword() and not at_end(). Throws ConfigError.
  AbaqusKeyword keyword();

  // The comma-separated fields of the next data line, without surrounding blanks and quotes and without empty fields at
  // the end. Valid until the next call. Precondition: not at_keyword().
  const std::vector<std::string_view>& data();
  FilePlace place() const { return place_; }  // of the line read last

  void skip_data();

  // The value of a required parameter, such as NAME. Throws ConfigError if it is missing.
  std::string name_of(const AbaqusKeyword& keyword, const char* parameter = "NAME") const;
  // The value of a parameter: one of `values`, which may be abbreviated, or the first of them if the parameter is
  // missing. Throws ConfigError.
  std::string choice(const AbaqusKeyword& keyword, const char* parameter, const std::vector<std::string>& values) const;

  // The text of the next line, which is not consumed.
  std::string_view rest_of_line() const { return sources_.back().tokens.rest_of_line(); }

  // size() is the number of fields of the last data line. integer() and real() convert a field to a number; an empty or
  // missing real number is zero. `what` names the number in error messages.
  std::size_t size() const { return fields_.size(); }
  std::int64_t integer(std::string_view field, const char* what) const;
  double real(std::size_t field, const char* what) const;

  // A position in the input. enter() continues reading there, leave() returns to where enter() was called.
  struct Source {
    TextTokens tokens;
    int file;
    bool only_data;  // a file named by INPUT=
  };
  using Mark = std::vector<Source>;
  Mark mark() const { return sources_; }
  void enter(const Mark& mark);
  void leave();

  // Throws ConfigError at place().
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> message, Args&&... args) const {
    draft_.fail(place_, message, std::forward<Args>(args)...);
  }

 private:
  void follow_includes();
  AbaqusKeyword take_keyword();
  void open(const std::string& file, const AbaqusKeyword& keyword, bool only_data);

  MeshDraft& draft_;
  std::string folder_;  // of the first file
  std::vector<Source> sources_;
  std::vector<Mark> left_;
  std::map<std::string, std::pair<int, std::string>> texts_;  // by path: index in draft.files, content
  std::vector<std::string_view> fields_;
  FilePlace place_;
  int opened_ = 0;
};

}  // namespace orthodyn
