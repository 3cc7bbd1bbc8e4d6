# Compile options of our own code, and functions that define modules and the library.

add_library(orthodyn_options INTERFACE)
target_include_directories(orthodyn_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(orthodyn_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion
  -fno-math-errno  # compiles sqrt to an instruction
  # False alarms of g++ 12 in its own headers (AVX-512, std::string).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-uninitialized -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds>
  # Warnings about the ABI of batches, which are passed within one library only.
  -Wno-psabi)
if(ORTHODYN_PROCESSOR)
  target_compile_options(orthodyn_options INTERFACE -march=${ORTHODYN_PROCESSOR})
endif()
# Eigen's default alignment depends on the processor. With fixed values, a program and the library may be compiled for
# different processors.
set(ORTHODYN_EIGEN_ALIGNMENT EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=64)
target_compile_definitions(orthodyn_options INTERFACE ${ORTHODYN_EIGEN_ALIGNMENT})
# Sanitizers instrument the library and the program but not the tests, which halves the build time.
add_library(orthodyn_sanitizers INTERFACE)
if(ORTHODYN_SANITIZE)
  # Pointer checks that the address sanitizer covers are off, which saves a quarter of the build time.
  target_compile_options(orthodyn_sanitizers INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer
                         -fno-sanitize-recover=undefined -fno-sanitize=null,alignment,object-size,vptr)
  target_link_options(orthodyn_options INTERFACE -fsanitize=address,undefined)
  # Other code frees memory that instrumented code allocates, so Eigen must not choose its allocator by the sanitizer.
  list(APPEND ORTHODYN_EIGEN_ALIGNMENT EIGEN_MALLOC_ALREADY_ALIGNED=0)
  target_compile_definitions(orthodyn_options INTERFACE ${ORTHODYN_EIGEN_ALIGNMENT})
endif()
if(ORTHODYN_FUZZ)
  target_compile_options(orthodyn_options INTERFACE -O1 -g1 -fsanitize=address,undefined,fuzzer-no-link
                         -fno-sanitize-recover=undefined -fno-sanitize=vptr)
  target_link_options(orthodyn_options INTERFACE -fsanitize=address,undefined)
endif()

# Programs also use position-independent code; otherwise they could not share the precompiled headers of the library.
target_compile_options(orthodyn_options INTERFACE -fPIC)

# orthodyn_precompiled_headers(NAME HEADER LIBRARIES...): defines target NAME, for REUSE_FROM of
# target_precompile_headers().
function(orthodyn_precompiled_headers name header)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${name}.cc CONTENT "")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/${name}.cc)
  target_link_libraries(${name} PRIVATE ${ARGN} orthodyn_options)
  target_precompile_headers(${name} PRIVATE ${PROJECT_SOURCE_DIR}/${header})
endfunction()
orthodyn_precompiled_headers(orthodyn_precompiled cmake/precompiled.h Eigen3::Eigen fmt::fmt orthodyn_sanitizers)

# Code that computes little is compiled with -O1 in release builds, which takes a third less time than -O3. With
# -fexpensive-optimizations, g++ joins products and sums to one rounding as with -O3, so that results are the same. It
# accepts precompiled headers only with the same -O.
if(CMAKE_BUILD_TYPE STREQUAL Release)
  add_library(orthodyn_light_options INTERFACE)
  target_compile_options(orthodyn_light_options INTERFACE -O1
    $<$<CXX_COMPILER_ID:GNU>:-fexpensive-optimizations>)
  orthodyn_precompiled_headers(orthodyn_light_precompiled cmake/precompiled.h
    Eigen3::Eigen fmt::fmt orthodyn_sanitizers orthodyn_light_options)
endif()

# orthodyn_compile(TARGET NAME): options and precompiled headers of the module NAME. With CMAKE_UNITY_BUILD, its sources
# are compiled together: the headers, and what they instantiate, take half of the time of eight sources.
function(orthodyn_compile target name)
  target_link_libraries(${target} PRIVATE orthodyn_options orthodyn_sanitizers)
  if(name IN_LIST ORTHODYN_LIGHT AND TARGET orthodyn_light_options)
    target_link_libraries(${target} PRIVATE orthodyn_light_options)
    target_precompile_headers(${target} REUSE_FROM orthodyn_light_precompiled)
  else()
    target_precompile_headers(${target} REUSE_FROM orthodyn_precompiled)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 0)
endfunction()

# orthodyn_module(NAME FOLDER DEPENDENCIES...): compiles the sources below FOLDER into the object library orthodyn_NAME.
function(orthodyn_module name folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cc)
  add_library(orthodyn_${name} OBJECT ${sources})
  target_link_libraries(orthodyn_${name} PUBLIC Eigen3::Eigen ${ARGN})
  orthodyn_compile(orthodyn_${name} ${name})
endfunction()

# orthodyn_library(NAMES...): links these modules into one shared library `orthodyn`.
function(orthodyn_library)
  set(objects)
  set(modules)
  foreach(name ${ARGN})
    if(ORTHODYN_BUILT AND name IN_LIST ORTHODYN_NOT_SANITIZED)
      file(GLOB_RECURSE built CONFIGURE_DEPENDS ${ORTHODYN_BUILT}/CMakeFiles/orthodyn_${name}.dir/*.o)
      list(APPEND objects ${built})
    else()
      list(APPEND objects $<TARGET_OBJECTS:orthodyn_${name}>)
    endif()
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
    SUNDIALS::arkode SUNDIALS::cvodes SUNDIALS::idas SUNDIALS::kinsol SUNDIALS::nvecserial SUNDIALS::sunlinsolklu
    SUNDIALS::sunmatrixsparse $<$<BOOL:${ORTHODYN_CERES}>:Ceres::ceres>)
  if(ORTHODYN_SANITIZE)
    target_link_options(orthodyn PUBLIC -fsanitize=address,undefined)
  endif()
  # Plugins contain inlined code of the headers, so they need the same minor version.
  set_target_properties(orthodyn PROPERTIES VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endfunction()
