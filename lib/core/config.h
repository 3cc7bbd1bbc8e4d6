// A position in the user's YAML input: the only door to yaml-cpp.
//
// A Config knows where it stands (file:line:column and dotted path), so that whatever is wrong with
// a value can be said with its place. It is also the resolved input: a default that was taken is
// filled in, and dump() prints the document with every default spelled out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/core/errors.h"

namespace orthodyn {

class Config {
 public:
  // Reads a file, resp. a text. Throws ConfigError for a missing or unreadable file, a syntax
  // error, more than one document, duplicate keys and merge keys (<<).
  static Config from_file(const std::string& path);
  static Config from_text(const std::string& text, const std::string& name = "<text>");

  // Applies "a.b.0=value" (value is YAML). Missing sections are made. Throws ConfigError, also where
  // an alias would carry the change to other places.
  void override_with(const std::string& assignment);

  bool is_map() const;
  bool is_sequence() const;
  bool is_scalar() const;
  bool is_null() const;

  std::size_t size() const;
  Config at(std::size_t index) const;
  std::vector<std::string> keys() const;  // of a map, in the order of the file
  bool has(const std::string& key) const;
  Config at(const std::string& key) const;  // of a map; the key must exist

  // Scalars, strictly: a number is finite, an integer integral. Throws ConfigError.
  double number() const;
  long integer() const;
  bool boolean() const;
  std::string text() const;

  // Writes a value (as YAML text) into this map, for dump(). Creates the key where it is missing.
  Config fill(const std::string& key, const std::string& yaml) const;

  // The same for a plain text, which is not read as YAML.
  Config fill_text(const std::string& key, const std::string& text) const;

  // What stands here, shortened, for messages.
  std::string shown() const;

  // "file:line:column: path"; "file: --set path" for a value given on the command line, "file: path"
  // for a default.
  std::string where() const;
  std::string path() const;
  std::string file() const;

  // A file named by this value, relative to the input file's folder.
  std::string file_path() const;

  [[noreturn]] void fail(const std::string& message) const;

  // What stands here, as YAML on one line.
  std::string yaml() const;

  // The whole document as YAML.
  std::string dump() const;

 private:
  struct Place;
  explicit Config(std::shared_ptr<const Place> place);
  std::shared_ptr<const Place> place_;
};

// The entry of `names` nearest to `name` by edit distance, or "" if none is near.
std::string nearest_name(const std::string& name, const std::vector<std::string>& names);

// "a, b, c"
std::string join(const std::vector<std::string>& names, const std::string& separator = ", ");

}  // namespace orthodyn
