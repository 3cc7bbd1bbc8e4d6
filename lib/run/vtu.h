// Frames for ParaView: one .vtu file per output time (appended raw binary) and a .pvd with the times.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/run/observer.h"

namespace orthodyn {

// Values of all nodes or cells, one set of `components` after the other.
struct VtuField {
  std::string name;
  Location location;
  int components;
  std::vector<double> values;
};

// Writes one .vtu file of tetrahedra, in double precision. Throws RunError.
void write_vtu(const std::filesystem::path& path, const Geometry& geometry, const std::vector<VtuField>& fields);

class VtuWriter : public Observer {
 public:
  // Writes <folder>/frames.pvd and <folder>/frames/frame_00000.vtu ... `fields` are node or cell
  // outputs of the model, which must outlive the writer.
  VtuWriter(std::filesystem::path folder, const Model& model, const std::vector<std::string>& fields);

  void on_start(const State& state) override { write(state); }
  void on_output(const State& state) override { write(state); }

 private:
  void write(const State& state);
  void write_collection() const;

  std::filesystem::path folder_;
  const Model& model_;
  std::vector<OutputInfo> fields_;
  std::vector<double> times_;
};

}  // namespace orthodyn
