#include "lib/fem/subdomain.h"

#include <algorithm>

#include "lib/mesh/mesh_faces.h"
#include "lib/mesh/partition.h"
#include "lib/mesh/quadratic.h"

namespace orthodyn {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

Subdomain::Subdomain(const Mesh& mesh, const std::vector<std::pair<int, int>>& links, const Ranks& ranks)
    : ranks_(ranks), local_(mesh.nodes.size(), -1) {
  const std::vector<MeshFace> faces = sorted_faces(mesh);
  const std::vector<int> rank_of_cell = ranks.partition(cell_graph(faces, mesh.cells.size()));
  for (std::size_t cell = 0; cell < rank_of_cell.size(); ++cell)
    if (rank_of_cell[cell] == ranks.rank()) cells_.push_back(static_cast<int>(cell));
  for (std::size_t begin = 0; begin < faces.size(); begin = end_of_face(faces, begin)) {
    int first = ranks.size();
    for (std::size_t k = begin; k < end_of_face(faces, begin); ++k)
      first = std::min(first, rank_of_cell[at(faces[k].cell)]);
    if (first == ranks.rank()) faces_.push_back(faces[begin].corners);
  }
  find_nodes(mesh, rank_of_cell, links);
}

void Subdomain::find_nodes(const Mesh& mesh, const std::vector<int>& rank_of_cell,
                           const std::vector<std::pair<int, int>>& links) {
  const int me = ranks_.rank();
  const std::size_t count = mesh.nodes.size();
  NodeRanks ranks_of(mesh.cells, rank_of_cell, count);
  std::vector<int> owner(count), place(count), owned(at(ranks_.size()), 0);
  std::vector<char> is_here(count, 0);
  for (std::size_t node = 0; node < count; ++node) {
    const std::vector<int>& having = ranks_of.of(node);
    owner[node] = owner_of(node, having);
    place[node] = owned[at(owner[node])]++;
    is_here[node] = std::binary_search(having.begin(), having.end(), me) ? 1 : 0;
  }
  for (const auto& [a, b] : links)
    if (owner[at(a)] == me) is_here[at(b)] = 1;

  for (const bool own : {true, false}) {
    for (std::size_t node = 0; node < count; ++node)
      if (is_here[node] && (owner[node] == me) == own) nodes_.push_back(static_cast<int>(node));
    if (own) num_owned_ = num_nodes();
  }
  for (int i = 0; i < num_nodes(); ++i) local_[at(nodes_[at(i)])] = i;
  std::vector<RemoteNode> copies;
  for (int i = num_owned_; i < num_nodes(); ++i) {
    const std::size_t node = at(nodes_[at(i)]);
    copies.emplace_back(owner[node], place[node]);
  }
  exchange_ = ranks_.exchange(num_owned_, copies);
}

Mesh Subdomain::part_of(const Mesh& mesh) const {
  Mesh part;
  part.region_names = mesh.region_names;
  for (const int node : nodes_) part.nodes.push_back(mesh.nodes[at(node)]);
  for (const int cell : cells_) {
    part.cells.add(mesh.cells.shape(at(cell)), mesh.cells[at(cell)]);
    part.region_of.push_back(mesh.region_of[at(cell)]);
  }
  for (int& node : part.cells.nodes()) node = local(node);
  return part;
}

std::vector<int> Subdomain::here(const std::vector<int>& nodes) const {
  std::vector<int> out;
  for (const int node : nodes)
    if (local(node) >= 0) out.push_back(local(node));
  return out;
}

std::vector<int> Subdomain::owned(const std::vector<int>& nodes) const {
  std::vector<int> out;
  for (const int node : nodes)
    if (owns(node)) out.push_back(local(node));
  return out;
}

bool Subdomain::has_face(FaceCorners face) const {
  face.sort();
  return std::binary_search(faces_.begin(), faces_.end(), face);
}

void Subdomain::add_to_owners(Vector& values) const {
  NodalVector columns = NodalVector::Zero(3, values.size());
  columns.row(0) = values.transpose();
  add_to_owners(columns);
  values = columns.row(0).transpose();
}

std::vector<double> Subdomain::whole_field(const std::vector<double>& here, std::size_t components) const {
  std::vector<double> all(local_.size() * components, 0);
  for (int i = 0; i < num_owned_; ++i)
    std::copy_n(here.begin() + static_cast<std::ptrdiff_t>(at(i) * components), components,
                all.begin() + static_cast<std::ptrdiff_t>(at(nodes_[at(i)]) * components));
  ranks_.sum(all);
  return all;
}

void Subdomain::agree(const std::string& trouble) const {
  if (!ranks_.any(!trouble.empty())) return;
  throw RecoverableError(trouble.empty() ? "another rank cannot evaluate its part" : trouble);
}

}  // namespace orthodyn
