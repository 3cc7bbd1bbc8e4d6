// Randomly damaged files of every format either load or are refused with their name.
#include "tests/fuzz/mutation.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <exception>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

#include "lib/core/errors.h"
#include "lib/mesh/io/abaqus.h"
#include "lib/mesh/io/gmsh.h"
#include "lib/mesh/io/tetgen.h"
#include "lib/mesh/io/vega.h"
#include "lib/mesh/io/vtk.h"
#include "lib/mesh/io/vtu.h"

namespace orthodyn::mutation_test {
namespace {

std::string content_of(const std::string& name) {
  std::ifstream file(std::string(ORTHODYN_SOURCE_DIR) + "/tests/mesh/data/" + name, std::ios::binary);
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Format {
  const char* seed;  // a file of tests/mesh/data
  std::function<void(const std::string& path, std::string_view text, FileCells cells)> read;
};

class AnyMutation : public testing::TestWithParam<Format> {};

TEST_P(AnyMutation, LoadsOrIsRefused) {
  const std::string seed = content_of(GetParam().seed);
  std::mt19937 random(20240229);  // its sequence is fixed by the standard
  int loaded = 0;
  constexpr int kFiles = 500;
  constexpr FileCells kCells[] = {FileCells::keep, FileCells::split};
  for (int i = 0; i < kFiles; ++i) {
    const std::string content = with_mutated_bytes(seed, random);
    try {
      GetParam().read("beam", content, kCells[i % 2]);
      ++loaded;
    } catch (const ConfigError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("beam")) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << "mutation " << i << ": " << error.what() << "\n" << content;
    }
  }
  EXPECT_GT(loaded, 0);
  EXPECT_LT(loaded, kFiles);
}

// Two of the three files stay unchanged.
void read_damaged_nodes(const std::string& stem, std::string_view node, FileCells) {
  read_tetgen_text(stem, {node, content_of("cube.ele"), content_of("cube.face")});
}
void read_damaged_elements(const std::string& stem, std::string_view ele, FileCells) {
  read_tetgen_text(stem, {content_of("cube.node"), ele, content_of("cube.face")});
}

void read_damaged_quadratic_elements(const std::string& stem, std::string_view ele, FileCells) {
  read_tetgen_text(stem, {content_of("cube_o2.node"), ele, content_of("cube_o2.face")});
}

INSTANTIATE_TEST_SUITE_P(
    Formats, AnyMutation,
    testing::Values(Format{"two_boxes_22.msh", read_gmsh_text}, Format{"two_boxes_41.msh", read_gmsh_text},
                    Format{"two_tets.veg", read_vega_text}, Format{"two_boxes_gmsh.inp", read_abaqus_text},
                    Format{"two_boxes_meshio_ascii.vtu", read_vtu_text},
                    Format{"two_boxes_meshio_zlib.vtu", read_vtu_text},
                    Format{"two_boxes_meshio_ascii.vtk", read_vtk_text},
                    Format{"two_boxes_meshio_binary.vtk", read_vtk_text}, Format{"cube.node", read_damaged_nodes},
                    Format{"cube.ele", read_damaged_elements}, Format{"octant_22.msh", read_gmsh_text},
                    Format{"octant_41.msh", read_gmsh_text}, Format{"octant_gmsh.inp", read_abaqus_text},
                    Format{"octant_gmsh.vtk", read_vtk_text}, Format{"bricks_22.msh", read_gmsh_text},
                    Format{"bricks_41.msh", read_gmsh_text}, Format{"bricks_o2_22.msh", read_gmsh_text},
                    Format{"bricks_full_22.msh", read_gmsh_text}, Format{"bricks_gmsh.inp", read_abaqus_text},
                    Format{"bricks_gmsh.vtk", read_vtk_text}, Format{"bricks_o2_gmsh.vtk", read_vtk_text},
                    Format{"tube_hexahedra_gmsh.inp", read_abaqus_text}, Format{"tube_wedges_41.msh", read_gmsh_text},
                    Format{"two_instances.inp", read_abaqus_text}, Format{"two_boxes_22_binary.msh", read_gmsh_text},
                    Format{"two_boxes_41_binary.msh", read_gmsh_text},
                    Format{"cube_o2.ele", read_damaged_quadratic_elements}),
    [](const auto& test) {
      std::string name = test.param.seed;
      for (char& c : name) c = c == '.' ? '_' : c;
      return name;
    });

}  // namespace
}  // namespace orthodyn::mutation_test
