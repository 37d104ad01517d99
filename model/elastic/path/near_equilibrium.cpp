#include "model/elastic/path/near_equilibrium.hpp"

#include "model/elastic/path/closed_form.hpp"
#include "model/elastic/path/measured_system.hpp"

namespace kinetix::model {
namespace {

// Fractions of the whole change: first step, halved if no equilibrium is near, and least step.
constexpr double first_part = 0.25, min_part = 1.0 / 256;

/// Finds the minimum near a state, at the drive's goal.
EquilibriumPath settled(const DrivenLinkage& driven, const Elasticity& elasticity,
                        const EquilibriumPathOptions& options, const State& start) {
  MeasuredSystem system(driven.linkage, elasticity, driven.drive, options);
  EquilibriumPath path;
  path.theta = system.elastic.drive().theta();
  path.state = start;
  const NewtonResult newton =
      minimise(system.elastic, path.theta, options.newton, path.state, system.tangent);
  path.iterations = newton.iterations;
  path.steps.push_back(system.measured(path.state, path.theta, newton.stable));
  path.gaps = hinge_gaps(system.elastic.structure(), path.state);
  path.multiplier = system.elastic.multiplier();
  path.off_closed_form = ClosedForm(system.elastic, driven.exact).is_far(path.state, path.theta);
  const bool crosses = newton.converged && system.elastic.newly_cross(start, path.state);
  if (newton.converged && newton.stable && !crosses) return path;
  path.stop = EquilibriumPath::Stop::not_converged;
  if (crosses) {
    path.why = "next to the given state walls would have to pass through each other";
    return path;
  }
  path.why = newton.converged ? "the equilibrium next to the given state is unstable"
                              : "no equilibrium was found next to the given state";
  return path;
}

void check(const Elasticity& elasticity, const EquilibriumPathOptions& options) {
  options.validate();
  elasticity.validate();
}

EquilibriumPath without_equilibrium(const std::string& why) {
  EquilibriumPath path;
  path.stop = EquilibriumPath::Stop::not_converged;
  path.why = why;
  return path;
}

}  // namespace

EquilibriumPath equilibrium_at_closed_form(const DrivenLinkage& driven, const Elasticity& elasticity,
                                           const EquilibriumPathOptions& options) {
  check(elasticity, options);
  MeasuredSystem system(driven.linkage, elasticity, driven.drive, options);
  const auto exact = ClosedForm(system.elastic, driven.exact).at(driven.drive.theta());
  return exact ? settled(driven, elasticity, options, *exact)
               : without_equilibrium("no analytic motion fits the structure");
}

EquilibriumPath follow_change(const State& state, const std::function<DrivenLinkage(double)>& change,
                              const Elasticity& elasticity, const EquilibriumPathOptions& options) {
  check(elasticity, options);
  EquilibriumPathOptions same = options;
  same.planar = options.planar.value_or(all_vertical(change(0).linkage) && all_vertical(change(1).linkage));
  State last = state;
  int iterations = 0;
  for (double done = 0, part = first_part;;) {
    const double next = std::min(done + part, 1.0);
    const DrivenLinkage changed = change(next);
    EquilibriumPath path = settled(changed, elasticity, same, last);
    path.iterations = iterations += path.iterations;
    if (path.stop != EquilibriumPath::Stop::reached) {
      if ((part /= 2) < min_part) return path;
      continue;
    }
    if (next >= 1) return path;
    last = std::move(path.state);
    done = next;
  }
}

namespace {

// Rounds of the active set. If hinges hardly open, rows of 13 bodies need two to four, with all changes at
// once.
constexpr int max_rounds = 100, rounds_with_all = 5;
// Fraction of the largest force of a plate on a body. A smaller pull is the residual of Newton's method.
constexpr double no_pull = 1e-6;
// Cell edges: tolerance for rounding, within which a body is on its plate.
constexpr double on_plate = 1e-12;

/// Forces and distances along the axis of bodies that plates push.
struct Pushing {
  const ElasticSystem& system;
  const State& state;
  Eigen::VectorXd gradient;
  double distance = 0;  ///< from the middle between the plates to each plate, cell edges
  double middle = 0;    ///< cell edges

