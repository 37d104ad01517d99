#include "model/elastic/equilibrium_path.hpp"

#include <algorithm>
#include <cmath>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/closure_drive.hpp"
#include "model/elastic/branch.hpp"
#include "model/elastic/drive_load.hpp"
#include "model/elastic/predictor.hpp"

namespace kinetix::model {
namespace {

using Kind = PathEvent::Kind;
using Stop = EquilibriumPath::Stop;

constexpr double most_growth = 2;      // times the last step: one small error promises no more
constexpr double least_growth = 0.25;  // times the last step: a large error tells little about how much less
constexpr double rough = 2e-3;      // rad, cell edges: on the way, a step this short leaves about its square
constexpr double level = 1e-5;      // of the energy, by which that step may lower it: more is a slow valley
constexpr double aimed_jump = 0.4;  // of longest_jump: near 1, more steps fail; near 0, more are needed
constexpr double strayed = 2;       // times longest_jump: so far from a prediction lies another branch
// Rad: longer steps must start convex and end soon; if not, halving is cheaper.
constexpr double careful_from = 0.01;
constexpr int careful_iterations = 15;     // of Newton's method, for such a step
constexpr double near_closed_form = 0.01;  // rad of a hinge: up to here, a path keeps to the closed form
constexpr double bent_load = 0.01;         // of the work of a step: loads between its ends are not on a line
constexpr double energy_noise = 1e-13;     // of the energy and of k_point edge^2: rounding of a difference
constexpr int most_saddles = 5;  // left in a row at one theta: after more, there is no equilibrium to take
constexpr double steep = 30;     // times the steepest slope of the load before contact: walls carry it

void check(const char* field, double value, bool fine, const char* allowed) {
  if (!fine) throw InvalidInput(std::string(field) + " is " + number_text(value) + ", must be " + allowed);
}

class Follower {
 public:
  Follower(const DrivenLinkage& driven, const Elasticity& elasticity, const EquilibriumPathOptions& options,
           const std::function<void(const EquilibriumStep&, const State&)>& frame)
      : structure_(driven.linkage),
        unit_(energy_unit(elasticity, structure_.size.edge_mm)),
        options_(options),
        frame_(frame),
        goal_(driven.drive.theta()),
        planar_(options.planar.value_or(all_vertical(structure_))),
        system_(structure_, elasticity, driven.drive, planar_, options.contact),
        soft_(turns_softly(system_)),
        tangent_(system_.dofs()),
        branch_(system_, driven.exact, goal_, options.side),
        predictor_(system_) {
    path_.planar = planar_;
    path_.state = rest_state(structure_);
  }

  EquilibriumPath run() {
    start();
    double step = std::min(options_.first_step, std::abs(goal_));
    while (path_.theta != goal_) {
      const double left = std::abs(goal_ - path_.theta);
      const double theta = step >= left * (1 - 1e-9) ? goal_ : path_.theta + std::copysign(step, goal_);
      const bool last_chance = step <= options_.least_step || step < 1e-9 * left;
      if (!advance(theta, last_chance)) {
        if (last_chance) return finish(stop_);
        step = std::max(step * std::min(0.5, growth_), options_.least_step);
        continue;
      }
      if (path_.steps.back().gap > options_.gap_limit) return finish(Stop::overstretched);
      step = std::clamp(step * growth_, options_.least_step, longest_step());
    }
    return finish(Stop::reached);
  }

 private:
  void start() {
    system_.linearise(path_.state, 0, tangent_);
    has_tangent_ = tangent_.factorise(0);
    path_.steps.push_back(measured(path_.state, 0, has_tangent_));
    is_exact_ = (!between_plates() || system_.drive().grips_part) && keeps_to_closed_form();
    if (frame_) frame_(path_.steps.back(), path_.state);
  }

  double longest_step() const {
    const bool touching = path_.steps.back().contacts > 0;
    return touching ? std::min(options_.longest_step, options_.longest_step_touching) : options_.longest_step;
  }

  bool is_short(double theta) const {
    return std::abs(theta - path_.theta) <= options_.longest_step_touching * (1 + 1e-9);
  }

  bool meets_walls(const EquilibriumStep& step) const {
    return path_.steps.back().contacts == 0 && step.contacts > 0;
  }

