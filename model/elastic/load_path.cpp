#include "model/elastic/load_path.hpp"

#include <algorithm>
#include <cmath>

#include "model/closure_drive.hpp"
#include "model/elastic/branch.hpp"
#include "model/elastic/predictor.hpp"
#include "model/invalid_input.hpp"

namespace kinetix {
namespace {

using Kind = PathEvent::Kind;
using Stop = LoadPath::Stop;

constexpr double most_growth = 2;
constexpr double least_growth = 0.25;
constexpr double rough = 2e-3;
constexpr double level = 1e-5;
constexpr double aimed_jump = 0.4;
constexpr double strayed = 2;
constexpr double careful_from = 0.01;
constexpr int careful_iterations = 15;
constexpr double near_closed_form = 0.01;
constexpr double bent_load = 0.01;
constexpr double energy_noise = 1e-13;
constexpr int most_saddles = 5;
constexpr double steep = 30;

void check(const char* field, double value, bool fine, const char* allowed) {
  if (!fine) throw InvalidInput(std::string(field) + " is " + number_text(value) + ", must be " + allowed);
}

class Follower {
 public:
  Follower(const Structure& structure, const Elasticity& elasticity, const Drive& drive,
           const LoadPathOptions& options, const std::function<void(const LoadStep&, const State&)>& frame)
      : structure_(structure),
        unit_(energy_unit(elasticity, structure.size.edge_mm)),
        options_(options),
        frame_(frame),
        goal_(drive.theta()),
        planar_(options.planar.value_or(all_vertical(structure))),
        system_(structure, elasticity, drive, planar_, options.contact),
        tangent_(system_.freedoms()),
        branch_(system_, goal_, options.side),
        predictor_(system_) {
    path_.planar = planar_;
    path_.state = rest_state(structure);
  }

  LoadPath run() {
    start();
    double step = std::min(options_.first_step, std::abs(goal_));
    while (path_.theta != goal_) {
      const double left = std::abs(goal_ - path_.theta);
      const double theta =
          step >= left * (1 - 1e-9) ? goal_ : path_.theta + std::copysign(step, goal_);
      const bool last_chance = step <= options_.least_step || step < 1e-9 * left;
      if (!advance(theta, last_chance)) {
        if (last_chance) return finish(stop_);
        step = std::max(step * std::min(0.5, growth_), options_.least_step);
        continue;
      }
      if (path_.steps.back().gap > options_.gap_limit) return finish(Stop::torn);
      step = std::clamp(step * growth_, options_.least_step, longest_step());
    }
    return finish(Stop::reached);
  }

 private:
  void start() {
    system_.linearise(path_.state, 0, tangent_);
    has_tangent_ = tangent_.factorise(0);
    path_.steps.push_back(measured(path_.state, 0, has_tangent_));
    is_exact_ = (!between_plates() || system_.drive().grip) && keeps_to_closed_form();
    if (frame_) frame_(path_.steps.back(), path_.state);
  }

  double longest_step() const {
    const bool touching = path_.steps.back().contacts > 0;
    return touching ? std::min(options_.longest_step, options_.longest_step_touching) : options_.longest_step;
  }

  bool is_short(double theta) const {
    return std::abs(theta - path_.theta) <= options_.longest_step_touching * (1 + 1e-9);
  }

  bool meets_walls(const LoadStep& step) const { return path_.steps.back().contacts == 0 && step.contacts > 0; }

  /// Whether the energy changes by the work of the loads at both ends of a step: a jump on the way loses some.
  bool keeps_energy(const LoadStep& step) const {
    const LoadStep& before = path_.steps.back();
    const double way = (step.drive - before.drive) * system_.travel();
    const auto [least, most] = std::minmax({before.load * way, step.load * way});
    const double slack = (most - least) / 2 + bent_load * std::max(std::abs(least), std::abs(most)) +
                         energy_noise * (unit_ + step.energy);
    const double change = step.energy - before.energy;
    return change >= least - slack && change <= most + slack;
  }

