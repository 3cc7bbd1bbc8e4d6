# Compile options of our own code, and the functions that make modules and the library of them.

add_library(orthodyn_options INTERFACE)
target_include_directories(orthodyn_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(orthodyn_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion
  -fno-math-errno  # so that sqrt is an instruction
  # False alarms of g++ 12 in its own headers (AVX-512, std::string).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-uninitialized -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds>
  # Batches are passed within one library only.
  -Wno-psabi)
if(ORTHODYN_PROCESSOR)
  target_compile_options(orthodyn_options INTERFACE -march=${ORTHODYN_PROCESSOR})
endif()
# Eigen's own depend on the processor; with these a program may be compiled for another one than the library.
set(ORTHODYN_EIGEN_ALIGNMENT EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=64)
target_compile_definitions(orthodyn_options INTERFACE ${ORTHODYN_EIGEN_ALIGNMENT})
# The library and the program are what is watched; tests are not: half of the build time.
add_library(orthodyn_sanitizers INTERFACE)
if(ORTHODYN_SANITIZE)
  # But for what the address sanitizer sees, too, of every pointer: a quarter of the build time.
  target_compile_options(orthodyn_sanitizers INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer
                         -fno-sanitize-recover=undefined -fno-sanitize=null,alignment,object-size,vptr)
  target_link_options(orthodyn_options INTERFACE -fsanitize=address,undefined)
  # What is allocated here is freed there: Eigen is not to ask whether it is watched.
  list(APPEND ORTHODYN_EIGEN_ALIGNMENT EIGEN_MALLOC_ALREADY_ALIGNED=0)
  target_compile_definitions(orthodyn_options INTERFACE ${ORTHODYN_EIGEN_ALIGNMENT})
endif()
if(ORTHODYN_FUZZ)
  target_compile_options(orthodyn_options INTERFACE -O1 -g1 -fsanitize=address,undefined,fuzzer-no-link
                         -fno-sanitize-recover=undefined -fno-sanitize=vptr)
  target_link_options(orthodyn_options INTERFACE -fsanitize=address,undefined)
endif()

# Position-independent code as in a library for programs, too: else they could not share its precompiled headers.
target_compile_options(orthodyn_options INTERFACE -fPIC)

# orthodyn_precompiled_headers(NAME HEADER LIBRARIES...): target NAME, for REUSE_FROM of target_precompile_headers().
function(orthodyn_precompiled_headers name header)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${name}.cc CONTENT "")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/${name}.cc)
  target_link_libraries(${name} PRIVATE ${ARGN} orthodyn_options)
  target_precompile_headers(${name} PRIVATE ${PROJECT_SOURCE_DIR}/${header})
endfunction()
orthodyn_precompiled_headers(orthodyn_precompiled cmake/precompiled.h Eigen3::Eigen fmt::fmt orthodyn_sanitizers)

# orthodyn_module(NAME FOLDER DEPENDENCIES...): the sources below FOLDER as object library
# orthodyn_NAME, which sees only what it depends on.
function(orthodyn_module name folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cc)
  add_library(orthodyn_${name} OBJECT ${sources})
  target_link_libraries(orthodyn_${name} PUBLIC Eigen3::Eigen ${ARGN} PRIVATE orthodyn_options orthodyn_sanitizers)
  target_precompile_headers(orthodyn_${name} REUSE_FROM orthodyn_precompiled)
endfunction()

# orthodyn_library(NAMES...): all modules as one shared library `orthodyn`.
function(orthodyn_library)
  set(objects)
  set(modules)
  foreach(name ${ARGN})
    list(APPEND objects $<TARGET_OBJECTS:orthodyn_${name}>)
    list(APPEND modules orthodyn_${name})
  endforeach()
  add_library(orthodyn SHARED ${objects})
  add_library(orthodyn::orthodyn ALIAS orthodyn)
  target_include_directories(orthodyn PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/orthodyn>)
  target_compile_features(orthodyn PUBLIC cxx_std_20)
  target_compile_definitions(orthodyn PUBLIC ${ORTHODYN_EIGEN_ALIGNMENT})
  target_link_libraries(orthodyn PUBLIC Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json PRIVATE
    yaml-cpp muparser::muparser Udunits2::udunits2 pugixml::pugixml ZLIB::ZLIB TBB::tbb SuiteSparse::cholmod SuiteSparse::klu
    ${CMAKE_DL_LIBS}
    SUNDIALS::arkode SUNDIALS::cvode SUNDIALS::ida SUNDIALS::kinsol SUNDIALS::nvecserial SUNDIALS::sunlinsolklu
    SUNDIALS::sunmatrixsparse)
  if(ORTHODYN_SANITIZE)
    target_link_options(orthodyn PUBLIC -fsanitize=address,undefined)
  endif()
  # A plugin holds inlined code of the headers: it is of one minor version.
  set_target_properties(orthodyn PROPERTIES VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endfunction()
