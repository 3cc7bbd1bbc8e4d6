// Runs a comparison: for each group of problems the reference, then its check, then the points. Every measurement has
// its own process. They run one after another, so that they do not disturb each other's times.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "lib/simulation/run/fingerprints.h"
#include "lib/study/compare/comparison_design.h"
#include "lib/study/compare/measurement_result.h"
#include "lib/study/jobs/job_queue.h"

namespace orthodyn::study::compare {

// The reference of a group and the check that bounds its error.
struct Reference {
  std::string folder;  // relative to the comparison's folder; "" if the reference failed
  std::string method, check_method;
  MeasurementResult result;
  std::optional<MeasurementResult> check;  // empty for an exact or a failed reference
};

// A finished measurement, for progress messages.
struct Progress {
  std::size_t count = 0;  // number of measurements of the whole comparison
  std::string title;      // "damped_beam, cvode_bdf, rtol 0.001"
  bool cached = false;    // taken from an earlier run
  const MeasurementResult& result;
};

class ComparisonRun {
 public:
  // `folder` holds all results. `ranks`: MPI ranks per measurement. `report` is called after each measurement.
  ComparisonRun(const Comparison& comparison, Design design, std::filesystem::path folder, int ranks,
                std::function<void(const Progress&)> report);

  // Measurements already on disk are not repeated. Calls `after_each` after the reference of each group and after each
  // point, also if the result was on disk. Returns false if interrupted. Throws as JobQueue::run() does.
  bool run(const JobQueue& queue, const std::function<void()>& after_each);

  const Comparison& comparison() const { return comparison_; }
  const Design& design() const { return design_; }
  int ranks() const { return ranks_; }
  // References by index in design().groups, and results by index in design().points. Entries are absent until they are
  // known.
  const std::map<std::size_t, Reference>& references() const { return references_; }
  const std::map<std::size_t, MeasurementResult>& results() const { return results_; }
  // Folder of a point, relative to the comparison's folder. Precondition: run() has started the point's problem.
  const std::string& point_folder(std::size_t point) const { return point_folders_.at(point); }

 private:
  bool find_reference(const JobQueue& queue, std::size_t group);
  bool measure_points(const JobQueue& queue, std::size_t problem, const std::function<void()>& after_each);
  // Empty if interrupted.
  std::optional<MeasurementResult> measure_one(const JobQueue& queue, const Job& job);
  MeasurementResult finish(const Job& job, const Json& result, bool cached);

  // `kind`: the parent folder, "points" or "references". `mesh`: key of the mesh's fingerprint in meshes_.
  Job job_for(const std::string& title, const std::string& kind, const Config& scene, const std::string& mesh,
              const MeasurementInput& input);
  std::string fingerprint(const Config& scene, const std::string& mesh, const MeasurementInput& input);
  const std::string& mesh_of(const Config& scene, const std::string& mesh);
  MeasurementInput point_input(std::size_t group) const;
  MeasurementInput reference_input() const;
  std::string relative_folder(const Job& job) const;

  Comparison comparison_;
  Design design_;
  std::filesystem::path folder_;
  int ranks_;
  std::function<void(const Progress&)> report_;
  std::string code_;
  std::map<std::size_t, Reference> references_;
  std::map<std::size_t, MeasurementResult> results_;
  std::map<std::size_t, std::string> point_folders_;
  std::map<std::string, std::string> meshes_;  // mesh fingerprints, see job_for()
  FileFingerprints files_;
  std::size_t count_ = 0;
};

}  // namespace orthodyn::study::compare