  /// Whether the energy changes by the work of the loads at both ends of a step: a jump on the way loses some.
  bool keeps_energy(const EquilibriumStep& step) const {
    const EquilibriumStep& before = path_.steps.back();
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
    bool left_flat = soft_ && path_.theta == 0 && leave_flat(theta, state);
    if (!left_flat) search(theta, options, has_tangent_, state);
    const bool left_saddle = newton_.converged && !newton_.stable && leave_saddle(theta, state);
    if (newton_.converged && is_mirrored(theta, state)) left_flat = leave_flat(theta, state);
    const bool branched = left_flat || left_saddle;
    const double jump = newton_.converged ? turn_distance(structure_, prediction, state) : NAN;
    const bool jumped = !branched && jump > options_.longest_jump;
    const bool tunnelled = newton_.converged && !branched && system_.passed_through(path_.state, state);
    mirrored_ = newton_.converged && is_mirrored(theta, state);
    if (newton_.converged && !tunnelled && !mirrored_ && (!jumped || short_step)) {
      const EquilibriumStep step = measured(state, theta, newton_.stable);
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
    stop_ = path_.steps.back().contacts == 0 && blocking_.empty() && !tunnelled ? Stop::not_converged
                                                                                : Stop::locked;
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

  /// Flat between plates bears no load that counts beside rounding where hinges turn softly, and hardly any elsewhere:
  /// minimising the energy from there may leave the side to chance. @return whether flat was left, on purpose
  bool leave_flat(double theta, State& state) {
    if (!between_plates() || is_exact_) return false;
    State flat = path_.state;
    system_.place(theta, flat);
    system_.linearise(flat, theta, tangent_);
    if (tangent_.factorise(0)) return false;
    Branch::Start start = branch_.leave(theta, flat, tangent_);
    if (start.way == Branch::Way::none || start.way == Branch::Way::unknown) return false;
    way_ = start.way;
    state = std::move(start.state);
    search(theta, newton_options(theta, true), false, state);
    return true;
  }

  /// Whether a sheet between plates, which force it to one side as little as to the other, lies on the closed form
  /// of the side that was not asked for.
  bool is_mirrored(double theta, const State& state) const {
    if (!between_plates() || system_.drive().grips_part) return false;
    const auto other = branch_.exact_state(-theta);
    if (!other) return false;
    const double from_other = turn_distance(structure_, state, *other);
    return from_other <= near_closed_form &&
           from_other < turn_distance(structure_, state, *branch_.exact_state(theta));
  }

  /// From an equilibrium that is no minimum down to one that is, over further saddles if need be; where that fails,
  /// there is no equilibrium to take. @return whether it was left: not where its lowest mode is neutral
  bool leave_saddle(double theta, State& state) {
    int tries = 0;
    for (; newton_.converged && !newton_.stable; ++tries) {
      newton_.converged = tries < most_saddles;
      if (!newton_.converged) break;
      const Branch::Start start = branch_.leave(theta, state, tangent_);
      if (start.way == Branch::Way::none) break;
      newton_.converged = start.way != Branch::Way::unknown;
      if (!newton_.converged) break;
      if (tries == 0 || start.way != Branch::Way::lowest_mode) way_ = start.way;
      const double saddle = system_.energy(state, theta);
      state = start.state;
      search(theta, newton_options(theta, true), false, state);
      newton_.converged = newton_.converged && system_.energy(state, theta) <= saddle;
    }
    return tries > 0;
  }

  EquilibriumStep measured(const State& state, double theta, bool stable) const {
    EquilibriumStep step;
    step.theta = theta;
    step.drive = system_.drive_coordinate(theta);
    step.load = drive_load(system_, state, theta, tangent_, stable) * load_unit();
    step.energy = system_.elastic_energy(state) * unit_;
    step.gap = hinge_gaps(structure_, state).max;
    step.contacts = static_cast<int>(system_.contacts(state).size());
    step.stable = stable;
    return step;
  }

  void take(const EquilibriumStep& step, State state, bool branched, bool jumped) {
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

  void report(const EquilibriumStep& step, double since, bool branched, bool jumped) {
    const auto add = [&](Kind kind, std::string what) {
      PathEvent& event = path_.events.emplace_back();
      event.kind = kind;
      event.at = step;
      event.since = since;
      event.what = std::move(what);
    };
    const EquilibriumStep& before = path_.steps[path_.steps.size() - 2];
    if (branched) add(Kind::bifurcation, "the equilibrium turned unstable: left along the " + way_left());
    if (jumped) add(Kind::snap, "jumped to another state at nearly the same drive");
    if (before.contacts == 0 && step.contacts > 0)
      add(Kind::contact, touching(system_.contacts(path_.state)));
    if (before.contacts > 0 && step.contacts == 0) add(Kind::release, "walls no longer touch");
    report_lock(step, before, add);
  }

  std::string way_left() const {
    switch (way_) {
      case Branch::Way::exact:
        return is_exact_ ? "exact mode" : "exact mode, to less energy off the closed form";
      case Branch::Way::off_exact:
        return "lowest mode, since the closed form is unstable too";
      default:
        return "lowest mode";
    }
  }

  std::string touching(const std::vector<Contact>& contacts) const {
    if (contacts.empty()) return "walls touch";
    const auto wall = [&](int plate) { return structure_.wall_name(ContactModel::hinge(plate)); };
    return "walls " + wall(contacts.front().plate) + " and " + wall(contacts.front().other) + " touch";
  }

  template <class Add>
  void report_lock(const EquilibriumStep& step, const EquilibriumStep& before, const Add& add) {
    const double change = step.drive - before.drive;
    if (change == 0) return;
    const double slope = (step.load - before.load) / change;
    if (step.contacts == 0) free_slope_ = std::max(free_slope_, std::abs(slope));
    if (locked_ || step.contacts == 0 || before.contacts == 0 || !(slope > steep * free_slope_)) return;
    locked_ = true;
    add(Kind::lock, "walls carry the drive: the load rises " + number_text(std::round(slope / free_slope_)) +
                        " times as steeply as without contact");
  }

  EquilibriumPath finish(Stop stop) {
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

  bool between_plates() const { return system_.drive().kind == LinkageDrive::Kind::plates; }
  double load_unit() const { return between_plates() ? unit_ / structure_.size.edge_mm : unit_; }

  std::string at() const {
    const EquilibriumStep& last = path_.steps.back();
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
      case Stop::overstretched:
        return "the hinge on wall " + structure_.wall_name(path_.gaps.worst_hinge) + " stretched by " +
               number_text(path_.gaps.max) + " cell edges; at most " + number_text(options_.gap_limit) +
               " is allowed;" + at();
      case Stop::locked:
        return std::string("walls in contact lock the structure: ") +
               (tunnelled_ ? "further on they would have to pass through each other;"
                           : "no equilibrium found further on;") +
               at();
      case Stop::not_converged:
        break;
    }
    if (mirrored_) return "further on the sheet folds to the other side than asked;" + at();
    return "no equilibrium found further on (" + number_text(newton_.iterations) + " iterations, force " +
           number_text(newton_.force) + " left);" + at();
  }

  const Linkage& structure_;
  const double unit_;  ///< of energies, N mm
  const EquilibriumPathOptions& options_;
  const std::function<void(const EquilibriumStep&, const State&)>& frame_;
  const double goal_;
  const bool planar_;
  ElasticSystem system_;
  const bool soft_;  ///< turns_softly
  TangentStiffness tangent_;
  Branch branch_;
  Predictor predictor_;
  NewtonResult newton_;
  EquilibriumPath path_;
  Stop stop_ = Stop::not_converged;
  std::vector<Contact> blocking_;  ///< of the last state that was not taken
  bool has_tangent_ = false, is_exact_ = false, tunnelled_ = false, mirrored_ = false;
  Branch::Way way_ = Branch::Way::lowest_mode;  ///< in which the last saddle was left
  double off_closed_form_since_ = NAN;  ///< theta; NaN where the path did not leave it for being unstable
  double growth_ = 1, free_slope_ = 0;
  bool locked_ = false;
};

}  // namespace

void EquilibriumPathOptions::validate() const {
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

std::string to_string(EquilibriumPath::Stop stop) {
  switch (stop) {
    case Stop::reached:
      return "reached";
    case Stop::overstretched:
      return "torn";
    case Stop::locked:
      return "locked";
    case Stop::not_converged:
      break;
  }
  return "not converged";
}

EquilibriumPath trace_equilibrium(const DrivenLinkage& driven, const Elasticity& elasticity,
                                  const EquilibriumPathOptions& options,
                                  const std::function<void(const EquilibriumStep&, const State&)>& frame) {
  options.validate();
  elasticity.validate();
  return Follower(driven, elasticity, options, frame).run();
}

}  // namespace kinetix::model
