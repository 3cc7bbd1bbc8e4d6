// A place in the user's YAML input. Other modules use yaml-cpp only through this class.
//
// Messages give the file:line:column and the dotted path of the place. Reading does not change the document. Defaults
// are written only into a resolving() copy, whose dump() is the document with every default spelled out.
//
// A Config is a handle: its C++ copies refer to the same document; copy() makes a new document. Threads may use
// different documents at the same time.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "lib/core/errors.h"

namespace orthodyn {

// A value to write into a document: null, a scalar or a list of texts.
using ConfigValue = std::variant<std::nullptr_t, bool, long, double, std::string, std::vector<std::string>>;

class Config {
 public:
  // Reads a file or a text; messages show `name` as the file name of a text. The key `include` of any section names a
  // file or a list of files whose keys are added to the section. Keys of the section itself take precedence over
  // included ones, and later files over earlier ones; nested sections are merged likewise. Throws ConfigError for a
  // missing or unreadable file, a syntax error, more than one document, duplicate keys, merge keys (<<), tags, and
  // files that include themselves.
  static Config from_file(const std::string& path);
  static Config from_text(const std::string& text, const std::string& name = "<text>");

  // Copies the content of this place into a new document. Messages about the copy name the original places.
  Config copy() const;

  // A copy that records defaults and the names of files as they are read. Returns this Config if it already does so.
  Config resolving() const;

  // Writes a value at a path below this place, such as "mesh.cells.0"; creates missing sections. `place`: the origin of
  // the value for messages, default "--set path". dump() writes a section or list from set() on one line. Throws
  // ConfigError if the path leads through a scalar, or if an alias would change other places too.
  void set(const std::string& path, const ConfigValue& value, const std::string& place = "");
  void set(const std::string& path, const Config& value, const std::string& place = "");

  // As set(), from an assignment "path=value", as users write it after --set, or from a value in YAML.
  void override_with(const std::string& assignment);
  void set_yaml(const std::string& path, const std::string& yaml, const std::string& place = "");

  bool is_map() const;
  bool is_sequence() const;
  bool is_scalar() const;
  bool is_null() const;

  std::size_t size() const;
  Config at(std::size_t index) const;
  std::vector<std::string> keys() const;  // of a map, in the order of the file
  bool has(const std::string& key) const;
  Config at(const std::string& key) const;  // of a map; the key must exist

  bool is_quoted() const;  // a scalar in quotes, which is a text
  bool reads_as_number() const;

  // The value of a scalar. Throw ConfigError for another kind of value, for a number that is not finite, and for a
  // number, integer or boolean in quotes.
  double number() const;
  long integer() const;
  bool boolean() const;
  std::string text() const;

  // Writes a default, given as YAML or as plain text, into this map, so that dump() shows it. Returns the new entry.
  // Precondition: this is a resolving() Config.
  Config fill(const std::string& key, const std::string& yaml) const;
  Config fill_text(const std::string& key, const std::string& text) const;

  // Renames a key of this map. Preconditions: this is a resolving() Config that has `former` and not `name`.
  void rename(const std::string& former, const std::string& name) const;

  // The value, shortened for messages.
  std::string shown() const;

  // "file:line:column: path"; "file: path" for a default; for a value from set(), its `place` or "file: --set path".
  std::string where() const;
  std::string path() const;
  std::string file() const;

  // The file named by this value; relative names are relative to the folder of the input file.
  std::string file_path() const;

  // All results of file_path() so far. Precondition: this is a resolving() Config.
  std::vector<std::string> file_paths() const;

  // Records a warning about this place, once.
  void warn(const std::string& message) const;
  // All warnings of the document, "place: message", in the order of recording.
  const std::vector<std::string>& warnings() const;

  // Throws a ConfigError with this place.
  [[noreturn]] void fail(const std::string& message, InputFault fault = InputFault::value) const;
  // Throws "expected ..., found ...", a ConfigError of kind InputFault::form.
  [[noreturn]] void fail_expected(const std::string& expected, const std::string& hint = "") const;

  // This value as YAML on one line.
  std::string yaml() const;

  // The whole document as YAML.
  std::string dump() const;

  // As dump(), for a file in `folder`: file_paths() are written relative to `folder`, or as absolute paths if it is "".
  std::string dump_for(const std::string& folder) const;

 private:
  struct Document;
  struct Place;
  explicit Config(std::shared_ptr<const Place> place);
  Config copy(bool resolving) const;
  template <class Step>
  Config child(const Step& step, const std::string& name) const;
  std::shared_ptr<const Place> place_;
};

}  // namespace orthodyn
