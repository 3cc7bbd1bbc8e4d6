#include "lib/simulation/output/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "lib/core/errors.h"
#include "lib/core/fingerprint.h"
#include "lib/core/write_file.h"
#include "lib/mesh/io/vtk_grid.h"
#include "lib/mesh/io/vtu_text.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

bool has_named_regions(const Mesh& mesh) { return mesh.region_names.size() > 1 || mesh.region_names.front() != "body"; }

void add_frame_regions(const Mesh& mesh, VtuGrid& grid) {
  grid.region_names = mesh.region_names;
  const auto is_region = [](const VtuArray& array) { return array.name == "region"; };
  if (std::any_of(grid.cell_data.begin(), grid.cell_data.end(), is_region)) return;
  grid.cell_data.push_back(
      {.name = "region", .type = VtuNumber::int32, .values = {mesh.region_of.begin(), mesh.region_of.end()}});
}

VtuGrid grid_of(const Geometry& geometry, std::vector<VtuField> fields, VtuNumber type, const Mesh* mesh) {
  VtuGrid grid{.points = geometry.points, .cells = geometry.cells};
  for (VtuField& field : fields) {
    auto& data = field.location == Location::node ? grid.point_data : grid.cell_data;
    data.push_back({std::move(field.name), field.components, type, std::move(field.values)});
  }
  if (mesh && has_named_regions(*mesh)) add_frame_regions(*mesh, grid);
  return grid;
}

double fingerprint_of(const std::vector<std::string>& parts) {
  Fingerprint print;
  for (const std::string& part : parts) print.add_piece(part);
  return print.number();
}

double fingerprint_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return Fingerprint().add_piece(text.view()).number();
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Geometry& geometry, std::vector<VtuField> fields,
               const Mesh* mesh) {
  write_file(path, vtu_text(grid_of(geometry, std::move(fields), VtuNumber::float64, mesh), VtuStorage::raw));
}

FrameWriter::FrameWriter(std::filesystem::path folder, const Model& model, const std::vector<std::string>& fields,
                         const Mesh* mesh)
    : folder_(std::move(folder)), model_(model), mesh_(mesh), collection_(folder_ / "frames.pvd") {
  for (const auto& info : model.outputs())
    if (std::find(fields.begin(), fields.end(), info.name) != fields.end()) fields_.push_back(info);
}

void FrameWriter::write(const ObservedState& observed) {
  std::vector<VtuField> fields;
  for (const auto& info : fields_)
    fields.push_back({info.name, info.location, info.components, observed.evaluate(info.name)});
  if (!writes_files()) {
    ++frames_;
    prints_.push_back(0);
    return;
  }
  const fs::path path = frame(frames_);
  const Geometry geometry = model_.geometry();
  const auto text = vtu_text(grid_of(geometry, std::move(fields), VtuNumber::float32, mesh_), VtuStorage::raw);
  write_file(path, text);
  try {
    collection_.add(observed.t(), "frames/" + path.filename().string());
  } catch (const RunError&) {  // a frame must not be left without its time in frames.pvd
    std::error_code ignored;
    fs::remove(path, ignored);
    throw;
  }
  ++frames_;
  prints_.push_back(fingerprint_of(text));
}

fs::path FrameWriter::frame(std::size_t k) const { return folder_ / "frames" / fmt::format("frame_{:05}.vtu", k); }

void FrameWriter::on_start(const ObservedState& observed) {
  collection_.begin();
  write(observed);
}

void FrameWriter::save(Archive& archive) {
  const bool any_new = synced_ < frames_;
  for (; synced_ < frames_; ++synced_) sync_to_disk(frame(synced_));
  if (any_new) sync_to_disk(folder_ / "frames");  // so that the file names are on the disk, too
  collection_.save(archive);
  archive.put_count("frames", frames_);
  archive.put("fingerprints", prints_);
}

void FrameWriter::restore(const Archive& archive) {
  collection_.restore(archive);
  frames_ = synced_ = archive.count("frames");
  prints_ = archive.numbers("fingerprints", frames_);
  for (std::size_t k = 0; k < frames_ && writes_files(); ++k) {
    if (std::error_code ec; !fs::exists(frame(k), ec))
      throw ConfigError(
          frame(k).string(),
          fmt::format("is missing: there were {} frames when the checkpoint was written; {}", frames_, kPutBack));
    if (fingerprint_of(frame(k)) != prints_[k])
      throw ConfigError(
          frame(k).string(),
          fmt::format("is damaged or not of this run: it has changed since the checkpoint; {}", kPutBack));
  }
}

void FrameWriter::on_resume(const ObservedState&) {
  collection_.reopen();
  if (writes_files()) remove_frames_from(frames_);
}

// Removes the frames from number `count` on, which are computed again, and partial files of a killed run.
void FrameWriter::remove_frames_from(std::size_t count) const {
  std::error_code ec;
  std::vector<fs::path> surplus;
  for (const auto& entry : fs::directory_iterator(folder_ / "frames", ec)) {
    const std::string name = entry.path().filename().string();
    unsigned long k = 0;
    if (std::sscanf(name.c_str(), "frame_%lu.vtu", &k) != 1) continue;
    const std::string whole = frame(k).filename().string();
    const bool is_part = name.starts_with(whole + ".") && name.ends_with(".part");
    if ((name == whole && k >= count) || is_part) surplus.push_back(entry.path());
  }
  for (const auto& path : surplus)
    if (!fs::remove(path, ec) && ec) throw RunError(fmt::format("cannot remove {}: {}", path.string(), ec.message()));
}

}  // namespace orthodyn
