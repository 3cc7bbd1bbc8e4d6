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
#include "lib/core/words.h"

namespace orthodyn {

class Config {
 public:
  // Reads a file, resp. a text. In any section the key `include` names a file, or a list of files,
  // whose keys stand there too: what the section says itself wins, later files win over earlier ones,
  // and sections within are joined in the same way. Throws ConfigError for a missing or unreadable
  // file, a syntax error, more than one document, duplicate keys, merge keys (<<), tags, and files that
  // include themselves.
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

  bool reads_as_number() const;

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

  // A file named by this value, relative to the folder of the input file that says so.
  std::string file_path() const;

  // The files that have been asked for so far in this document.
  std::vector<std::string> file_paths() const;

  [[noreturn]] void fail(const std::string& message) const;

  // What stands here, as YAML on one line.
  std::string yaml() const;

  // The whole document as YAML.
  std::string dump() const;

  // The same for a reader in another folder: the files asked for so far are named relative to it, or in
  // full if it is empty.
  std::string dump_for(const std::string& folder) const;

 private:
  struct Place;
  explicit Config(std::shared_ptr<const Place> place);
  std::shared_ptr<const Place> place_;
};

}  // namespace orthodyn
