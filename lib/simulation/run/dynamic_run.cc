// A dynamic analysis of a scene: integrated from its start or from a checkpoint to its end, and what it writes.
#include <fmt/format.h>

#include <algorithm>

#include "lib/config/registry.h"
#include "lib/config/values.h"
#include "lib/simulation/checkpoint/resume.h"
#include "lib/simulation/checkpoint/scene_changes.h"
#include "lib/simulation/error_estimate/estimated_error.h"
#include "lib/simulation/output/disk_reserve.h"
#include "lib/simulation/output/run_observers.h"
#include "lib/simulation/run/model_keys.h"
#include "lib/simulation/run/model_summary.h"
#include "lib/simulation/run/run_context.h"
#include "lib/simulation/run/run_record.h"
#include "lib/simulation/run/several_ranks.h"

namespace orthodyn {

namespace {

CheckpointTimes checkpoint_times(const Scene& scene) {
  if (!scene.checkpoint) return {.never = true};
  return {scene.checkpoint->every, scene.checkpoint->frames.value_or(0), false};
}

// A run that ended early, by an event as well, can be taken up again whether or not the scene asks for checkpoints; one
// that completed can be extended if it does. A checkpoint that is there is kept up to date.
bool keeps_last_state(const Scene& scene, const Outcome& outcome, bool resumed) {
  return scene.checkpoint || resumed || outcome.status != Outcome::Status::completed || !outcome.remark.empty();
}

void require_whole_run(const Setup& setup) {
  for (const auto& event : setup.events)
    if (event.stops)
      throw ConfigError(
          fmt::format("--estimate-error compares two runs over the whole time, and the event '{}' stops "
                      "them: remove one of the two",
                      event.name));
}

std::size_t outputs_left(const Plan& plan) {
  const auto is_left = [&](double t) { return !plan.delivered || t > *plan.delivered; };
  return static_cast<std::size_t>(std::count_if(plan.output_times.begin(), plan.output_times.end(), is_left));
}

FailurePlace failure_place(const FemModel& model, const State& last) {
  const auto speed = model.evaluate("speed.largest", last);
  const auto det_f = model.evaluate("det_f.smallest", last);
  return {det_f[0], speed[0], static_cast<long>(det_f[1]), static_cast<long>(speed[1])};
}

class DynamicAnalysis {
 public:
  explicit DynamicAnalysis(RunContext context)
      : context_(std::move(context)), setup_(context_.setup), folder_(context_.folder) {}

  RunResult run() {
    if (folder_.is_completed_without_checkpoint()) return accept_completed();
    const bool resumes = context_.earlier && context_.earlier->begun;
    Checkpoint begin = resumes ? continued(std::move(*context_.earlier), setup_, context_.resolved, folder_)
                               : first_checkpoint(setup_, context_.resolved, folder_);
    begin.effort = begin.effort + Effort{{}, setup_.wall_seconds, setup_.cpu_seconds};
    // One that was killed after its last step still lacks its record.
    if (resumes && is_complete(begin, setup_.scene) && begin.restarts.back().after == "completed")
      return nothing_to_do(begin.state.t);
    if (context_.request.estimate_error) {
      require_whole_run(setup_);
      estimator_.emplace(setup_, plan_of(setup_.scene, begin.schedule));
    }
    RunObservers observers(setup_, folder_.path());
    resumes ? resume(begin, observers) : prepare_anew();
    const RunRecord record(folder_.path(), context_.scene, context_.set, begin.restarts, model_keys(setup_.config));
    write_file(folder_.path() / "scene.yaml", {begin.scene});
    // Killed from here on, it can be resumed.
    if (!resumes && setup_.scene.checkpoint) begin.save(folder_.checkpoint());
    return compute(begin, observers, record);
  }

 private:
  void prepare_anew() {
    if (context_.request.resume)
      context_.listener.on_notice(
          fmt::format("nothing to resume in {}: starts from the beginning", folder_.path().string()));
    folder_.prepare();
  }

