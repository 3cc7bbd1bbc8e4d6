// Runs a comparison: of each group of problems the reference first, then what checks it, then point after point, each
// in a process of its own and one at a time, since times are measured.
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

// The reference of a group and what bounds its error.
struct Reference {
  std::string folder;  // relative to the comparison's; "" if nothing can be measured against it
  std::string method, check_method;
  MeasurementResult result;
  std::optional<MeasurementResult> check;  // of a computed reference
};

// A measurement that is over, for those who wait.
struct Progress {
  std::size_t count = 0;  // of all measurements, as far as is known
  std::string title;      // "damped_beam, cvode_bdf, rtol 1e-3"
  bool cached = false;    // it was done before
  const MeasurementResult& result;
};

class ComparisonRun {
 public:
  // `folder`: of all results. `ranks`: that compute each point. Each measurement is told of when it is over.
  ComparisonRun(const Comparison& comparison, Design design, std::filesystem::path folder, int ranks,
                std::function<void(const Progress&)> tell);

  // What is finished is on disk and is not done again. False if it was interrupted. Calls `after_each` when there is
  // something new to show. Throws as JobQueue::run() does.
  bool run(const JobQueue& queue, const std::function<void()>& after_each);

  const Comparison& comparison() const { return comparison_; }
  const Design& design() const { return design_; }
  int ranks() const { return ranks_; }
  // By group, and by index in design().points; absent while not done.
  const std::map<std::size_t, Reference>& references() const { return references_; }
  const std::map<std::size_t, MeasurementResult>& results() const { return results_; }
  // Where a point's files are, relative to the folder.
  const std::string& point_folder(std::size_t point) const { return point_folders_.at(point); }

 private:
  bool find_reference(const JobQueue& queue, std::size_t group);
  bool measure_points(const JobQueue& queue, std::size_t problem, const std::function<void()>& after_each);
  // Nothing if interrupted.
  std::optional<MeasurementResult> measure_one(const JobQueue& queue, const Job& job);
  MeasurementResult finish(const Job& job, const Json& result, bool cached);

  // `kind`: "points" or "references", the folder that the job's is in. `mesh`: the name of the scene's.
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
  std::function<void(const Progress&)> tell_;
  std::string code_;
  std::map<std::size_t, Reference> references_;
  std::map<std::size_t, MeasurementResult> results_;
  std::map<std::size_t, std::string> point_folders_;
  std::map<std::string, std::string> meshes_;  // fingerprints by name
  FileFingerprints files_;
  std::size_t count_ = 0;
};

}  // namespace orthodyn::study::compare
