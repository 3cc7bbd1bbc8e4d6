// Carries a comparison out: references first, then point after point, each in a process of its own.
// What is finished is on disk and is not done again.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "lib/study/jobs/errand.h"
#include "lib/study/compare/expand.h"
#include "lib/simulation/fingerprints.h"
#include "lib/study/compare/point_result.h"

namespace orthodyn {

// The reference of a problem and what bounds its error; null where there is none.
struct ReferenceResult {
  std::string folder;  // relative to the campaign's; "" if nothing can be measured against it
  std::string method, check_method;
  Json result, check;
};

// One task that is about to be done or was found done, for those who wait.
struct TaskNotice {
  std::size_t number = 0, count = 0;
  std::string title;  // "damped_beam, cvode_bdf, rtol 1e-3"
  bool starts = true;  // else it is over, with `result`
  bool cached = false;
  const Json* result = nullptr;
};

struct CampaignOptions {
  std::filesystem::path folder;
  std::string program;  // the orthodyn executable: started with `measure FOLDER`
  std::function<void(const TaskNotice&)> notify;
  OldFailures failures = OldFailures::keep;
};

class Campaign {
 public:
  Campaign(const Comparison& comparison, Design design, CampaignOptions options);

  // False if it was interrupted. Calls `after_each` when there is something new to show.
  bool run(const std::atomic<bool>& interrupt, const std::function<void()>& after_each);

  const Comparison& comparison() const { return comparison_; }
  const Design& design() const { return design_; }
  // By problem, resp. by index in design().points; absent while not done.
  const std::map<std::size_t, ReferenceResult>& references() const { return references_; }
  const std::map<std::size_t, Json>& results() const { return results_; }
  // Where a point's files are, relative to the folder.
  std::string point_folder(std::size_t point) const { return point_folders_.at(point); }

 private:
  struct Task {
    std::string title, kind;  // kind: "points" or "references"
    Config scene;
    Job job;
    std::size_t problem = 0;
  };
  // The result, from disk if it is there; null if interrupted. Sets `folder`.
  Json perform(const Task& task, const std::atomic<bool>& interrupt, std::string& folder);
  std::string folder_of(const Task& task);
  const std::string& mesh_of(const Task& task);
  Json execute(const std::filesystem::path& folder, const Task& task, const std::atomic<bool>& interrupt) const;
  bool find_reference(std::size_t problem, const std::atomic<bool>& interrupt);
  bool measure_points(std::size_t problem, const std::atomic<bool>& interrupt, const std::function<void()>& after_each);
  Job reference_job() const;

  Comparison comparison_;
  Design design_;
  CampaignOptions options_;
  std::string code_;
  std::map<std::size_t, ReferenceResult> references_;
  std::map<std::size_t, Json> results_;
  std::map<std::size_t, std::string> point_folders_;
  std::map<std::size_t, std::string> meshes_;  // fingerprints by problem
  FileFingerprints files_;
  std::size_t number_ = 0, count_ = 0;
};

}  // namespace orthodyn