  void resume(const Checkpoint& begin, RunObservers& observers) {
    observers.restore(begin);
    context_.listener.on_notice(fmt::format(
        "resumes at t = {:.6g} s; the integrator starts anew there: a multistep method at order 1", begin.state.t));
    if (const auto& changed = begin.restarts.back().changed; !changed.empty())
      context_.listener.on_notice("changed since the checkpoint: " + join(changed));
  }

  RunResult compute(const Checkpoint& begin, RunObservers& observers, const RunRecord& record) {
    RunResult result{.scene = context_.scene, .folder = folder_.path()};
    result.ranks = number_of(context_.request.ranks);
    result.outcome = integrate(begin, observers, result.resumable);
    result.failed_alone = failed_alone_;
    if (setup_.linearity) setup_.linearity->finish();
    result.model = summarize(setup_);
    if (setup_.linearity && result.outcome.status != Outcome::Status::interrupted)
      result.outgrown = setup_.linearity->why_to_start_again();
    if (result.outgrown) return result;
    result.motion = motion_result(result.outcome, begin.effort, observers);
    if (observers.extremes) result.extremes = observers.extremes->found();
    if (observers.strains) result.passed_strain = observers.strains->worst();
    record.finish(result);
    if (parts_ && result.outcome.status == Outcome::Status::completed) {
      result.motion->accumulated = accumulated(result.outcome.last.t);
      record.finish(result);
    }
    context_.listener.on_result(result);
    if (!estimator_ || result.outcome.status != Outcome::Status::completed) return result;
    result.motion->error = repeat();
    record.finish(result);
    return result;
  }

  Outcome integrate(const Checkpoint& begin, RunObservers& observers, bool& resumable) {
    Checkpointer checkpointer(folder_.checkpoint(), begin, checkpoint_times(setup_.scene), observers.kept(),
                              *setup_.built.model, *setup_.integrator);
    Plan plan = plan_of(setup_.scene, begin.schedule);
    const State state = setup_.built.model->part(begin.state);
    plan.events = observers.events();
    if (begin.begun) plan.delivered = begin.last_output, plan.history_delivered = begin.last_history;
    const auto progress = context_.listener.on_begin(setup_);
    auto all = observers.all(progress.get(), checkpointer);
    if (estimator_) all.push_back(&estimator_->recorder());
    if (setup_.scene.output.accumulated_error) all.push_back(&parts_.emplace(*setup_.built.model));
    if (setup_.scene.output.mesh_error) all.push_back(&mesh_error_.emplace(outputs_left(plan)));
    DiskReserve reserve(folder_.path(), bytes_of_checkpoint());
    Outcome outcome = orthodyn::run(*setup_.built.model, *setup_.integrator, state, plan, all, context_.interrupt);
    reserve.release();
    failed_alone_ = outcome.status == Outcome::Status::failed && failed_alone(setup_.built.model->ranks());
    if (!failed_alone_) outcome.cpu_seconds = setup_.built.model->space().sum(outcome.cpu_seconds);
    const bool kept = keep(outcome, begin.begun, checkpointer);
    resumable = kept || setup_.scene.checkpoint;
    return outcome;
  }

  // At most: displacements and velocities, three vectors of the watch over linear kinematics, and small parts.
  std::size_t bytes_of_checkpoint() const {
    constexpr std::size_t kSmallParts = 64 << 10;
    return 5 * sizeof(double) * static_cast<std::size_t>(setup_.built.model->num_dofs_of_all()) + kSmallParts +
           2 * context_.resolved.size();
  }

  // False if it cannot be written: a run that has failed is not to fail in another way.
  bool keep(const Outcome& outcome, bool resumed, Checkpointer& checkpointer) {
    try {
      if (failed_alone_ || !outcome.between_steps)
        return outcome.reason == Reason::disk && checkpointer.write_remembered();
      if (!keeps_last_state(setup_.scene, outcome, resumed)) return false;
      checkpointer.write(outcome.last);
      return true;
    } catch (const RunError& e) {
      context_.listener.on_warning(fmt::format("no checkpoint of the last state: {}", e.what()));
      return false;
    }
  }

