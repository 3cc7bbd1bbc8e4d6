#include "lib/fem/nodal_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/core/symmetric_eigen.h"

namespace orthodyn {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Mat3 full(const Vec6& s) {
  Mat3 m;
  m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return m;
}

std::vector<double> von_mises(const Vec6& s, const ElasticRegion&) {
  const auto square = [](double x) { return x * x; };
  return {std::sqrt(0.5 * (square(s[0] - s[1]) + square(s[1] - s[2]) + square(s[2] - s[0])) +
                    3 * (square(s[3]) + square(s[4]) + square(s[5])))};
}

// Principal values in descending order.
std::vector<double> principal(const Vec6& s, const ElasticRegion&) {
  if (!s.allFinite()) return {kNone, kNone, kNone};
  const Vec3 values = symmetric_eigenvalues<3>(full(s));
  return {values[2], values[1], values[0]};
}

// det F = det S, because F = R S; `strain` is S - I.
std::vector<double> volume_ratio(const Vec6& strain, const ElasticRegion&) {
  return {(Mat3::Identity() + full(strain)).determinant()};
}

template <double (*compute)(const Vec6&, const Strength&)>
DerivedField exposure(const char* name, const char* sentence) {
  return {name, "1", sentence, "stress_material", {}, true, [](const Vec6& s, const ElasticRegion& region) {
            return std::vector<double>{region.strength ? compute(s, *region.strength) : kNone};
          }};
}

const TensorField& tensor_of(const DerivedField& derived) {
  const auto& all = tensor_fields();
  return *std::find_if(all.begin(), all.end(), [&](const auto& t) { return std::string(t.name) == derived.tensor; });
}

std::size_t num_components(const DerivedField& derived) { return std::max<std::size_t>(derived.components.size(), 1); }

// The given parts, or all of them if none are given.
FieldParts chosen(const FieldParts& parts, std::size_t count) {
  if (!parts.empty()) return parts;
  FieldParts all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

// Adds an elastic term to the region of this name.
void add_part(const std::string& name, std::size_t term, std::vector<FieldRegion>& regions) {
  const auto found = std::find_if(regions.begin(), regions.end(), [&](const auto& r) { return r.name == name; });
  if (found == regions.end()) regions.push_back({name, {term}});
  else found->parts.push_back(term);
}

// Replaces the values at `at` if the first of them is NaN or less than values[0].
void raise(const std::vector<double>& values, double* at) {
  if (std::isnan(*at) || values[0] > *at) std::copy(values.begin(), values.end(), at);
}

// Calls visit(node, tensor, inside) for the nodes of a region.
template <class Visit>
void for_each_node(RecoveredTensors& recovered, const TensorField& tensor, std::size_t region, Visit&& visit) {
  const auto& [nodes, inside, values] = recovered.of(tensor, region);
  for (std::size_t i = 0; i < nodes->size(); ++i)
    visit(static_cast<std::size_t>((*nodes)[i]), Vec6(values.row(static_cast<Eigen::Index>(i))), (*inside)[i] != 0);
}

}  // namespace

const std::vector<TensorField>& tensor_fields() {
  static const std::vector<std::string> space{"xx", "yy", "zz", "xy", "yz", "zx"},
      material{"11", "22", "33", "12", "23", "31"};
  static const std::vector<TensorField> all{
      {"strain", "1", "Strain S - I in material axes: 11, 22, 33, 12, 23, 31 (tensor shear)", material,
       [](const PointObservation& o) { return o.strain; }},
      {"strain_space", "1", "Strain S - I rotated with the body into space axes: xx, yy, zz, xy, yz, zx (tensor shear)",
       space, [](const PointObservation& o) { return Mat3(o.axes * o.strain * o.axes.transpose()); }, true},
      {"stress", "Pa", "Elastic Cauchy stress in space: xx, yy, zz, xy, yz, zx; NaN where inverted", space,
       [](const PointObservation& o) { return o.cauchy; }, true},
      {"stress_material", "Pa", "Elastic Cauchy stress in the rotated material axes: 11, 22, 33, 12, 23, 31", material,
       [](const PointObservation& o) { return Mat3(o.axes.transpose() * o.cauchy * o.axes); }}};
  return all;
}

const std::vector<DerivedField>& derived_fields() {
  static const std::vector<std::string> three{"1", "2", "3"};
  static const std::vector<DerivedField> all{
      {"von_mises", "Pa", "Von Mises' equivalent stress.", "stress", {}, false, von_mises},
      {"principal_stress", "Pa", "Principal stresses, the largest first.", "stress", three, false, principal},
      {"principal_strain", "1", "Principal strains, the largest first.", "strain", three, false, principal},
      {"nodal_det_f", "1", "Volume ratio det F at the nodes.", "strain", {}, false, volume_ratio},
      exposure<max_stress_exposure>(
          "max_stress", "Exposure by maximum stress: the largest ratio of a component to its strength; failure at 1."),
      exposure<tsai_wu_exposure>("tsai_wu",
                                 "Exposure by Tsai and Wu: reciprocal of the factor by which the stress can grow until "
                                 "failure; failure at 1."),
      exposure<hashin_exposure>(
          "hashin", "Exposure by Hashin, the largest of fibre and matrix in tension and compression; failure at 1.")};
  return all;
}

const StressRecovery::NodalValues& RecoveredTensors::of(const TensorField& tensor, std::size_t region) {
  const auto key = std::make_pair(&tensor, region);
  const auto found = kept_.find(key);
  if (found != kept_.end()) return found->second;
  return kept_.emplace(key, recovery_.at_nodes_of_region(region, state_, tensor)).first->second;
}

std::optional<StressRecovery::NodalValue> RecoveredTensors::at(const TensorField& tensor, std::size_t region,
                                                               int node) {
  const auto kept = kept_.find({&tensor, region});
  if (kept == kept_.end() && !recovery_.has_ranks()) {
    const auto [own, is_new] = kept_at_.try_emplace({&tensor, region, node});
    if (is_new) own->second = recovery_.at_node_of_region(region, node, state_, tensor);
    return own->second;
  }
  const auto& [nodes, inside, values] = of(tensor, region);
  const auto found = std::find(nodes->begin(), nodes->end(), node);
  if (found == nodes->end()) return std::nullopt;
  const auto row = found - nodes->begin();
  return StressRecovery::NodalValue{Vec6(values.row(row)), (*inside)[static_cast<std::size_t>(row)] != 0};
}

std::vector<double> tensor_at_nodes(RecoveredTensors& recovered, const TensorField& tensor, const FieldParts& parts) {
  std::vector<double> out(6 * recovered.num_nodes(), 0);
  const auto at = [&](std::size_t node) { return Eigen::Map<Vec6>(out.data() + 6 * node); };
  std::vector<int> count(recovered.num_nodes(), 0);
  for (const std::size_t r : chosen(parts, recovered.num_regions()))
    for_each_node(recovered, tensor, r, [&](std::size_t node, const Vec6& value, bool inside) {
      if (!inside && parts.empty()) return;
      at(node) += value;
      ++count[node];
    });
  for (std::size_t node = 0; node < count.size(); ++node) {
    if (count[node] > 1) at(node) /= count[node];
    if (count[node] == 0 && !parts.empty()) at(node).setConstant(kNone);
  }
  return out;
}

std::vector<double> derived_at_nodes(RecoveredTensors& recovered, const StressRecovery::Terms& terms,
                                     const DerivedField& derived, const FieldParts& parts) {
  const std::size_t count = num_components(derived);
  std::vector<double> out(count * recovered.num_nodes(), kNone);
  for (const std::size_t r : chosen(parts, terms.size()))
    for_each_node(recovered, tensor_of(derived), r, [&](std::size_t node, const Vec6& tensor, bool) {
      raise(derived.of(tensor, terms[r]->definition()), out.data() + count * node);
    });
  return out;
}

std::vector<double> tensor_at_node(RecoveredTensors& recovered, const TensorField& tensor, const FieldParts& parts,
                                   int node) {
  Vec6 sum = Vec6::Zero();
  int count = 0;
  for (const std::size_t r : chosen(parts, recovered.num_regions()))
    if (const auto found = recovered.at(tensor, r, node); found && (found->inside || !parts.empty())) {
      sum += found->value;
      ++count;
    }
  if (count == 0 && !parts.empty()) return std::vector<double>(6, kNone);
  sum /= std::max(count, 1);
  return {sum.begin(), sum.end()};
}

std::vector<double> derived_at_node(RecoveredTensors& recovered, const StressRecovery::Terms& terms,
                                    const DerivedField& derived, const FieldParts& parts, int node) {
  std::vector<double> out(num_components(derived), kNone);
  for (const std::size_t r : chosen(parts, terms.size()))
    if (const auto found = recovered.at(tensor_of(derived), r, node))
      raise(derived.of(found->value, terms[r]->definition()), out.data());
  return out;
}

std::vector<FieldRegion> field_regions(const StressRecovery::Terms& terms) {
  std::vector<FieldRegion> regions;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const ElasticRegion& own = terms[k]->definition();
    const std::string& joined = own.ply.empty() ? own.mesh_region : own.ply;
    if (own.stiffness_cell < 0) add_part(own.name, k, regions);
    if (!joined.empty() && joined != own.name) add_part(joined, k, regions);
  }
  return regions;
}

}  // namespace orthodyn
