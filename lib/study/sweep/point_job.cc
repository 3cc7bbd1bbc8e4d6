// A sweep's point as JSON: what is to be done, from the process that sweeps to the one that evaluates.
#include "lib/study/sweep/evaluate.h"

namespace orthodyn {

namespace {

template <class T>
Json optional_json(const std::optional<T>& x) {
  return x ? Json(*x) : Json();
}

template <class T>
std::optional<T> optional_from(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<T>(json.get<T>());
}

// What people read (title, unit, closed form) does not change what is computed.
Json to_json(const WantedFigure& f) {
  return {{"quantity", f.quantity},
          {"take", Value<Take>::yaml(f.take)},
          {"at", optional_json(f.at)},
          {"of", optional_json(f.of)},
          {"settled_within", optional_json(f.settled_within)},
          {"mode", optional_json(f.mode)},
          {"along", f.along ? Json(Value<Component>::yaml(*f.along)) : Json()},
          {"about_equilibrium", f.about_equilibrium},
          {"cost", f.cost}};
}

template <class E>
E word(const Json& json) {
  return Value<E>::read(Config::from_text("v: " + json.get<std::string>()).at("v"), {});
}

WantedFigure figure_from(const Json& json) {
  WantedFigure f;
  f.quantity = json.at("quantity");
  f.take = word<Take>(json.at("take"));
  f.at = optional_from<double>(json.at("at"));
  f.of = optional_from<double>(json.at("of"));
  f.settled_within = optional_from<double>(json.at("settled_within"));
  f.mode = optional_from<int>(json.at("mode"));
  if (!json.at("along").is_null()) f.along = word<Component>(json.at("along"));
  f.about_equilibrium = json.at("about_equilibrium");
  f.cost = json.at("cost");
  f.origin.where = "quantities";
  return f;
}

}  // namespace

Json PointJob::json() const {
  Json all = Json::object();
  for (const auto& [name, f] : figures) all[name] = to_json(f);
  return {{"figures", all},
          {"frame", optional_json(frame)},
          {"frame_at", optional_json(frame_at)},
          {"seconds", seconds},
          {"code", code}};
}

PointJob PointJob::from(const Json& json) {
  PointJob job;
  for (const auto& [name, f] : json.at("figures").items()) job.figures.emplace_back(name, figure_from(f));
  job.frame = optional_from<std::string>(json.at("frame"));
  job.frame_at = optional_from<double>(json.at("frame_at"));
  job.seconds = json.at("seconds");
  job.code = json.at("code");
  return job;
}

}  // namespace orthodyn
