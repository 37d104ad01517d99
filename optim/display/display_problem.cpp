#include "optim/display/display_problem.hpp"

#include <numeric>

#include "model/elastic/adjoint.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/sheet_symmetry.hpp"

namespace kinetix::optim {
namespace {

using Eigen::VectorXd;

constexpr int unseen = -2;  // marks a hinge that no motion has reached yet; -1 is `centred`

model::PlaneMotion motion_of(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::mirror_x:
      return model::PlaneMotion::mirror_x;
    case Symmetry::mirror_y:
      return model::PlaneMotion::mirror_y;
    case Symmetry::rotate_2:
      return model::PlaneMotion::half_turn;
    case Symmetry::rotate_4:
      return model::PlaneMotion::quarter_turn;
    case Symmetry::none:
      break;
  }
  return model::PlaneMotion::none;
}

}  // namespace

HingeTies hinge_ties(const model::Structure& panel, Symmetry symmetry) {
  const model::PlaneMotion motion = motion_of(symmetry);
  HingeTies ties;
  ties.variable.assign(panel.hinges.size(), unseen);
  ties.reversed.assign(panel.hinges.size(), false);
  for (std::size_t first = 0; first < panel.hinges.size(); ++first) {
    if (ties.variable[first] != unseen) continue;
    std::vector<std::size_t> orbit;
    std::size_t h = first;
    bool reversed = false;
    do {
      orbit.push_back(h);
      ties.reversed[h] = reversed;
      const auto [next, turned] = image(panel, panel.hinges[h], motion);
      h = static_cast<std::size_t>(next);
      reversed ^= turned;
    } while (h != first);
    const int variable = reversed ? HingeTies::centred : ties.variables++;
    for (const std::size_t member : orbit) ties.variable[member] = variable;
  }
  return ties;
}

HingeTies untied(int hinges) {
  HingeTies ties;
  ties.variable.resize(static_cast<std::size_t>(hinges));
  std::iota(ties.variable.begin(), ties.variable.end(), 0);
  ties.reversed.assign(ties.variable.size(), false);
  ties.variables = hinges;
  return ties;
}

VectorXd HingeTies::expand(const VectorXd& x) const {
  VectorXd t(static_cast<Eigen::Index>(variable.size()));
  for (std::size_t h = 0; h < variable.size(); ++h) {
    const double from = variable[h] == centred ? 0.5 : x[variable[h]];
    t[h] = reversed[h] ? 1 - from : from;
  }
  return t;
}

VectorXd HingeTies::gather(const VectorXd& by_t) const {
  VectorXd sum = VectorXd::Zero(variables);
  for (std::size_t h = 0; h < variable.size(); ++h)
    if (variable[h] != centred) sum[variable[h]] += reversed[h] ? -by_t[h] : by_t[h];
  return sum;
}

VectorXd HingeTies::to_one_side(VectorXd t) const {
  VectorXd first = VectorXd::Zero(variables);  // off the middle
  for (std::size_t h = 0; h < variable.size(); ++h) {
    if (variable[h] == centred) continue;
    const double off = reversed[h] ? 0.5 - t[h] : t[h] - 0.5;
    double& of_first = first[variable[h]];
    if (of_first == 0) of_first = off;
    if (of_first * off < 0) t[h] = 1 - t[h];
  }
  return t;
}

VectorXd HingeTies::nearest(const VectorXd& t) const {
  VectorXd sum = VectorXd::Zero(variables), count = VectorXd::Zero(variables);
  for (std::size_t h = 0; h < variable.size(); ++h) {
    if (variable[h] == centred) continue;
    sum[variable[h]] += reversed[h] ? 1 - t[h] : t[h];
    count[variable[h]] += 1;
  }
  return sum.cwiseQuotient(count);
}

namespace {

// Rad of a hinge. A state further away is often on another branch. Of a hundred searches that left 0.3
// behind, nine in ten up to here reached the equilibrium of the path from flat, and half of those beyond.
constexpr double nearby = 0.8;
constexpr int most_iterations = 40;  // of Newton's method: beyond, the path from flat is faster

}  // namespace

