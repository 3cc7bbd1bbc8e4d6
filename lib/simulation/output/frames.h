// Frames for ParaView: one .vtu file per output time (appended raw binary, fields in single precision), and a .pvd file
// with the times.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lib/mesh/mesh.h"
#include "lib/simulation/output/files.h"
#include "lib/simulation/output/observer.h"

namespace orthodyn {

// Values at all nodes or cells, `components` for each.
struct VtuField {
  std::string name;
  Location location;
  int components;
  std::vector<double> values;
};

// Writes one .vtu file in double precision. With `mesh`, includes its region names. Throws RunError.
void write_vtu(const std::filesystem::path& path, const Geometry& geometry, std::vector<VtuField> fields,
               const Mesh* mesh = nullptr);

class FrameWriter : public Observer {
 public:
  // Writes <folder>/frames.pvd and <folder>/frames/frame_00000.vtu, ... `fields`: node or cell outputs of the model.
  // The model and the mesh must outlive the writer. With `mesh`, each frame contains the regions by number (cell data
  // "region") and name (field data "region_names"), unless "body" is the only one.
  FrameWriter(std::filesystem::path folder, const Model& model, const std::vector<std::string>& fields,
              const Mesh* mesh = nullptr);

  void on_start(const ObservedState& observed) override;
  void on_resume(const ObservedState& observed) override;
  void on_output(const ObservedState& observed) override { write(observed); }
  void save(Archive& archive) override;
  void restore(const Archive& archive) override;

 private:
  void write(const ObservedState& observed);
  std::filesystem::path frame(std::size_t k) const;
  void remove_frames_from(std::size_t count) const;

  std::filesystem::path folder_;
  const Model& model_;
  const Mesh* mesh_;  // null: no regions
  std::vector<OutputInfo> fields_;
  PvdFile collection_;
  std::size_t frames_ = 0, synced_ = 0;  // number of frames written; of frames synced to the disk
  std::vector<double> prints_;           // fingerprints of the frames
};

}  // namespace orthodyn
