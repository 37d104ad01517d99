#include "app/goals/fold/crease_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/result/search_json.hpp"
#include "targets/document/number.hpp"

namespace kinetix::app {
namespace {

constexpr double told_miss = 0.001;  // degrees of a crease, and share of a face's edge: less is no matter

}  // namespace

double largest_miss(const std::vector<FoldedCrease>& creases) {
  double most = 0;
  for (const FoldedCrease& crease : creases) most = std::max(most, std::abs(crease.reached - crease.asked));
  return most;
}

std::string in_words(const std::vector<FoldedCrease>& creases, double rms) {
  const double miss = to_degrees(largest_miss(creases));
  return fmt::format("{} crease{} within {:.3g} deg, faces {} of their edge from the solid (rms)",
                     creases.size(), creases.size() == 1 ? "" : "s", std::max(miss, told_miss),
                     rms < told_miss ? fmt::format("less than {:g}", told_miss) : fmt::format("{:.3g}", rms));
}

std::vector<std::string> violations(const FoldFile& file, const std::vector<FoldedCrease>& creases,
                                    double rms, const std::string& who) {
  std::vector<std::string> why;
  for (const FoldedCrease& crease : creases)
    if (!(std::abs(crease.reached - crease.asked) <= file.angle_tolerance))
      why.push_back(fmt::format(
          "{}: crease `{}` folds by {:.2f} deg; {:.2f} deg is required, within {:.3g} deg", who, crease.name,
          to_degrees(crease.reached), to_degrees(crease.asked), to_degrees(file.angle_tolerance)));
  if (!(rms <= file.shape_tolerance))
    why.push_back(
        fmt::format("{}: faces are off the solid by {:.3g} of their edge; at most {:.3g} is allowed", who,
                    rms, file.shape_tolerance));
  return why;
}

optim::FoldOptions search_of(const FoldFile& file) {
  optim::FoldOptions options;
  options.size = file.size;
  options.tilt = file.tilt;
  options.theta = file.theta;
  return options;
}

void add_fold_metrics(const std::vector<FoldedCrease>& creases, double rms, const std::string& state,
                      nlohmann::ordered_json& metrics) {
  nlohmann::ordered_json& folds = metrics["fold" + state + "_deg"] = nlohmann::ordered_json::array();
  for (const FoldedCrease& crease : creases) folds.push_back(to_degrees(crease.reached));
  metrics["fold_miss" + state + "_deg"] = to_degrees(largest_miss(creases));
  metrics["face_rms" + state] = rms;
}

nlohmann::ordered_json closed_form_json(std::size_t starts, int evaluations, bool stopped, bool folds,
                                        const std::string& why_not) {
  nlohmann::ordered_json out = {{"solver", "closed form"}, {"starts", starts}, {"evaluations", evaluations}};
  add_end(stopped, folds, "every crease reaches its angle at one theta, with no wall in the way", why_not,
          out);
  return out;
}

}  // namespace kinetix::app
