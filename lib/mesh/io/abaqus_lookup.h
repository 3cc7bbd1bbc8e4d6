// Looks up the members of Abaqus sets: indices of the nodes, solid elements and faces that a file defines.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "lib/mesh/io/abaqus_file.h"

namespace orthodyn {

// Total work is bounded: files whose nested sets list all nodes and elements more than 100 times are refused. All
// functions throw ConfigError.
class AbaqusLookup {
 public:
  using Use = std::function<void(std::size_t index)>;

  // `file` must outlive the lookup. Its nodes, cells and faces must not change.
  explicit AbaqusLookup(const AbaqusFile& file);

  // Call `use` with the index of each solid element (of file.draft.cells) or face (of file.faces) among the members,
  // nested sets included. Return the number of calls.
  std::size_t each_cell(const AbaqusMembers& members, const Use& use) { return each_element(members, cells_, use); }
  std::size_t each_face(const AbaqusMembers& members, const Use& use) { return each_element(members, faces_, use); }

  // All nodes of a node set. Listed nodes must exist, except in sets created for conditions.
  std::vector<FileNodeUse> nodes_of(const AbaqusSet& set);

  // The element set that `members` names.
  const AbaqusSet& element_set(const AbaqusMembers& members) const;

  // The coordinates of a node. `place` is for the message if the node is not defined.
  const Vec3& position(std::int64_t node, FilePlace place) const;

  // The number of elements that a set lists but no *ELEMENT defines.
  std::size_t count_undefined(const AbaqusSet& element_set) const;

 private:
  using Numbers = std::vector<std::pair<std::int64_t, std::size_t>>;  // tags, ascending, each with its index

  static Numbers numbers_of(const auto& things);
  void check_elements_differ() const;
  void count_visit(FilePlace place);
  std::size_t each(const AbaqusMembers& members, const Numbers& numbers, const Use& use);
  std::size_t each_element(const AbaqusMembers& members, const Numbers& numbers, const Use& use);
  const AbaqusSet& find(const AbaqusSets& sets, const AbaqusMembers& members, const char* keyword) const;
  void append_nodes(const AbaqusMembers& members, std::vector<FileNodeUse>& uses);
  void append_nodes_of_elements(const AbaqusMembers& members, std::vector<FileNodeUse>& uses);
  [[noreturn]] void fail_missing_node(const AbaqusMembers& members) const;

  const AbaqusFile& file_;
  Numbers nodes_, cells_, faces_, ignored_;
  std::size_t visits_left_ = 0;
};

}  // namespace orthodyn
