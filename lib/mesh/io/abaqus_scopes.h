// Parts and instances of an Abaqus input file: what numbers and names mean where they stand.
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

// What a keyword is within: the model or assembly (no name), or an instance.
struct AbaqusScope {
  std::string instance = {};  // as spelled
  std::int64_t offset = 0;    // is added to numbers of nodes and elements
  AbaqusPlacement placement = {};

  std::string key(const std::string& name) const {
    return instance.empty() ? in_capitals(name) : in_capitals(instance + "." + name);
  }
};

// A member that is one number.
AbaqusMembers abaqus_number_member(std::int64_t number, FilePlace place);

class AbaqusScopes {
 public:
  // `lines` must outlive this.
  explicit AbaqusScopes(AbaqusLines& lines) : lines_(lines) {}

  const AbaqusScope& now() const { return now_; }
  const std::map<std::string, AbaqusScope>& instances() const { return instances_; }  // by name in capitals

  // Begins an *INSTANCE of this name: reads its placement, and adds an offset to its numbers. Throws ConfigError.
  void enter(const std::string& name);
  // Ends it.
  void leave() { now_ = {}; }

  // The instance of a name. Throws ConfigError if there is none.
  const AbaqusScope& instance(const std::string& name) const;

  // What is added to the numbers of a scope: the assembly has nodes beside those of its instances.
  std::int64_t offset_of(const AbaqusScope& scope) const;
  std::int64_t offset() const { return offset_of(now_); }

  // A number of a node or an element in this scope, with the offset. `what` is for messages. Throws ConfigError.
  std::int64_t number(std::string_view field, const char* what) const { return number(field, what, offset()); }
  // Tells that a part has this number, without the offset: later instances get larger ones.
  void note(std::int64_t number) { largest_ = std::max(largest_, number); }

  // A number or a set, with the name of an instance in front, or else in the given scope. Throws ConfigError.
  AbaqusMembers member(std::string_view field, const AbaqusScope& scope) const;
  AbaqusMembers member(std::string_view field) const { return member(field, now_); }

 private:
  std::int64_t number(std::string_view field, const char* what, std::int64_t offset) const;
  AbaqusMembers member_within(std::string_view field, const AbaqusScope& scope) const;
  std::int64_t next_offset() const;
  AbaqusPlacement read_placement();

  AbaqusLines& lines_;
  AbaqusScope now_;
  std::map<std::string, AbaqusScope> instances_;
  std::int64_t largest_ = 0;  // number of a node or an element of a part
};

}  // namespace orthodyn
