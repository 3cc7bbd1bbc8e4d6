// TetGen: numbers instead of names.
#include <fmt/format.h>

#include <charconv>
#include <iterator>
#include <set>

#include "lib/mesh/io/mesh_writer.h"

namespace orthodyn {
namespace {

// "marker7" keeps its 7; the others take the numbers that are free.
std::map<std::string, int> numbers_of(const std::string& prefix, const std::vector<std::string>& names, WrittenMesh& written) {
  std::map<std::string, int> numbers;
  std::set<int> taken;
  for (const std::string& name : names) {
    int number = 0;
    if (!name.starts_with(prefix)) continue;
    const char* begin = name.data() + prefix.size();
    const auto [end, error] = std::from_chars(begin, name.data() + name.size(), number);
    if (error == std::errc() && end == name.data() + name.size() && number != 0 && taken.insert(number).second) numbers[name] = number;
  }
  int next = 1;
  for (const std::string& name : names) {
    if (numbers.contains(name)) continue;
    while (taken.contains(next)) ++next;
    taken.insert(next);
    numbers[name] = next;
    written.losses.push_back(fmt::format("the format cannot hold names: \"{}\" became \"{}{}\"", name, prefix, next));
  }
  return numbers;
}

}  // namespace

WrittenMesh write_tetgen(const LoadedMesh& loaded) {
  const TetMesh& mesh = loaded.mesh;
  WrittenMesh written;
  const auto set_numbers = numbers_of("marker", names_of(mesh.node_sets), written);
  std::vector<int> marker(mesh.nodes.size(), 0);
  for (const auto& [name, nodes] : mesh.node_sets) {
    std::size_t lost = 0;
    for (const int n : nodes) {
      int& m = marker[static_cast<std::size_t>(n)];
      lost += m != 0;
      if (m == 0) m = set_numbers.at(name);
    }
    if (lost > 0) written.losses.push_back(fmt::format("a node has one marker: {} nodes of \"{}\" are in an earlier set", lost, name));
  }
  std::string node = fmt::format("{} 3 0 1\n", mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vec3& x = mesh.nodes[n];
    fmt::format_to(std::back_inserter(node), "{} {} {} {} {}\n", n + 1, x[0], x[1], x[2], marker[n]);
  }
  const bool plain = mesh.region_names == std::vector<std::string>{"body"};
  std::map<std::string, int> region_numbers;
  if (!plain) region_numbers = numbers_of("region", mesh.region_names, written);
  std::string ele = fmt::format("{} 4 {}\n", mesh.tets.size(), plain ? 0 : 1);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const Tet& t = mesh.tets[e];
    fmt::format_to(std::back_inserter(ele), "{} {} {} {} {}", e + 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
    if (!plain) ele += fmt::format(" {}", region_numbers.at(mesh.region_names[static_cast<std::size_t>(mesh.region_of[e])]));
    ele += "\n";
  }
  written.files = {{".node", std::move(node)}, {".ele", std::move(ele)}};
  if (!mesh.surfaces.empty()) {
    const auto numbers = numbers_of("marker", names_of(mesh.surfaces), written);
    std::size_t count = 0;
    std::string faces;
    for (const auto& [name, triangles] : mesh.surfaces) {
      for (const Triangle& t : triangles) {
        fmt::format_to(std::back_inserter(faces), "{} {} {} {} {}\n", ++count, t[0] + 1, t[1] + 1, t[2] + 1, numbers.at(name));
      }
    }
    written.files.push_back({".face", fmt::format("{} 1\n", count) + faces});
  }
  note_lost_materials_and_data(written, loaded);
  return written;
}

}  // namespace orthodyn
