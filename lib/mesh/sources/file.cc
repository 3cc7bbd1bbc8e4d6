// The mesh sources that read files: file (any format, by its ending), gmsh, vega.
#include <filesystem>
#include <optional>

#include "lib/mesh/io/gmsh.h"
#include "lib/mesh/io/mesh_file.h"
#include "lib/mesh/io/mesh_format.h"
#include "lib/mesh/io/vega.h"
#include "lib/mesh/mesh_source.h"
#include "lib/mesh/refine.h"
#include "lib/mesh/sources/element_order.h"

namespace orthodyn {
namespace {

constexpr const char* kRefineSentence = "How often each tetrahedron is divided into eight.";
const Rule kRefineRule{.range = {0, 6}};
constexpr const char* kScale = "Multiplies coordinates: 0.001 if they are in mm.";

void require_file(const FilePath& file) {
  if (!std::filesystem::is_regular_file(file.path)) throw ConfigError(file.where, "no such file: " + file.path);
}

class FileSource : public MeshSource {
 public:
  static const Spec<FileSource>& spec() {
    static const auto s =
        Spec<FileSource>()
            .key("file", &FileSource::file_, "A mesh file; relative to the scene.", {.required = true})
            .key("scale", &FileSource::scale_, kScale, {.range = kPositive})
            .key("order", &FileSource::order_, kFileOrderSentence, kOrderRule)
            .key("refine", &FileSource::refine_, kRefineSentence, kRefineRule);
    return s;
  }
  LoadedMesh load() const override {
    require_file(file_);
    LoadedMesh loaded = read_mesh(file_.path);
    scale_mesh(loaded.mesh, scale_, file_.path);
    set_order(loaded.mesh, order_);
    for (int i = 0; i < refine_; ++i) refine(loaded);
    return loaded;
  }
  bool may_bring_materials() const override { return mesh_format_of(file_.path).holds_materials; }

 private:
  FilePath file_;
  double scale_ = 1;
  std::optional<int> order_;
  int refine_ = 0;
};

class GmshSource : public MeshSource {
 public:
  static const Spec<GmshSource>& spec() {
    static const auto s =
        Spec<GmshSource>()
            .key("file", &GmshSource::file_, "A .msh file, version 2.2 or 4.1; relative to the scene.",
                 {.required = true})
            .key("scale", &GmshSource::scale_, kScale, {.range = kPositive})
            .key("order", &GmshSource::order_, kFileOrderSentence, kOrderRule)
            .key("refine", &GmshSource::refine_, kRefineSentence, kRefineRule);
    return s;
  }
  LoadedMesh load() const override {
    require_file(file_);
    LoadedMesh loaded = read_gmsh(file_.path);
    make_names_utf8(loaded, file_.path);
    scale_mesh(loaded.mesh, scale_, file_.path);
    set_order(loaded.mesh, order_);
    for (int i = 0; i < refine_; ++i) refine(loaded);
    return loaded;
  }

 private:
  FilePath file_;
  double scale_ = 1;
  std::optional<int> order_;
  int refine_ = 0;
};

class VegaSource : public MeshSource {
 public:
  static const Spec<VegaSource>& spec() {
    static const auto s =
        Spec<VegaSource>()
            .key("file", &VegaSource::file_, "A .veg file of tetrahedra or cubes; relative to the scene.",
                 {.required = true})
            .key("fixed", &VegaSource::fixed_, "A .bou file: its vertices become the node set `fixed`.")
            .key("scale", &VegaSource::scale_, kScale, {.range = kPositive})
            .key("order", &VegaSource::order_, kFileOrderSentence, kOrderRule)
            .key("refine", &VegaSource::refine_, kRefineSentence, kRefineRule);
    return s;
  }
  LoadedMesh load() const override {
    require_file(file_);
    if (fixed_) require_file(*fixed_);
    LoadedMesh loaded = fixed_ ? read_vega(file_.path, {fixed_->path}) : read_vega(file_.path);
    make_names_utf8(loaded, file_.path);
    scale_mesh(loaded.mesh, scale_, file_.path);
    set_order(loaded.mesh, order_);
    for (int i = 0; i < refine_; ++i) refine(loaded);
    return loaded;
  }
  bool may_bring_materials() const override { return true; }

 private:
  FilePath file_;
  std::optional<FilePath> fixed_;
  double scale_ = 1;
  std::optional<int> order_;
  int refine_ = 0;
};

const bool file_registered[] = {
    Registry<MeshSource>::add<FileSource>("file", "A mesh file of any known format, chosen by its ending."),
    Registry<MeshSource>::add<GmshSource>(
        "gmsh", "A Gmsh file. Physical volumes become regions, physical surfaces surfaces, physical points node sets."),
    Registry<MeshSource>::add<VegaSource>(
        "vega", "A Vega file. Its regions bring their materials and axes: a scene may leave out `materials`."),
};

}  // namespace
}  // namespace orthodyn
