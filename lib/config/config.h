// A position in the user's YAML input: the only door to yaml-cpp.
//
// A Config knows where it stands (file:line:column and dotted path), so that whatever is wrong with a value can be said
// with its place. Reading leaves the document as it is: a default is taken from the code and written nowhere, but into
// a resolving copy, whose dump() is the document with every default spelled out.
//
// A Config is a handle: copies of it are the same place of the same document, which copy() is not. Different documents
// may be used by different threads.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "lib/core/errors.h"

namespace orthodyn {

// What a program writes into a document: null, a scalar or a list of texts.
using ConfigValue = std::variant<std::nullptr_t, bool, long, double, std::string, std::vector<std::string>>;

class Config {
 public:
  // Reads a file or a text; `name` stands for the file in messages. In any section the key `include` names a file, or a
  // list of files, whose keys stand there too: what the section says itself wins, later files win over earlier ones,
  // and sections within are joined in the same way. Throws ConfigError for a missing or unreadable
  // file, a syntax error, more than one document, duplicate keys, merge keys (<<), tags, and files that
  // include themselves.
  static Config from_file(const std::string& path);
  static Config from_text(const std::string& text, const std::string& name = "<text>");

  // What stands here and below, as a document of its own: it can be changed, and speaks of the same places.
  Config copy() const;

  // A copy that records the defaults taken from it and the files that it names; this itself if it is one.
  Config resolving() const;

  // Writes a value at a path below this, such as "mesh.cells.0". Sections that are missing are made. `place` is where
  // the value comes from, for messages about it and what is below; default "--set path". A section or list is written
  // on one line. Throws ConfigError where the path leads through a value, or where an alias would carry the change to
  // other places.
  void set(const std::string& path, const ConfigValue& value, const std::string& place = "");
  void set(const std::string& path, const Config& value, const std::string& place = "");

  // The same of "path=value" as a user writes it: the value is YAML.
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

  // Scalars, strictly: a number is finite, an integer integral, and neither is in quotes, nor is true or false. Throws
  // ConfigError.
  double number() const;
  long integer() const;
  bool boolean() const;
  std::string text() const;

  // Writes a default (as YAML, or as a plain text) into this map, for dump(). Creates the key where it is missing.
  // Precondition: this is a resolving() Config.
  Config fill(const std::string& key, const std::string& yaml) const;
  Config fill_text(const std::string& key, const std::string& text) const;

  // Gives a key of this map another name. Preconditions: this is a resolving() Config that has `former` and not `name`.
  void rename(const std::string& former, const std::string& name) const;

  // What stands here, shortened, for messages.
  std::string shown() const;

  // "file:line:column: path", for a default "file: path", for a value that was set its own place, or else "file: --set
  // path".
  std::string where() const;
  std::string path() const;
  std::string file() const;

  // A file named by this value, relative to the folder of the input file that says so.
  std::string file_path() const;

  // The files that have been asked for so far in this document, which is a resolving() one.
  std::vector<std::string> file_paths() const;

  // Records a warning about this place for the user, unless the document has it already.
  void warn(const std::string& message) const;
  // The warnings of the whole document, "place: message", in the order in which they were recorded.
  const std::vector<std::string>& warnings() const;

  // Throws a ConfigError with this place.
  [[noreturn]] void fail(const std::string& message, InputFault fault = InputFault::value) const;

  // What stands here, as YAML on one line.
  std::string yaml() const;

  // The whole document as YAML.
  std::string dump() const;

  // The same for a reader in another folder: the files asked for so far are named relative to it, or in
  // full if it is empty.
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
