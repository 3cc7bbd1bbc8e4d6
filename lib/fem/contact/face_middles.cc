#include "lib/fem/contact/face_middles.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lib/fem/face_nodes.h"

namespace orthodyn {

int FaceMiddles::add(std::span<const int> nodes) {
  NodesOfFace& face = faces_.emplace_back();
  face.size = static_cast<int>(nodes.size());
  std::copy(nodes.begin(), nodes.end(), face.nodes.begin());
  return end() - 1;
}

double FaceMiddles::sum_of_weights(int point) const {
  double sum = 0;
  for_each_node(point, [&](int, double weight) { sum += std::abs(weight); });
  return sum;
}

void FaceMiddles::append(const FaceMiddles& other) {
  faces_.insert(faces_.end(), other.faces_.begin(), other.faces_.end());
}

const NodalVector& FaceMiddles::values(const NodalVector& nodal, NodalVector& storage) const {
  if (empty()) return nodal;
  storage = NodalVector::Zero(3, end());
  storage.leftCols(nodal.cols()) = nodal;
  for (int point = first_; point < end(); ++point)
    for_each_node(point, [&](int node, double weight) { storage.col(point) += weight * nodal.col(node); });
  return storage;
}

std::vector<std::pair<int, double>> contact_areas(const Mesh& mesh, const std::vector<FaceCorners>& faces,
                                                  FaceMiddles& middles) {
  std::map<int, double> areas;
  for_each_face(mesh, faces, [&]<Face F>(std::span<const int> nodes, const FaceNodes<F>& X) {
    const double whole = area<F>(X);
    double middle = 1;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      areas[nodes[k]] += whole * F::kPointShares[k];
      middle -= F::kPointShares[k];
    }
    if (FaceMiddles::has_middle(F::kNodes)) areas[middles.add(nodes)] += whole * middle;
  });
  return {areas.begin(), areas.end()};
}

std::vector<std::pair<int, double>> contact_areas_of(const Subdomain& subdomain,
                                                     const std::vector<std::pair<int, double>>& areas,
                                                     const FaceMiddles& middles, FaceMiddles& here) {
  std::vector<std::pair<int, double>> out;
  for (const auto& [point, area] : areas) {
    if (!middles.has(point)) {
      if (subdomain.owns(point)) out.emplace_back(subdomain.local(point), area);
      continue;
    }
    const std::span<const int> face = middles.face(point);
    if (!subdomain.has_face(FaceCorners(face.first(face.size() / 2)))) continue;
    std::vector<int> nodes;
    for (const int node : face) nodes.push_back(subdomain.local(node));
    out.emplace_back(here.add(nodes), area);
  }
  return out;
}

}  // namespace orthodyn
