// Parts and instances of an Abaqus input file: scopes for names and for node and element numbers.
//
// Source: Abaqus keywords reference, *INSTANCE; analysis user's guide, "Assembly definition".
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "lib/mesh/io/abaqus_file.h"

namespace orthodyn {

// The scope of the model or assembly (without a name), or of an instance.
struct AbaqusScope {
  std::string instance = {};  // as spelled
  std::int64_t offset = 0;    // added to node and element numbers
  AbaqusPlacement placement = {};

  std::string key(const std::string& name) const {
    return instance.empty() ? in_capitals(name) : in_capitals(instance + "." + name);
  }
};

// A listed member of a set: one number.
AbaqusMembers abaqus_number_member(std::int64_t number, FilePlace place);

class AbaqusScopes {
 public:
  // `lines` must outlive this.
  explicit AbaqusScopes(AbaqusLines& lines) : lines_(lines) {}

  const AbaqusScope& current() const { return current_; }
  const std::map<std::string, AbaqusScope>& instances() const { return instances_; }  // by name in capitals

  // Begins an *INSTANCE: reads its placement and chooses its offset. Throws ConfigError.
  void enter(const std::string& name);
  // Ends the current instance.
  void leave() { current_ = {}; }

  // The instance of a name. Throws ConfigError if there is none.
  const AbaqusScope& instance(const std::string& name) const;

  // The offset of numbers in a scope. An assembly with instances has an offset too, since it may define nodes itself.
  std::int64_t offset_of(const AbaqusScope& scope) const;
  std::int64_t offset() const { return offset_of(current_); }

  // A node or element number in the current scope, plus the offset. `what` is for messages. Throws ConfigError.
  std::int64_t number(std::string_view field, const char* what) const { return number(field, what, offset()); }
  // Records a number (without offset) of a part; offsets of later instances exceed all recorded numbers.
  void record_number(std::int64_t number) { largest_ = std::max(largest_, number); }

  // Reads a number or the name of a set. A name with a prefix ("I.Side") belongs to that instance, others to `scope`.
  // Throws ConfigError.
  AbaqusMembers member(std::string_view field, const AbaqusScope& scope) const;
  AbaqusMembers member(std::string_view field) const { return member(field, current_); }

 private:
  std::int64_t number(std::string_view field, const char* what, std::int64_t offset) const;
  AbaqusMembers member_within(std::string_view field, const AbaqusScope& scope) const;
  std::int64_t next_offset() const;
  AbaqusPlacement read_placement();

  AbaqusLines& lines_;
  AbaqusScope current_;
  std::map<std::string, AbaqusScope> instances_;
  std::int64_t largest_ = 0;  // the largest recorded number
};

}  // namespace orthodyn
