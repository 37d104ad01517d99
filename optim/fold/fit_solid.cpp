#include "optim/fold/fit_solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/lattice/planar/planar_motion.hpp"
#include "optim/fold/looks_on_the_way.hpp"

namespace kinetix::optim {
namespace {

class SolidSearch {
 public:
  SolidSearch(const targets::Solid& solid, int cells, const FoldOptions& options)
      : solid_(solid), cells_(cells), options_(options) {}

  /// Searches theta for this number of columns. @return why the net does not fold, or empty
  std::string try_columns(int columns) {
    design_.net = lay_out(solid_, cells_, columns, options_.size);
    double steepest = 0;
    for (const auto& crease : design_.net.creases)
      steepest = std::max(steepest, std::tan(crease.angle / columns / 2));
    const double sine = steepest / std::tan(options_.tilt),
                 least = std::max(options_.theta.lower, sine < 1 ? std::asin(sine) : pi / 2);
    fold_at(options_.theta.upper);
    if (!(least < options_.theta.upper))
      return fmt::format(
          "with {} a crease tilts of {:.1f} deg would be needed even at theta {:.1f} deg; at most {:.1f} deg "
          "is allowed",
          in_words(columns), to_degrees(std::atan(steepest / std::sin(options_.theta.upper))),
          to_degrees(options_.theta.upper), to_degrees(options_.tilt));
    return try_thetas(columns, least);
  }

  void finish() {
    const model::ExactMotion motion = exact_motion(design_.net.structure);
    design_.error = solid_error(design_.net, motion.at(design_.theta), design_.theta);
  }

  SolidDesign& design() { return design_; }
  double best_share() const { return best_share_; }  ///< free share of the path to theta, [0, 1]

 private:
  static std::string in_words(int columns) {
    return columns == 1 ? "one column" : fmt::format("{} columns", columns);
  }

  void fold_at(double theta) {
    design_.theta = theta;
    design_.tilt = fold_solid(design_.net, theta);
  }

  std::string try_thetas(int columns, double least) {
    double farthest = 0, wanted = 0;
    const int steps = static_cast<int>((options_.theta.upper - least) / look_step);
    for (int k = 0; k <= steps; ++k) {
      if (options_.stop.stop_requested()) return "the search was told to stop";
      fold_at(options_.theta.upper - k * look_step);
      const double free = free_to();
      if (free >= design_.theta) return {};
      best_share_ = std::max(best_share_, free / design_.theta);
      if (wanted == 0 || free / design_.theta > farthest / wanted) farthest = free, wanted = design_.theta;
    }
    if (wanted != 0) fold_at(wanted);
    return fmt::format(
        "with {} a crease walls run into each other at theta {:.1f} deg; the fold needs {:.1f} deg",
        in_words(columns), to_degrees(farthest), to_degrees(wanted));
  }

  /// Returns the last checked theta before walls overlap, or theta if none do.
  double free_to() {
    ++design_.evaluations;
    const model::ExactMotion motion = exact_motion(design_.net.structure);
    MotionOverlapSearch looks(
        design_.net.structure, options_.clearance, [&](double theta) { return motion.at(theta); },
        options_.threads);
    if (!looks.touching_at_rest().empty()) return 0;
    const std::vector<double> thetas = looks_up_to(design_.theta);
    const auto overlap = looks.first_overlap(thetas);
    if (!overlap) return design_.theta;
    return overlap->look == 0 ? 0 : thetas[overlap->look - 1];
  }

  const targets::Solid& solid_;
  int cells_;
  const FoldOptions& options_;
  double best_share_ = 0;
  SolidDesign design_;
};

}  // namespace

SolidDesign fit_solid(const targets::Solid& solid, int cells, int columns, const FoldOptions& options,
                      const Progress& progress) {
  options.validate();
  SolidSearch search(solid, cells, options);
  SolidDesign& design = search.design();
  const int first = columns > 0 ? columns : 1, last = columns > 0 ? columns : most_solid_columns;
  for (int k = first; k <= last && !design.folds; ++k) {
    if (options.stop.stop_requested() && k > first) break;
    progress("search", static_cast<double>(k - first) / (last - first + 1),
             fmt::format("{} of {} columns a crease, best free to {:.0f} % of its way", k, last,
                         100 * search.best_share()));
    const std::string why = search.try_columns(k);
    design.attempts.push_back({0, {k}, why});
    design.folds = why.empty();
  }
  design.stopped = !design.folds && options.stop.stop_requested();
  search.finish();
  return std::move(design);
}

}  // namespace kinetix::optim
