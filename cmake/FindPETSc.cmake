# Defines PETSc::PETSc with real numbers and 32-bit indices, since PETSc has no CMake configuration. Headers and library
# come from one folder: that of PETSC_DIR and PETSC_ARCH if set, otherwise Debian's newest version.
set(_folders)
if(DEFINED ENV{PETSC_DIR})
  list(APPEND _folders $ENV{PETSC_DIR}/$ENV{PETSC_ARCH} $ENV{PETSC_DIR})
else()
  file(GLOB _folders /usr/lib/petscdir/petsc3*/*-real)
  list(SORT _folders COMPARE NATURAL ORDER DESCENDING)
endif()
foreach(_folder IN LISTS _folders)
  find_path(PETSc_CONFIG_INCLUDE_DIR petscconf.h PATHS ${_folder}/include NO_DEFAULT_PATH)
  find_library(PETSc_LIBRARY NAMES petsc_real petsc PATHS ${_folder}/lib NO_DEFAULT_PATH)
  find_path(PETSc_INCLUDE_DIR petscksp.h PATHS ${_folder}/include $ENV{PETSC_DIR}/include NO_DEFAULT_PATH)
endforeach()
if(PETSc_CONFIG_INCLUDE_DIR)
  file(STRINGS ${PETSc_CONFIG_INCLUDE_DIR}/petscconf.h _other REGEX "define PETSC_USE_(COMPLEX|64BIT_INDICES|REAL_SINGLE)")
  if(_other)
    message(WARNING "The PETSc in ${PETSc_CONFIG_INCLUDE_DIR} does not use real numbers with 32-bit indices: ${_other}")
    set(PETSc_LIBRARY PETSc_LIBRARY-NOTFOUND)
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PETSc REQUIRED_VARS PETSc_LIBRARY PETSc_INCLUDE_DIR PETSc_CONFIG_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install PETSc (Debian: libpetsc-real-dev), or configure with -D ORTHODYN_MPI=OFF")

if(PETSc_FOUND AND NOT TARGET PETSc::PETSc)
  add_library(PETSc::PETSc UNKNOWN IMPORTED)
  set_target_properties(PETSc::PETSc PROPERTIES IMPORTED_LOCATION ${PETSc_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${PETSc_INCLUDE_DIR};${PETSc_CONFIG_INCLUDE_DIR}")
endif()
