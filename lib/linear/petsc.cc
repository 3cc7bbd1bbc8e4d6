// PETSc's Krylov methods and preconditioners (Balay et al.), in a separate library liborthodyn_petsc that is loaded at
// first use: PETSc, MPI and their dependencies take 0.1 s to load and 0.5 s to start, which runs without PETSc do not
// spend.
#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "lib/linear/petsc_library.h"
#include "lib/linear/solver.h"

namespace orthodyn {
namespace {

#ifdef ORTHODYN_MPI

// The file in the folder of the library that contains this code.
std::string library_file() {
  Dl_info own{};
  dladdr(reinterpret_cast<const void*>(&library_file), &own);
  const std::filesystem::path folder = std::filesystem::absolute(own.dli_fname).parent_path();
  return (folder / "liborthodyn_petsc.so").string();
}

void* load_library() {
  const std::string file = library_file();
  // RTLD_GLOBAL, since Open MPI's plugins look for its symbols.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (!library) throw ConfigError(fmt::format("PETSc: {} cannot be loaded: {}", file, dlerror()));
  return library;
}

std::unique_ptr<LinearSolver> make_petsc(const std::string& options) {
  static auto* const make = reinterpret_cast<MakePetscSolver*>(petsc_function("orthodyn_make_petsc_solver"));
  return std::unique_ptr<LinearSolver>(make(options));
}

constexpr const char* kUnavailable = "";

#else

std::unique_ptr<LinearSolver> make_petsc(const std::string&) { return nullptr; }

constexpr const char* kUnavailable =
    "this orthodyn was built without PETSc; configure it with -D ORTHODYN_MPI=ON (Debian: libpetsc-real-dev)";

#endif

const bool petsc_registered =
    register_solver("petsc", {"PETSc's conjugate gradients on the reduced n x n matrix, preconditioned by its diagonal "
                              "blocks or by algebraic multigrid, whichever takes less; large systems. `{type: petsc, "
                              "options: \"-pc_type hypre\"}` passes options on to PETSc; symmetric tangents.",
                              false, make_petsc, true, kUnavailable, true});

}  // namespace

void* petsc_function(const char* name) {
#ifdef ORTHODYN_MPI
  static void* const library = load_library();
  if (void* function = dlsym(library, name)) return function;
  throw ConfigError(fmt::format("{} belongs to another version of orthodyn", library_file()));
#else
  static_cast<void>(name);
  throw ConfigError(kUnavailable);
#endif
}

}  // namespace orthodyn