  /// One step to `theta`. @return whether it was taken
  bool advance(double theta, bool last_chance) {
    const State prediction = predicted(theta);
    const double multiplier = system_.multiplier();
    State state = prediction;
    const bool short_step = last_chance || is_short(theta);
    NewtonOptions options = newton_options(theta, short_step);
    if (!last_chance && std::abs(theta - path_.theta) > careful_from) {
      options.starts_convex = true;
      options.max_iterations = std::min(options.max_iterations, careful_iterations);
    }
    search(theta, options, has_tangent_, state);
    const bool branched = newton_.converged && !newton_.stable && leave_saddle(theta, state);
    const double jump = newton_.converged ? turn_distance(structure_, prediction, state) : NAN;
    const bool jumped = !branched && jump > options_.longest_jump;
    const bool tunnelled = newton_.converged && !branched && system_.passed_through(path_.state, state);
    if (newton_.converged && !tunnelled && (!jumped || short_step)) {
      const LoadStep step = measured(state, theta, newton_.stable);
      const bool lost = !branched && !keeps_energy(step);
      if (short_step || !(lost || meets_walls(step))) {
        growth_ = branched || jumped || lost ? 1 : growth_after(jump);
        take(step, std::move(state), branched, jumped || lost);
        return true;
      }
    }
    growth_ = newton_.converged && !tunnelled && !jumped ? least_growth : growth_after(jump);
    tunnelled_ = tunnelled;
    blocking_ = system_.contacts(state);
    stop_ = path_.steps.back().contacts == 0 && blocking_.empty() && !tunnelled ? Stop::not_converged : Stop::locked;
    system_.set_multiplier(multiplier);
    restore_tangent();
    return false;
  }

  void search(double theta, const NewtonOptions& options, bool factorised, State& state) {
    newton_ = minimise(system_, theta, options, state, tangent_, factorised);
    path_.iterations += newton_.iterations;
  }

  /// On the way, the step after one of `rough` is quadratically small, and good enough to go on from.
  NewtonOptions newton_options(double theta, bool short_step) const {
    NewtonOptions options = options_.newton;
    if (!short_step) options.most_moved = strayed * options_.longest_jump;
    if (theta == goal_) return options;
    options.step_tolerance = std::max(options.step_tolerance, rough);
    options.energy_tolerance = level;
    options.drive_tolerance = std::max(options.drive_tolerance, rough * rough);
    return options;
  }

  /// Factor for the next step: the error of a prediction grows with the step as Predictor::order() says.
  double growth_after(double jump) const {
    if (!std::isfinite(jump)) return least_growth;
    const double room = aimed_jump * options_.longest_jump / std::max(jump, 1e-12);
    return std::clamp(std::pow(room, 1.0 / (predictor_.order() + 1)), least_growth, most_growth);
  }

  /// Along the tangent, or the closed form while the path keeps to it: that leads through singular points.
  State predicted(double theta) {
    State state = path_.state;
    if (has_tangent_)
      state = predictor_.predict(path_.state, path_.theta, theta, tangent_);
    else
      system_.place(theta, state);
    if (!is_exact_) return state;
    State exact = *branch_.exact_state(theta);
    return system_.energy(exact, theta) < system_.energy(state, theta) ? exact : state;
  }

  bool keeps_to_closed_form() const {
    const auto exact = branch_.exact_state(path_.theta);
    return exact && turn_distance(structure_, path_.state, *exact) <= near_closed_form;
  }

  void restore_tangent() {
    system_.linearise(path_.state, path_.theta, tangent_);
    has_tangent_ = tangent_.factorise(0);
  }

  /// From a balance that is no minimum down to one that is, over further saddles if need be; where that fails,
  /// there is no balance to take. @return whether it was left: not where its softest direction is neutral
  bool leave_saddle(double theta, State& state) {
    int tries = 0;
    for (; newton_.converged && !newton_.stable; ++tries) {
      newton_.converged = tries < most_saddles;
      if (!newton_.converged) break;
      const Branch::Start start = branch_.leave(theta, state, tangent_);
      if (start.way == Branch::Way::none) break;
      newton_.converged = start.way != Branch::Way::unknown;
      if (!newton_.converged) break;
      if (tries == 0 || start.way != Branch::Way::softest) way_ = start.way;
      const double saddle = system_.energy(state, theta);
      state = start.state;
      search(theta, newton_options(theta, true), false, state);
      newton_.converged = newton_.converged && system_.energy(state, theta) <= saddle;
    }
    return tries > 0;
  }

