# Defines SuiteSparse::cholmod and SuiteSparse::klu with their dependencies, since SuiteSparse in Debian 12 has no CMake
# configuration.
find_path(SuiteSparse_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
set(_required SuiteSparse_INCLUDE_DIR)
foreach(_part suitesparseconfig amd btf camd ccolamd colamd cholmod klu)
  find_library(SuiteSparse_${_part}_LIBRARY ${_part})
  list(APPEND _required SuiteSparse_${_part}_LIBRARY)
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS ${_required}
  REASON_FAILURE_MESSAGE "install SuiteSparse (Debian: libsuitesparse-dev)")

if(SuiteSparse_FOUND)
  foreach(_part cholmod klu)
    if(NOT TARGET SuiteSparse::${_part})
      add_library(SuiteSparse::${_part} UNKNOWN IMPORTED)
      set_target_properties(SuiteSparse::${_part} PROPERTIES
        IMPORTED_LOCATION ${SuiteSparse_${_part}_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${SuiteSparse_INCLUDE_DIR})
    endif()
  endforeach()
endif()