PanelEquilibrium::PanelEquilibrium(model::Lattice panel, const model::Elasticity& elasticity,
                                   const model::Plates& plates)
    : panel_(std::move(panel)), elasticity_(elasticity), drive_(plates) {
  const model::ElasticSystem refuses_overlap(panel_, elasticity_, plates_on_panel(), true, true);
}

model::LinkageDrive PanelEquilibrium::plates_on_panel() const { return drive_on(panel_, drive_); }

bool PanelEquilibrium::settle(const Eigen::VectorXd& t, const Eigen::VectorXd& offset) {
  for (int h = 0; h < panel_.hinges(); ++h) {
    panel_.hinge(h).t = t[h];
    if (offset.size() > 0) panel_.hinge(h).offset = offset[h];
  }
  return settle_nearby() || settle_from_flat();
}

bool PanelEquilibrium::settle_nearby() {
  if (kept_.empty()) return false;
  model::ElasticSystem system(panel_, elasticity_, plates_on_panel(), true, true);
  model::TangentStiffness tangent(system.dofs());
  model::NewtonOptions options;
  options.max_iterations = most_iterations;
  model::State state = kept_;
  const double theta = system.drive().theta();
  system.place(theta, state);
  const model::NewtonResult result = minimise(system, theta, options, state, tangent);
  if (!result.converged || !result.stable || !(turn_distance(panel_, kept_, state) <= nearby)) return false;
  state_ = std::move(state);
  return true;
}

bool PanelEquilibrium::settle_from_flat() {
  ++paths_;
  model::EquilibriumPathOptions options;
  options.planar = true;
  model::EquilibriumPath path =
      trace_equilibrium({panel_, plates_on_panel(), exact_motion(panel_)}, elasticity_, options);
  if (path.stop != model::EquilibriumPath::Stop::reached || !path.steps.back().stable) return false;
  state_ = std::move(path.state);
  return true;
}

std::optional<PanelEquilibrium::Gradient> PanelEquilibrium::gradient(const Eigen::VectorXd& by_state) {
  const model::ElasticSystem system(panel_, elasticity_, plates_on_panel(), true, true);
  model::TangentStiffness tangent(system.dofs());
  const double theta = system.drive().theta();
  system.linearise(state_, theta, tangent);
  if (!tangent.factorise(0)) return std::nullopt;
  model::EquilibriumGradient gradient;
  gradient.state = by_state;
  const model::Sensitivity by = sensitivity(system, elasticity_, state_, theta, tangent, gradient);
  return Gradient{by.hinges.row(0).transpose(), by.hinges.row(3).transpose(),
                  by.theta / system.drive().coordinate_rate(theta)};
}

VectorXd DisplayVariables::joined(const VectorXd& of_ties, double of_compression,
                                  const VectorXd& of_offsets) const {
  const Eigen::Index middle = compression ? 1 : 0, last = offset > 0 ? of_offsets.size() : 0;
  VectorXd x(ties.variables + middle + last);
  x.head(ties.variables) = of_ties;
  if (compression) x[ties.variables] = of_compression;
  x.tail(last) = of_offsets.head(last);
  return x;
}

VectorXd DisplayVariables::bounds_of_ties(int side) const {
  const double turned = 1 - t[1 - side];
  VectorXd out = VectorXd::Constant(ties.variables, t[side]);
  for (std::size_t h = 0; h < ties.variable.size(); ++h) {
    if (ties.variable[h] == HingeTies::centred || !ties.reversed[h]) continue;
    double& of_tie = out[ties.variable[h]];
    of_tie = side == 0 ? std::max(of_tie, turned) : std::min(of_tie, turned);
  }
  return out;
}

VectorXd DisplayVariables::bounds(int side) const {
  const double most = side == 0 ? -offset : offset;
  const VectorXd widest = joined(bounds_of_ties(side), compression ? (*compression)[side] : 0,
                                 VectorXd::Constant(static_cast<Eigen::Index>(ties.variable.size()), most));
  if (middle.size() == 0) return widest;
  return side == 0 ? VectorXd(widest.array().max(middle.array() - reach))
                   : VectorXd(widest.array().min(middle.array() + reach));
}

VectorXd DisplayVariables::nearest(const VectorXd& of_hinges, double pressed, const VectorXd& off) const {
  const VectorXd zero = VectorXd::Zero(static_cast<Eigen::Index>(ties.variable.size()));
  const VectorXd x = joined(ties.nearest(of_hinges), pressed, off.size() > 0 ? off : zero);
  return x.cwiseMax(lower()).cwiseMin(upper());
}

