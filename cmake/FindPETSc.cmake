# PETSc with real numbers as PETSc::PETSc; it has no CMake configuration of its own. Debian keeps each version in a
# folder below /usr/lib/petscdir, others tell the folder by PETSC_DIR and PETSC_ARCH.
file(GLOB _folders /usr/lib/petscdir/petsc*/*-real)
list(SORT _folders COMPARE NATURAL ORDER DESCENDING)
set(_folders $ENV{PETSC_DIR}/$ENV{PETSC_ARCH} $ENV{PETSC_DIR} ${_folders})
find_path(PETSc_INCLUDE_DIR petscksp.h PATHS ${_folders} PATH_SUFFIXES include)
find_path(PETSc_CONFIG_INCLUDE_DIR petscconf.h PATHS ${_folders} PATH_SUFFIXES include)  # of an arch's own folder
find_library(PETSc_LIBRARY NAMES petsc_real petsc PATHS ${_folders} PATH_SUFFIXES lib)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PETSc REQUIRED_VARS PETSc_LIBRARY PETSc_INCLUDE_DIR PETSc_CONFIG_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install PETSc (Debian: libpetsc-real-dev), or configure with -D ORTHODYN_MPI=OFF")

if(PETSc_FOUND AND NOT TARGET PETSc::PETSc)
  add_library(PETSc::PETSc UNKNOWN IMPORTED)
  set_target_properties(PETSc::PETSc PROPERTIES IMPORTED_LOCATION ${PETSc_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${PETSc_INCLUDE_DIR};${PETSc_CONFIG_INCLUDE_DIR}")
endif()