  LoadStep measured(const State& state, double theta, bool stable) const {
    LoadStep step;
    step.theta = theta;
    step.drive = system_.drive_coordinate(theta);
    step.load = system_.load(state, theta) * load_unit();
    step.energy = system_.elastic_energy(state) * unit_;
    step.gap = hinge_gaps(structure_, state).max;
    step.contacts = static_cast<int>(system_.contacts(state).size());
    step.stable = stable;
    return step;
  }

  void take(const LoadStep& step, State state, bool branched, bool jumped) {
    const double since = path_.theta;
    if (branched || jumped)
      predictor_.restart();
    else
      predictor_.move_on(path_.theta);
    path_.state = std::move(state);
    path_.theta = step.theta;
    is_exact_ = (is_exact_ || branched) && keeps_to_closed_form();
    if (branched) off_closed_form_since_ = way_ == Branch::Way::off_exact ? step.theta : NAN;
    has_tangent_ = newton_.stable;
    path_.steps.push_back(step);
    if (frame_) frame_(step, path_.state);
    report(step, since, branched, jumped);
  }

  void report(const LoadStep& step, double since, bool branched, bool jumped) {
    const auto add = [&](Kind kind, std::string what) {
      path_.events.push_back({kind, step, since, std::move(what)});
    };
    const LoadStep& before = path_.steps[path_.steps.size() - 2];
    if (branched)
      add(Kind::bifurcation, "the balance turned unstable: left along the " + way_left());
    if (jumped) add(Kind::snap, "jumped to another state at nearly the same drive");
    if (before.contacts == 0 && step.contacts > 0) add(Kind::contact, touching(system_.contacts(path_.state)));
    if (before.contacts > 0 && step.contacts == 0) add(Kind::release, "walls no longer touch");
    report_lock(step, before, add);
  }

  std::string way_left() const {
    switch (way_) {
      case Branch::Way::exact:
        return is_exact_ ? "exact mode" : "exact mode, to less energy off the closed form";
      case Branch::Way::off_exact:
        return "softest direction, since the closed form is unstable too";
      default:
        return "softest direction";
    }
  }

  std::string touching(const std::vector<Contact>& contacts) const {
    if (contacts.empty()) return "walls touch";
    const auto wall = [&](int plate) { return to_string(structure_.hinges[plate / 2].wall); };
    return "walls " + wall(contacts.front().plate) + " and " + wall(contacts.front().other) + " touch";
  }

  template <class Add>
  void report_lock(const LoadStep& step, const LoadStep& before, const Add& add) {
    const double change = step.drive - before.drive;
    if (change == 0) return;
    const double slope = (step.load - before.load) / change;
    if (step.contacts == 0) free_slope_ = std::max(free_slope_, std::abs(slope));
    if (locked_ || step.contacts == 0 || before.contacts == 0 || !(slope > steep * free_slope_)) return;
    locked_ = true;
    add(Kind::lock, "walls carry the drive: the load rises " + number_text(std::round(slope / free_slope_)) +
                        " times as steeply as without contact");
  }

  LoadPath finish(Stop stop) {
    path_.stop = stop;
    path_.gaps = hinge_gaps(structure_, path_.state);
    path_.why = reason(stop);
    if (stop == Stop::locked && path_.steps.back().contacts == 0)
      path_.events.push_back({Kind::contact, path_.steps.back(), path_.theta, touching(blocking_)});
    if (stop == Stop::locked && !locked_)
      path_.events.push_back({Kind::lock, path_.steps.back(), path_.theta, path_.why});
    path_.multiplier = system_.multiplier();
    for (const RestHinge& h : system_.hinges()) {
      HingeEnergy e = hinge_energy(h, system_.stiffness(), path_.state[h.lower], path_.state[h.upper],
                                   structure_.size.edge_mm);
      path_.hinge_energies.push_back({e.stretch * unit_, e.turn * unit_});
    }
    return std::move(path_);
  }