  MotionResult motion_result(const Outcome& outcome, const Effort& before, const RunObservers& observers) const {
    const Integrator& integrator = *setup_.integrator;
    const InversionWatch& inversion = observers.inversion;
    Statistics statistics = integrator.statistics();
    statistics.observation = outcome.observation;
    MotionResult out{.integrator = setup_.config.at("integrator").at("type").text(),
                     .decisions = integrator.decisions(),
                     .warnings = integrator.result_warnings(),
                     .effort = before + Effort{statistics, outcome.wall_seconds, outcome.cpu_seconds},
                     .factor_bytes = integrator.factor_bytes(),
                     .det_f = {inversion.smallest(), inversion.element(), inversion.time()}};
    if (const auto& e = observers.energy)
      out.energy = {e->last(), e->time(), e->drift(), e->scale(), e->relative_drift(), e->times(), e->states()};
    if (const auto& m = observers.momentum) out.momentum = {m->angular_drift(), m->angular_scale()};
    out.silent_events = observers.silent_events();
    if (mesh_error_) out.mesh_error = mesh_error_->found();
    if (out.mesh_error && outcome.status == Outcome::Status::completed)
      out.mesh_error =
          look_closer(setup_.scene, *setup_.built.model, *mesh_error_->most_deformed(), true, *out.mesh_error).error;
    out.rtol = Registry<IntegratorChoice>::read(setup_.config.at("integrator"))->settings().rtol;
    if (outcome.status == Outcome::Status::failed && !failed_alone_)
      out.failure = failure_place(*setup_.built.model, outcome.last);
    return out;
  }

  // None where it cannot be had: a run that has completed is not to fail in another way.
  std::optional<AccumulatedError> accumulated(double end) {
    try {
      return accumulated_error(setup_, *setup_.integrator, *parts_, end, context_.interrupt);
    } catch (const std::exception& e) {
      context_.listener.on_warning(fmt::format("how far errors have added up is not known: {}", e.what()));
      return std::nullopt;
    }
  }

  // The run once more, for the estimate of its error.
  ErrorEstimate repeat() {
    context_.listener.on_notice(fmt::format("repeats with {} to estimate the error", join(estimator_->refinement())));
    const auto progress = context_.listener.on_begin(setup_);
    return estimator_->estimate(progress ? std::vector{progress.get()} : std::vector<Observer*>{}, context_.interrupt);
  }

  RunResult nothing_to_do(double end) const {
    RunResult result{.scene = context_.scene, .folder = folder_.path(), .was_complete = true};
    result.outcome.last.t = end;
    return result;
  }

  // A completed run without a checkpoint: it needs nothing, unless the scene has changed.
  RunResult accept_completed() const {
    const auto earlier = with_defaults(Config::from_file((folder_.path() / "scene.yaml").string()));
    const auto changed = changed_keys(earlier, Config::from_text(context_.resolved));
    const bool longer = std::find(changed.begin(), changed.end(), "time.end") != changed.end();
    if (!longer && refused_changes(changed).empty())
      return nothing_to_do(read_number(earlier.at("time").at("end"), {.unit = "s"}));
    throw ConfigError(folder_.path().string(),
                      fmt::format("holds a completed run without a checkpoint, which cannot be resumed with other "
                                  "values ({}); start anew with --force in place of --resume",
                                  join(changed)));
  }

  RunContext context_;
  const Setup& setup_;
  ResultFolder& folder_;
  std::optional<ErrorEstimator> estimator_;
  std::optional<PartRecorder> parts_;
  std::optional<MeshErrorRecorder> mesh_error_;
  bool failed_alone_ = false;  // the other ranks are waiting for this one
};

}  // namespace

RunResult run_dynamic_analysis(RunContext context) { return DynamicAnalysis(std::move(context)).run(); }

}  // namespace orthodyn
