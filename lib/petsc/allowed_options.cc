// The options of PETSc that a scene may give: those that choose and tune a method.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>
#include <vector>

#include "lib/core/errors.h"
#include "lib/core/spelling.h"
#include "lib/petsc/session.h"

namespace orthodyn::petsc {

namespace {

// Options of PETSc 3.18, without "-". Options of MUMPS that set Fortran output units or write factors to disk are
// excluded.
const std::vector<std::string>& allowed() {
  static const std::vector<std::string> names{
      "ksp_atol", "ksp_cg_single_reduction", "ksp_chebyshev_eigenvalues", "ksp_chebyshev_esteig",
      "ksp_chebyshev_esteig_noisy", "ksp_chebyshev_esteig_steps", "ksp_check_norm_iteration", "ksp_converged_maxits",
      "ksp_converged_use_initial_residual_norm", "ksp_converged_use_min_initial_residual_norm", "ksp_diagonal_scale",
      "ksp_diagonal_scale_fix", "ksp_divtol", "ksp_fcg_mmax", "ksp_fcg_nprealloc", "ksp_fcg_truncation_type",
      "ksp_gmres_breakdown_tolerance", "ksp_gmres_cgs_refinement_type", "ksp_gmres_classicalgramschmidt",
      "ksp_gmres_haptol", "ksp_gmres_modifiedgramschmidt", "ksp_gmres_preallocate", "ksp_gmres_restart", "ksp_lag_norm",
      "ksp_max_it", "ksp_norm_type", "ksp_pc_side", "ksp_richardson_scale", "ksp_richardson_self_scale", "ksp_rtol",
      "ksp_type",
      //
      "mat_coarsen_misk_distance", "mat_coarsen_type", "mat_mumps_cntl_1", "mat_mumps_cntl_3", "mat_mumps_cntl_4",
      "mat_mumps_cntl_5", "mat_mumps_cntl_7", "mat_mumps_icntl_6", "mat_mumps_icntl_7", "mat_mumps_icntl_8",
      "mat_mumps_icntl_10", "mat_mumps_icntl_12", "mat_mumps_icntl_13", "mat_mumps_icntl_14", "mat_mumps_icntl_23",
      "mat_mumps_icntl_24", "mat_mumps_icntl_28", "mat_mumps_icntl_29", "mat_mumps_icntl_35", "mat_mumps_icntl_36",
      "mat_mumps_icntl_38", "matptap_via",
      //
      "pc_asm_blocks", "pc_asm_local_blocks", "pc_asm_local_type", "pc_asm_overlap", "pc_asm_type", "pc_bjacobi_blocks",
      "pc_bjacobi_local_blocks", "pc_eisenstat_no_diagonal_scaling", "pc_eisenstat_omega", "pc_factor_column_pivot",
      "pc_factor_diagonal_fill", "pc_factor_fill", "pc_factor_in_place", "pc_factor_levels",
      "pc_factor_mat_ordering_type", "pc_factor_mat_solver_type", "pc_factor_nonzeros_along_diagonal",
      "pc_factor_pivot_in_blocks", "pc_factor_reuse_fill", "pc_factor_reuse_ordering", "pc_factor_shift_amount",
      "pc_factor_shift_type", "pc_factor_zeropivot", "pc_gamg_agg_nsmooths", "pc_gamg_aggressive_coarsening",
      "pc_gamg_asm_use_agg", "pc_gamg_coarse_eq_limit", "pc_gamg_coarse_grid_layout_type", "pc_gamg_eigenvalues",
      "pc_gamg_process_eq_limit", "pc_gamg_rank_reduction_factors", "pc_gamg_repartition",
      "pc_gamg_reuse_interpolation", "pc_gamg_square_graph", "pc_gamg_threshold", "pc_gamg_threshold_scale",
      "pc_gamg_type", "pc_gamg_use_parallel_coarse_grid_solver", "pc_gamg_use_sa_esteig", "pc_hypre_boomeramg_agg_nl",
      "pc_hypre_boomeramg_agg_num_paths", "pc_hypre_boomeramg_coarsen_type", "pc_hypre_boomeramg_cycle_type",
      "pc_hypre_boomeramg_eu_bj", "pc_hypre_boomeramg_eu_droptolerance", "pc_hypre_boomeramg_eu_level",
      "pc_hypre_boomeramg_grid_sweeps_all", "pc_hypre_boomeramg_grid_sweeps_coarse",
      "pc_hypre_boomeramg_grid_sweeps_down", "pc_hypre_boomeramg_grid_sweeps_up", "pc_hypre_boomeramg_interp_refine",
      "pc_hypre_boomeramg_interp_type", "pc_hypre_boomeramg_max_coarse_size", "pc_hypre_boomeramg_max_iter",
      "pc_hypre_boomeramg_max_levels", "pc_hypre_boomeramg_max_row_sum", "pc_hypre_boomeramg_measure_type",
      "pc_hypre_boomeramg_min_coarse_size", "pc_hypre_boomeramg_no_CF", "pc_hypre_boomeramg_nodal_coarsen",
      "pc_hypre_boomeramg_nodal_coarsen_diag", "pc_hypre_boomeramg_nodal_relaxation", "pc_hypre_boomeramg_numfunctions",
      "pc_hypre_boomeramg_outer_relax_weight_all", "pc_hypre_boomeramg_outer_relax_weight_level",
      "pc_hypre_boomeramg_P_max", "pc_hypre_boomeramg_relax_type_all", "pc_hypre_boomeramg_relax_type_coarse",
      "pc_hypre_boomeramg_relax_type_down", "pc_hypre_boomeramg_relax_type_up", "pc_hypre_boomeramg_relax_weight_all",
      "pc_hypre_boomeramg_relax_weight_level", "pc_hypre_boomeramg_restriction_type",
      "pc_hypre_boomeramg_smooth_num_levels", "pc_hypre_boomeramg_smooth_type", "pc_hypre_boomeramg_strong_threshold",
      "pc_hypre_boomeramg_tol", "pc_hypre_boomeramg_truncfactor", "pc_hypre_boomeramg_vec_interp_qmax",
      "pc_hypre_boomeramg_vec_interp_smooth", "pc_hypre_boomeramg_vec_interp_variant", "pc_hypre_type", "pc_jacobi_abs",
      "pc_jacobi_fixdiagonal", "pc_jacobi_type", "pc_kaczmarz_lambda", "pc_kaczmarz_symmetric", "pc_mg_cycle_type",
      "pc_mg_distinct_smoothup", "pc_mg_levels", "pc_mg_multiplicative_cycles", "pc_mg_type", "pc_redundant_number",
      "pc_sor_backward", "pc_sor_diagonal_shift", "pc_sor_forward", "pc_sor_its", "pc_sor_lits",
      "pc_sor_local_backward", "pc_sor_local_forward", "pc_sor_local_symmetric", "pc_sor_omega", "pc_sor_symmetric",
      "pc_telescope_reduction_factor", "pc_telescope_subcomm_type", "pc_type", "pc_use_amat"};
  return names;
}

// Prefixes of nested solvers.
constexpr std::string_view kPrefixes[] = {"mg_levels_", "mg_coarse_", "mg_fine_",        "sub_",
                                          "redundant_", "telescope_", "pc_gamg_esteig_", "esteig_"};

std::string without_prefixes(std::string_view name) {
  for (bool found = true; found;) {
    found = false;
    for (const std::string_view prefix : kPrefixes)
      if (name.starts_with(prefix)) {
        name.remove_prefix(prefix.size());
        found = true;
      }
    const auto digits = std::min(name.find_first_not_of("0123456789"), name.size());  // number of a level
    if (digits > 0 && digits < name.size() && name[digits] == '_') name.remove_prefix(digits + 1);
  }
  return std::string(name);
}

// PETSc's rule: "-1e-3" is a value, not an option.
bool is_name(std::string_view word) {
  return word.size() > 1 && word[0] == '-' &&
         (std::isalpha(static_cast<unsigned char>(word[1])) || word[1] == '-' || word[1] == '_');
}

// Excludes quotes and the characters of file names and viewers.
bool is_plain(std::string_view word) {
  return std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '+' || c == '.' || c == ',';
  });
}

}  // namespace

void require_allowed(const std::string& options) {
  constexpr const char* kElse = "; give other options in the environment variable PETSC_OPTIONS";
  std::istringstream words(options);
  bool is_first = true;
  for (std::string word; words >> word; is_first = false) {
    if (!is_plain(word))
      throw ConfigError(fmt::format(
          "linear solver 'petsc': '{}': names and values of options may contain only letters, digits and _ - + . ,{}",
          word, kElse));
    if (is_name(word)) {
      const std::string name = without_prefixes(std::string_view(word).substr(1));
      if (std::find(allowed().begin(), allowed().end(), name) != allowed().end()) continue;
      throw ConfigError(
          fmt::format("linear solver 'petsc': '{}' is not allowed in a scene, which may give only options that choose "
                      "and tune a method{}{}",
                      word, did_you_mean(name, allowed()), kElse));
    }
    if (is_first)
      throw ConfigError("linear solver 'petsc': '" + options +
                        "' is not a list of options such as -ksp_type cg -pc_type gamg");
  }
}

}  // namespace orthodyn::petsc