  int axis() const { return component(system.drive().axis); }
  static double inward(int side) { return side == 0 ? 1 : -1; }
  /// Returns the force that holds a body in place, positive away from the plate, k_point edge.
  double force(int side, int body) const { return inward(side) * gradient[6 * body + 3 + axis()]; }
  /// Returns how far a body is behind its plate, cell edges.
  double behind(int side, int body) const {
    const double plate = middle - inward(side) * distance;
    return inward(side) * (plate - state[body].p[axis()] / system.structure().size.edge_mm);
  }
};

Pushing pushing(const GrippedRows& rows, const ElasticSystem& system, const State& state, double theta) {
  Pushing out{system, state, system.elastic_gradient(state)};
  const auto place = [&](int side) {
    return system.structure().bodies[rows[side].front()].position[out.axis()];
  };
  out.middle = (place(0) + place(1)) / 2;
  out.distance = (place(1) - place(0)) / 2 * std::cos(theta);
  return out;
}

double largest_force(const Pushing& plates, const GrippedRows& held) {
  double largest = 0;
  for (const int side : {0, 1})
    for (const int body : held[side]) largest = std::max(largest, std::abs(plates.force(side, body)));
  return largest;
}

/// Body of a row that a plate pulls, or that is behind its plate.
struct Wrong {
  int side = 0, body = 0;
  bool behind = false;
  double by = 0;  ///< pull, k_point edge, or distance, cell edges
};

std::vector<Wrong> all_wrong(const GrippedRows& rows, const ElasticSystem& system, const State& state,
                             double theta) {
  const Pushing plates = pushing(rows, system, state, theta);
  const GrippedRows& held = system.gripped();
  const double pull = no_pull * largest_force(plates, held);
  std::vector<Wrong> out;
  for (const int side : {0, 1})
    for (const int body : rows[side]) {
      const bool is_held = std::find(held[side].begin(), held[side].end(), body) != held[side].end();
      const Wrong wrong{side, body, !is_held,
                        is_held ? -plates.force(side, body) : plates.behind(side, body)};
      if (wrong.by > (is_held ? pull : on_plate)) out.push_back(wrong);
    }
  return out;
}

/// Returns the worst violation. Bodies behind their plate come first, since their load changes which ones are
/// pulled.
Wrong worst_of(const std::vector<Wrong>& wrong) {
  return *std::max_element(wrong.begin(), wrong.end(), [](const Wrong& a, const Wrong& b) {
    return std::pair(a.behind, a.by) < std::pair(b.behind, b.by);
  });
}

void mend(const GrippedRows& rows, const Wrong& wrong, GrippedRows& held) {
  GrippedRows mended;
  for (const int side : {0, 1})
    for (const int body : rows[side]) {
      const bool is_it = side == wrong.side && body == wrong.body;
      const bool is_held = std::find(held[side].begin(), held[side].end(), body) != held[side].end();
      if (is_it ? wrong.behind : is_held) mended[side].push_back(body);
    }
  held = std::move(mended);
}

EquilibriumPath not_found(EquilibriumPath path, const std::string& why) {
  path.stop = EquilibriumPath::Stop::not_converged;
  path.why = "plates that press without gripping: " + why;
  return path;
}

int bodies_of(const GrippedRows& rows) { return static_cast<int>(rows[0].size() + rows[1].size()); }

/// Finds the equilibrium near a state after a change of the bodies that plates hold.
EquilibriumPath settled_again(const DrivenLinkage& now, const Elasticity& elasticity,
                              const EquilibriumPathOptions& options, State state, double theta) {
  ElasticSystem(now.linkage, elasticity, now.drive, *options.planar, options.contact, options.bodies)
      .place(theta, state);
  return follow_change(
      state, [&](double) { return now; }, elasticity, options);
}

/// Returns since when a path is off its closed form.
OffClosedForm off_closed_form(const EquilibriumPath& path) {
  const auto left_unstable = [&](const PathEvent& event) {
    const bool left = event.kind == PathEvent::Kind::bifurcation || event.kind == PathEvent::Kind::snap;
    return left && event.at.theta == path.off_closed_form_since;
  };
  return {path.off_closed_form_since, std::any_of(path.events.begin(), path.events.end(), left_unstable)};
}

/// Replaces the end of a path with that of another one.
void replace_end(EquilibriumPath& path, const DrivenLinkage& now, const Elasticity& elasticity,
                 const EquilibriumPathOptions& options, EquilibriumPath end) {
  const MeasuredSystem system(now.linkage, elasticity, now.drive, options);
  path.steps.back() = end.steps.back();
  path.gaps = end.gaps;
  path.iterations += end.iterations;
  path.hinge_energies = system.hinge_energies(end.state);
  path.off_closed_form = end.off_closed_form || std::isfinite(path.off_closed_form_since);
  path.state = std::move(end.state);
  path.why = stop_reason(path, system, options.gap_limit, {}, off_closed_form(path));
}

}  // namespace

EquilibriumPath trace_pressed(const DrivenLinkage& driven, const Elasticity& elasticity,
                              const EquilibriumPathOptions& options,
                              const std::function<void(const EquilibriumStep&, const State&)>& frame) {
  DrivenLinkage now = driven;
  now.drive.press = false;
  EquilibriumPath path = trace_equilibrium(now, elasticity, options, frame);
  if (path.stop != EquilibriumPath::Stop::reached) return path;
  EquilibriumPathOptions same = options;
  same.planar = path.planar;
  for (int k = 0; k < max_rounds; ++k) {
    const ElasticSystem system(now.linkage, elasticity, now.drive, path.planar, options.contact,
                               options.bodies);
    std::vector<Wrong> wrong = all_wrong(driven.drive.gripped, system, path.state, path.theta);
    path.let_go = bodies_of(driven.drive.gripped) - bodies_of(now.drive.gripped);
    if (wrong.empty()) return path;
    if (k >= rounds_with_all) wrong = {worst_of(wrong)};
    for (const Wrong& one : wrong) mend(driven.drive.gripped, one, now.drive.gripped);
    if (now.drive.gripped[0].size() < 2 || now.drive.gripped[1].size() < 2)
      return not_found(std::move(path),
                       "they push at most one body of a row, so that the structure would turn");
    EquilibriumPath next = settled_again(now, elasticity, same, path.state, path.theta);
    if (next.stop != EquilibriumPath::Stop::reached) return not_found(std::move(path), next.why);
    replace_end(path, now, elasticity, same, std::move(next));
  }
  return not_found(std::move(path), "no bodies were found that they push and never pull");
}

}  // namespace kinetix::model