VectorXd DisplayVariables::offset_of(const VectorXd& x) const {
  if (!(offset > 0)) return {};
  return x.tail(static_cast<Eigen::Index>(ties.variable.size()));
}

std::optional<double> DisplayVariables::compression_of(const VectorXd& x) const {
  if (!compression) return std::nullopt;
  return x[ties.variables];
}

bool DisplayVariables::settle(PanelEquilibrium& equilibrium, const VectorXd& x) const {
  if (compression) equilibrium.press(*compression_of(x));
  return equilibrium.settle(t_of(x), offset_of(x));
}

VectorXd DisplayVariables::gather(const PanelEquilibrium::Gradient& gradient) const {
  return joined(ties.gather(gradient.t), gradient.compression, gradient.offset);
}

namespace {

using Eigen::Vector3d;

/// Times the limit of stretch. The penalty begins a little below the limit, so that the excess left at the
/// end is within it.
constexpr double begins = 0.92;

}  // namespace

DisplayProblem::DisplayProblem(PanelEquilibrium& equilibrium, const DisplayVariables& variables,
                               Channel channel, Cost cost, double stretch, double weight, Settling settling)
    : equilibrium_(equilibrium),
      variables_(variables),
      channel_(channel),
      cost_(std::move(cost)),
      stretch_(stretch),
      weight_(weight),
      settling_(settling),
      lower_(variables.lower()),
      upper_(variables.upper()) {}

bool DisplayProblem::evaluate(const VectorXd& x, double& f, VectorXd* gradient) {
  if (settling_ == Settling::from_flat) equilibrium_.forget();
  if (!variables_.settle(equilibrium_, x) || !weigh(f, gradient)) return false;
  if (f < least_) {
    least_ = f;
    stretch_of_best_ = hinge_gaps(equilibrium_.panel(), equilibrium_.state()).max;
    equilibrium_.keep();
  }
  return true;
}

bool DisplayProblem::weigh(double& f, VectorXd* gradient) {
  model::PanelGradient panel(equilibrium_.panel());
  f = add_picture(panel) + add_stretch(panel);
  if (!gradient) return std::isfinite(f);
  auto by = equilibrium_.gradient(panel.state);
  if (!by) return false;
  by->t += panel.t;
  by->offset += panel.offset;
  *gradient = variables_.gather(*by);
  return std::isfinite(f) && gradient->allFinite();
}

double DisplayProblem::add_picture(model::PanelGradient& gradient) const {
  const model::Linkage panel = equilibrium_.panel();
  const SmoothChannel readings(channel_, panel, equilibrium_.state());
  const WeightedReadings weighed = cost_(readings.values());
  readings.add_gradient(weighed.slope, gradient);
  return weighed.cost;
}

double DisplayProblem::add_stretch(model::PanelGradient& gradient) const {
  const model::Linkage panel = equilibrium_.panel();
  double cost = 0;
  for (std::size_t h = 0; h < panel.hinges.size(); ++h) {
    const model::RestHinge& hinge = panel.hinges[h];
    const model::Pose &lower = equilibrium_.state()[hinge.lower], &upper = equilibrium_.state()[hinge.upper];
    const auto [gap, lower_arm, upper_arm] = point_mismatch(hinge, lower, upper, panel.size.edge_mm);
    const double excess = gap.norm() / stretch_ - begins;
    if (!(excess > 0)) continue;
    cost += weight_ * excess * excess;
    const Vector3d pull = 2 * weight_ * excess / stretch_ * gap.normalized();
    gradient.state.segment<3>(6 * hinge.lower) += lower_arm.cross(pull);
    gradient.state.segment<3>(6 * hinge.lower + 3) += pull;
    gradient.state.segment<3>(6 * hinge.upper) -= upper_arm.cross(pull);
    gradient.state.segment<3>(6 * hinge.upper + 3) -= pull;
    gradient.t[h] += pull.dot(lower.R * hinge.edge - upper.R * hinge.edge);
    gradient.offset[h] += pull.dot(lower.R * hinge.across - upper.R * hinge.across);
  }
  return cost;
}

}  // namespace kinetix::optim
