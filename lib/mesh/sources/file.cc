// The mesh sources that read files: file (any format, by its ending), gmsh, vega.
#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "lib/core/file_kind.h"
#include "lib/mesh/io/gmsh.h"
#include "lib/mesh/io/mesh_file.h"
#include "lib/mesh/io/mesh_format.h"
#include "lib/mesh/io/vega.h"
#include "lib/mesh/mesh_source.h"
#include "lib/mesh/quadratic.h"
#include "lib/mesh/refine.h"
#include "lib/mesh/sources/source_keys.h"

namespace orthodyn {

template <>
struct EnumNames<FileUnits> {
  static constexpr std::array<std::pair<FileUnits, const char*>, 2> list{
      {{FileUnits::si, "SI"}, {FileUnits::mm_t_s, "mm_t_s"}}};
};

namespace {

constexpr const char* kRefineSentence = "Number of uniform refinements; each divides every element into eight.";
const Rule kRefineRule{.range = {0, 6}};
constexpr const char* kSplitSentence =
    "true: hexahedra and wedges become tetrahedra. A mesh with pyramids or with elements that repeat a node is always "
    "split.";
constexpr const char* kScale = "Factor of all coordinates: 0.001 if they are in mm.";

void require_file(const FilePath& file) {
  if (!is_file(file.path)) throw ConfigError(file.where, "no such file: " + file.path);
}

constexpr const char* kCentresSentence =
    "true: quadratic hexahedra and wedges also have nodes in the middle of quadrilaterals and of hexahedra: 27 instead "
    "of 20 nodes, 18 instead of 15.";

// Options of all mesh files.
struct FileOptions {
  FilePath file;
  double scale = 1;
  std::optional<int> order;
  bool split = false, centres = false;
  int refinements = 0;

  FileCells cells() const { return split ? FileCells::split : FileCells::keep; }

  LoadedMesh apply_options(LoadedMesh loaded) const {
    scale_mesh(loaded.mesh, scale, file.path);
    for (auto& [region, layup] : loaded.layups)
      for (MeshPly& ply : layup.plies) ply.thickness *= scale;
    for (const std::string& name : set_order(loaded.mesh, order))
      loaded.warnings.push_back(
          fmt::format("{}: node set \"{}\" has mid-edge nodes only and is empty with `order: 1`; leave out `order`, or "
                      "add corners to the set",
                      file.path, name));
    if (order && !loaded.mesh.has_tets_only()) validate(loaded.mesh, {file.path});  // its order may have changed
    if (centres) {
      if (loaded.mesh.order() == 1)
        throw ConfigError(file.where, "centres: the elements are linear; set order: 2 as well");
      if (loaded.mesh.has_tets_only())
        throw ConfigError(file.where, "centres: the mesh has tetrahedra only, which have no such nodes; remove it");
      add_centres(loaded.mesh);
    }
    for (int i = 0; i < refinements; ++i) refine(loaded);
    return loaded;
  }
};

class FileSource : public MeshSource, public FileOptions {
 public:
  static const Spec<FileSource>& spec() {
    static const auto s =
        Spec<FileSource>()
            .key("file", &FileSource::file, "A mesh file; relative to the scene.", {.required = true})
            .key("scale", &FileSource::scale, kScale, {.range = kPositive})
            .key("units", &FileSource::units_,
                 "Units of the coordinates, and of the materials of the file if the scene has no `materials`: SI, or "
                 "mm_t_s (mm, t, s; moduli in MPa, densities in t/mm^3).")
            .key("order", &FileSource::order, kFileOrderSentence, kOrderRule)
            .key("split", &FileSource::split, kSplitSentence)
            .key("centres", &FileSource::centres, kCentresSentence)
            .key("refine", &FileSource::refinements, kRefineSentence, kRefineRule)
            .check([](const FileSource& source, const Config& config) {
              if (source.units_ != FileUnits::si && source.scale != 1)
                config.at("scale").fail(
                    "cannot be combined with `units: mm_t_s`, which converts mm to m; remove one of them");
            });
    return s;
  }
  LoadedMesh load() const override {
    require_file(file);
    LoadedMesh loaded = read_mesh(file.path, cells());
    convert_to_si(loaded, units_, file.path);
    return apply_options(std::move(loaded));
  }
  bool may_bring_materials() const override { return mesh_format_of(file.path).brings_materials; }

 private:
  FileUnits units_ = FileUnits::si;
};

class GmshSource : public MeshSource, public FileOptions {
 public:
  static const Spec<GmshSource>& spec() {
    static const auto s = Spec<GmshSource>()
                              .key("file", &GmshSource::file, "A .msh file, version 2.2 or 4.1; relative to the scene.",
                                   {.required = true})
                              .key("scale", &GmshSource::scale, kScale, {.range = kPositive})
                              .key("order", &GmshSource::order, kFileOrderSentence, kOrderRule)
                              .key("split", &GmshSource::split, kSplitSentence)
                              .key("centres", &GmshSource::centres, kCentresSentence)
                              .key("refine", &GmshSource::refinements, kRefineSentence, kRefineRule);
    return s;
  }
  LoadedMesh load() const override {
    require_file(file);
    LoadedMesh loaded = read_gmsh(file.path, cells());
    make_names_utf8(loaded, file.path);
    return apply_options(std::move(loaded));
  }
};

class VegaSource : public MeshSource, public FileOptions {
 public:
  static const Spec<VegaSource>& spec() {
    static const auto s =
        Spec<VegaSource>()
            .key("file", &VegaSource::file, "A .veg file of tetrahedra or cubes; relative to the scene.",
                 {.required = true})
            .key("fixed", &VegaSource::fixed_, "A .bou file: its vertices become the node set `fixed`.")
            .key("scale", &VegaSource::scale, kScale, {.range = kPositive})
            .key("order", &VegaSource::order, kFileOrderSentence, kOrderRule)
            .key("split", &VegaSource::split, kSplitSentence)
            .key("refine", &VegaSource::refinements, kRefineSentence, kRefineRule);
    return s;
  }
  LoadedMesh load() const override {
    require_file(file);
    if (fixed_) require_file(*fixed_);
    LoadedMesh loaded = fixed_ ? read_vega(file.path, {fixed_->path}, cells()) : read_vega(file.path, cells());
    make_names_utf8(loaded, file.path);
    return apply_options(std::move(loaded));
  }
  bool may_bring_materials() const override { return true; }

 private:
  std::optional<FilePath> fixed_;
};

const bool file_registered[] = {
    Registry<MeshSource>::add<FileSource>("file",
                                          "A mesh file; the extension of its name selects the format. With .veg and "
                                          ".inp a scene may leave out `materials`."),
    Registry<MeshSource>::add<GmshSource>("gmsh",
                                          "A Gmsh file. Physical volumes become regions, physical surfaces surfaces, "
                                          "physical curves and points node sets."),
    Registry<MeshSource>::add<VegaSource>(
        "vega", "A Vega file, with materials and axes of its regions: a scene may leave out `materials`."),
};

}  // namespace
}  // namespace orthodyn