  bool between_plates() const { return system_.drive().kind == Drive::Kind::plates; }
  double load_unit() const { return between_plates() ? unit_ / structure_.size.edge_mm : unit_; }

  std::string at() const {
    const LoadStep& last = path_.steps.back();
    return " at theta " + number_text(to_degrees(last.theta)) + " deg, load " + number_text(last.load) +
           (between_plates() ? " N" : " N mm") + off_closed_form();
  }

  std::string off_closed_form() const {
    if (!std::isfinite(off_closed_form_since_)) return "";
    return "; off the closed form since theta " + number_text(to_degrees(off_closed_form_since_)) +
           " deg, where that is unstable";
  }

  std::string reason(Stop stop) const {
    switch (stop) {
      case Stop::reached:
        return "the drive reached its goal" + at();
      case Stop::torn:
        return "the hinge on wall " + to_string(structure_.hinges[path_.gaps.worst_hinge].wall) +
               " stretched by " + number_text(path_.gaps.max) + " cell edges, allowed are " +
               number_text(options_.gap_limit) + ";" + at();
      case Stop::locked:
        return std::string("walls in contact lock the structure: ") +
               (tunnelled_ ? "further on they would have to pass through each other;"
                           : "no balance found further on;") +
               at();
      case Stop::not_converged:
        break;
    }
    return "no balance found further on (" + number_text(newton_.iterations) + " iterations, force " +
           number_text(newton_.force) + " left);" + at();
  }

  const Structure& structure_;
  const double unit_;  ///< of energies, N mm
  const LoadPathOptions& options_;
  const std::function<void(const LoadStep&, const State&)>& frame_;
  const double goal_;
  const bool planar_;
  ElasticSystem system_;
  Tangent tangent_;
  Branch branch_;
  Predictor predictor_;
  NewtonResult newton_;
  LoadPath path_;
  Stop stop_ = Stop::not_converged;
  std::vector<Contact> blocking_;  ///< of the last state that was not taken
  bool has_tangent_ = false, is_exact_ = false, tunnelled_ = false;
  Branch::Way way_ = Branch::Way::softest;  ///< in which the last saddle was left
  double off_closed_form_since_ = NAN;      ///< theta; NaN where the path did not leave it for being unstable
  double growth_ = 1, free_slope_ = 0;
  bool locked_ = false;
};

}  // namespace

void LoadPathOptions::validate() const {
  check("side", side, side == 1 || side == -1, "1 or -1");
  check("first_step", first_step, first_step > 0 && first_step <= 0.5, "in (0, 0.5] rad");
  check("longest_step", longest_step, longest_step > 0 && longest_step <= 0.5, "in (0, 0.5] rad");
  check("longest_step_touching", longest_step_touching,
        longest_step_touching > 0 && longest_step_touching <= 0.5, "in (0, 0.5] rad");
  check("least_step", least_step, least_step > 0 && least_step <= first_step, "in (0, first_step] rad");
  check("longest_jump", longest_jump, longest_jump > 0, "positive");
  check("gap_limit", gap_limit, gap_limit > 0, "positive");
}

std::string to_string(PathEvent::Kind kind) {
  switch (kind) {
    case Kind::bifurcation:
      return "bifurcation";
    case Kind::snap:
      return "snap";
    case Kind::limit_point:
      return "limit point";
    case Kind::contact:
      return "contact";
    case Kind::release:
      return "release";
    case Kind::lock:
      break;
  }
  return "lock";
}

std::string to_string(LoadPath::Stop stop) {
  switch (stop) {
    case Stop::reached:
      return "reached";
    case Stop::torn:
      return "torn";
    case Stop::locked:
      return "locked";
    case Stop::not_converged:
      break;
  }
  return "not converged";
}

LoadPath follow_load(const Structure& structure, const Elasticity& elasticity, const Drive& drive,
                     const LoadPathOptions& options,
                     const std::function<void(const LoadStep&, const State&)>& frame) {
  options.validate();
  elasticity.validate();
  validate(drive, structure);
  return Follower(structure, elasticity, drive, options, frame).run();
}

}  // namespace kinetix
