#include "lib/simulation/vtu.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <type_traits>

#include "lib/core/errors.h"

namespace orthodyn {

namespace fs = std::filesystem;

namespace {

// The XML part, and the binary blocks that it points into.
class VtuFile {
 public:
  template <class T>
  void array(const std::string& name, int components, const std::vector<T>& values) {
    xml_ += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
                        "offset=\"{}\"/>\n",
                        type_name<T>(), name, components, offset_);
    const std::uint64_t bytes = values.size() * sizeof(T);
    std::string block(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    block.append(reinterpret_cast<const char*>(values.data()), bytes);
    offset_ += block.size();
    blocks_.push_back(std::move(block));
  }

  void text(const std::string& xml) { xml_ += xml; }

  std::vector<std::string> finish() {
    const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    blocks_.insert(blocks_.begin(),
                   fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
                               "byte_order=\"{}\" header_type=\"UInt64\">\n{}<AppendedData encoding=\"raw\">\n_",
                               order, xml_));
    blocks_.emplace_back("\n</AppendedData>\n</VTKFile>\n");
    return std::move(blocks_);
  }

 private:
  template <class T>
  static const char* type_name() {
    if constexpr (std::is_same_v<T, float>) return "Float32";
    else if constexpr (std::is_same_v<T, double>) return "Float64";
    else if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
    else return "UInt8";
  }

  std::string xml_;
  std::vector<std::string> blocks_;
  std::size_t offset_ = 0;
};

void write_geometry(const Geometry& geometry, VtuFile& file) {
  std::vector<double> points;
  points.reserve(3 * geometry.points.size());
  for (const Vec3& x : geometry.points) points.insert(points.end(), x.begin(), x.end());
  const std::vector<std::int32_t>& connectivity = geometry.cells.nodes();
  std::vector<std::int32_t> offsets;
  for (std::size_t k = 1; k <= geometry.cells.size(); ++k)
    offsets.push_back(static_cast<std::int32_t>(k) * geometry.cells.nodes_per_cell());
  const auto type = static_cast<std::uint8_t>(geometry.vtk_cell_type);
  file.text("<Points>\n");
  file.array("points", 3, points);
  file.text("</Points>\n<Cells>\n");
  file.array("connectivity", 1, connectivity);
  file.array("offsets", 1, offsets);
  file.array("types", 1, std::vector<std::uint8_t>(geometry.cells.size(), type));
  file.text("</Cells>\n");
}

template <class Real>
std::vector<std::string> whole_file(const Geometry& geometry, const std::vector<VtuField>& fields) {
  VtuFile file;
  file.text(fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                        geometry.points.size(), geometry.cells.size()));
  for (const auto& [location, tag] : {std::pair{Location::node, "PointData"}, {Location::cell, "CellData"}}) {
    file.text(fmt::format("<{}>\n", tag));
    for (const auto& field : fields)
      if (field.location == location)
        file.array(field.name, field.components, std::vector<Real>(field.values.begin(), field.values.end()));
    file.text(fmt::format("</{}>\n", tag));
  }
  write_geometry(geometry, file);
  file.text("</Piece>\n</UnstructuredGrid>\n");
  return file.finish();
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Geometry& geometry, const std::vector<VtuField>& fields) {
  write_file(path, whole_file<double>(geometry, fields));
}

VtuWriter::VtuWriter(std::filesystem::path folder, const Model& model, const std::vector<std::string>& fields)
    : folder_(std::move(folder)), model_(model),
      collection_(folder_ / "frames.pvd",
                  "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n",
                  "</Collection>\n</VTKFile>\n") {
  for (const auto& info : model.outputs())
    if (std::find(fields.begin(), fields.end(), info.name) != fields.end()) fields_.push_back(info);
}

void VtuWriter::write(const State& state) {
  const auto view = model_.view(state);
  std::vector<VtuField> fields;
  for (const auto& info : fields_)
    fields.push_back({info.name, info.location, info.components, view->evaluate(info.name)});
  const fs::path path = frame(frames_);
  write_file(path, whole_file<float>(model_.geometry(), fields));
  try {
    collection_.append(fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"frames/{}\"/>\n", state.t,
                                   path.filename().string()));
  } catch (const RunError&) {  // no frame without its time
    std::error_code ignored;
    fs::remove(path, ignored);
    throw;
  }
  ++frames_;
}

fs::path VtuWriter::frame(std::size_t k) const { return folder_ / "frames" / fmt::format("frame_{:05}.vtu", k); }

void VtuWriter::on_start(const State& state) {
  collection_.begin();
  write(state);
}

void VtuWriter::save(Archive& archive) {
  const bool any_new = lasting_ < frames_;
  for (; lasting_ < frames_; ++lasting_) make_lasting(frame(lasting_));
  if (any_new) make_lasting(folder_ / "frames");  // their names
  collection_.make_lasting();
  archive.put_count("frames", frames_);
  archive.put_count("bytes", collection_.size());
}

void VtuWriter::restore(const Archive& archive) {
  frames_ = lasting_ = archive.count("frames");
  kept_ = archive.count("bytes");
  collection_.require(kept_);
  for (std::size_t k = 0; k < frames_; ++k)
    if (std::error_code ec; !fs::exists(frame(k), ec))
      throw ConfigError(fmt::format("{}: is missing, but the checkpoint knows of {} frames; put it back, or start anew "
                                    "with --force in place of --resume",
                                    frame(k).string(), frames_));
}

void VtuWriter::on_resume(const State&) {
  collection_.go_on(kept_);
  remove_frames_from(frames_);
}

// They are computed again. What was being written when the run was killed is removed too.
void VtuWriter::remove_frames_from(std::size_t count) const {
  std::error_code ec;
  std::vector<fs::path> surplus;
  for (const auto& entry : fs::directory_iterator(folder_ / "frames", ec)) {
    const std::string name = entry.path().filename().string();
    unsigned long k = 0;
    if (std::sscanf(name.c_str(), "frame_%lu.vtu", &k) != 1) continue;
    const std::string whole = frame(k).filename().string();
    if ((name == whole && k >= count) || name == whole + ".part") surplus.push_back(entry.path());
  }
  for (const auto& path : surplus)
    if (!fs::remove(path, ec) && ec)
      throw RunError(fmt::format("cannot remove {}: {}", path.string(), ec.message()));
}

}  // namespace orthodyn
