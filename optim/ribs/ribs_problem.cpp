#include "optim/ribs/ribs_problem.hpp"

#include <fmt/format.h>
#include <limits>

#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// Cell edges: an rms distance of this size gives |r| = 1. With a larger unit, tilts would have more weight.
constexpr double unit_in_edges = 0.1;
// Relative to distances: heights of the rim must not pull the spine off the surface.
constexpr double weight_of_ends = 0.1;
constexpr double weight_of_tilts = 1e-3;  // per rad: it only decides tilts that affect no distance
constexpr int theta_index = 6;            // in x: after turn (3) and place (3)

}  // namespace

RibsProblem::RibsProblem(const model::Fishbone& fishbone, const RibsGoal& goal, double tilt,
                         const AngleRange& theta)
    : fishbone_(fishbone), goal_(goal), tree_(make_net_tree(fishbone.structure, fishbone.middle)) {
  index_variables();
  place_probes();
  find_hinge_paths();
  const double infinity = std::numeric_limits<double>::infinity();
  int variables = shared();
  for (const int size : parts_) variables += size;
  lower_ = VectorXd::Constant(variables, -tilt);
  upper_ = VectorXd::Constant(variables, tilt);
  lower_.head<theta_index>().setConstant(-infinity);
  upper_.head<theta_index>().setConstant(infinity);
  lower_[theta_index] = theta.lower;
  upper_[theta_index] = theta.upper;
}

void RibsProblem::index_variables() {
  variable_of_hinge_.assign(fishbone_.structure.hinges.size(), -1);
  int at = fixed_shared;
  const auto add = [&](const model::Crease& crease) {
    for (const int h : crease.hinges) variable_of_hinge_[h] = at;
    ++at;
  };
  for (const model::Crease& crease : fishbone_.spine) add(crease);
  for (const auto& sides : fishbone_.ribs)
    for (const auto& side : sides) {
      first_.push_back(at);
      parts_.push_back(static_cast<int>(side.size()));
      for (const model::Crease& crease : side) add(crease);
    }
}

int RibsProblem::part_of(int body) const {
  const model::FishbonePlace place = place_of(fishbone_, body);
  return place.rib < 0 ? static_cast<int>(parts_.size()) : 2 * place.rib + place.side;
}

void RibsProblem::place_probes() {
  const model::Structure& s = fishbone_.structure;
  probes_.resize(parts_.size() + 1);
  const auto add = [&](const Probe& probe) { probes_[part_of(probe.body)].push_back(probe); };
  for (std::size_t b = 0; b < s.bodies.size(); ++b) add({static_cast<int>(b), Vector3d::Zero()});
  for (const model::Hinge& hinge : s.hinges)
    add({hinge.lower, hinge.parameters.t * s.size.edge_mm * edge_direction(hinge.wall.axis)});
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    const bool is_part = k < parts_.size();
    const int tilts = is_part ? parts_[k] : static_cast<int>(fishbone_.spine.size());
    residuals_.push_back(static_cast<int>(probes_[k].size()) + tilts + (is_part ? 0 : 4));
    count_ += static_cast<int>(probes_[k].size());
  }
  ends_ = spine_ends(fishbone_);
}

void RibsProblem::find_hinge_paths() {
  hinge_paths_.resize(fishbone_.structure.bodies.size());
  for (std::size_t k = 0; k < tree_.links.size(); ++k) {
    const model::NetTree::Link& link = tree_.links[k];
    hinge_paths_[link.body] = hinge_paths_[link.parent];
    const int variable = variable_of_hinge_[link.hinge];
    if (variable >= 0)
      hinge_paths_[link.body].push_back(
          {static_cast<int>(k), variable, alternation(fishbone_.structure.hinges[link.hinge].wall)});
  }
}

model::Structure RibsProblem::structure(const VectorXd& x) const {
  model::Structure out = fishbone_.structure;
  for (std::size_t h = 0; h < out.hinges.size(); ++h)
    if (variable_of_hinge_[h] >= 0)
      out.hinges[h].parameters.beta = alternation(out.hinges[h].wall) * x[variable_of_hinge_[h]];
  return out;
}

model::State placed(model::State state, int root, const Vector3d& turn, const Vector3d& place) {
  const Eigen::Matrix3d R = rotation_of(turn);
  const Vector3d from = state[root].p;
  for (model::Pose& pose : state) pose = {R * pose.R, place + R * (pose.p - from)};
  return state;
}

model::State RibsProblem::state(const VectorXd& x) const {
  return placed(fold_net(tree_, structure(x), x[theta_index]), tree_.root, x.head<3>(),
                fishbone_.structure.size.edge_mm * x.segment<3>(3));
}

VectorXd RibsProblem::pack(const RibsShape& shape) const {
  VectorXd x(lower_.size());
  x << shape.turn, shape.place / fishbone_.structure.size.edge_mm, VectorXd::Zero(x.size() - 6);
  x[theta_index] = shape.theta;
  int at = fixed_shared;
  for (const double tilt : shape.spine) x[at++] = tilt;
  for (const auto& sides : shape.ribs)
    for (const auto& side : sides)
      for (const double tilt : side) x[at++] = tilt;
  return x.cwiseMax(lower_).cwiseMin(upper_);
}

RibsShape RibsProblem::unpack(const VectorXd& x) const {
  RibsShape shape{x.head<3>(), fishbone_.structure.size.edge_mm * x.segment<3>(3), x[theta_index], {}, {}};
  int at = fixed_shared;
  for (std::size_t k = 0; k < fishbone_.spine.size(); ++k) shape.spine.push_back(x[at++]);
  for (const auto& sides : fishbone_.ribs) {
    auto& rib = shape.ribs.emplace_back();
    for (int side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < sides[side].size(); ++k) rib[side].push_back(x[at++]);
  }
  return shape;
}

bool RibsProblem::evaluate(const VectorXd& x, bool with_derivatives,
                           std::vector<ResidualBlock>& blocks) const {
  model::NetMotion motion;
  const model::Structure folded = structure(x);
  if (with_derivatives)
    motion = fold_net_with_jacobian(tree_, folded, x[theta_index]);
  else
    motion.state = fold_net(tree_, folded, x[theta_index]);
  if (!is_finite(motion.state)) return false;
  blocks.resize(probes_.size());
  for (std::size_t k = 0; k < probes_.size(); ++k)
    fill(motion, x, with_derivatives, static_cast<int>(k), blocks[k]);
  return true;
}

void RibsProblem::fill(const model::NetMotion& motion, const VectorXd& x, bool with_derivatives, int part,
                       ResidualBlock& block) const {
  const bool is_part = part < static_cast<int>(parts_.size());
  const int own = is_part ? parts_[part] : 0, rows = residuals_[part];
  block.r.setZero(rows);
  block.by_shared.setZero(with_derivatives ? rows : 0, shared());
  block.by_local.setZero(with_derivatives ? rows : 0, own);
  int row = 0;
  for (const Probe& probe : probes_[part]) fill_probe(motion, x, with_derivatives, part, probe, row++, block);
  const int first = is_part ? first_[part] : fixed_shared;
  const int tilts = is_part ? own : static_cast<int>(fishbone_.spine.size());
  for (int k = 0; k < tilts; ++k, ++row) {
    block.r[row] = weight_of_tilts * x[first + k];
    if (with_derivatives)
      (is_part ? block.by_local(row, k) : block.by_shared(row, fixed_shared + k)) = weight_of_tilts;
  }
  if (!is_part) fill_ends(motion, x, with_derivatives, row, block);
}

Vector3d RibsProblem::in_place(const model::NetMotion& motion, const VectorXd& x, const Probe& probe) const {
  const model::Pose& pose = motion.state[probe.body];
  return fishbone_.structure.size.edge_mm * x.segment<3>(3) +
         rotation_of(x.head<3>()) * (pose.p + pose.R * probe.arm - motion.state[tree_.root].p);
}

/// Returns the derivative of direction . (place of the probe): shared variables, then those of its part.
VectorXd RibsProblem::derivatives_of(const model::NetMotion& motion, const VectorXd& x, const Probe& probe,
                                     const Vector3d& direction, int part) const {
  const bool is_part = part < static_cast<int>(parts_.size());
  VectorXd derivatives = VectorXd::Zero(shared() + (is_part ? parts_[part] : 0));
  const model::Pose& pose = motion.state[probe.body];
  const Vector3d carried = pose.R * probe.arm, p = pose.p + carried;
  const Eigen::Matrix3d turn = rotation_of(x.head<3>());
  const Vector3d arm = turn * (p - motion.state[tree_.root].p), local = turn.transpose() * direction;
  derivatives.head<3>() = rotation_rate(x.head<3>()).transpose() * arm.cross(direction);
  derivatives.segment<3>(3) = fishbone_.structure.size.edge_mm * direction;
  const model::Twist& twist = motion.by_theta[probe.body];
  derivatives[theta_index] = local.dot(twist.v + twist.omega.cross(carried) - motion.by_theta[tree_.root].v);
  for (const Step& step : hinge_paths_[probe.body]) {
    const model::NetTurn& about = motion.by_tilt[step.link];
    const int at = step.variable < shared() ? step.variable : shared() + step.variable - first_[part];
    derivatives[at] += step.sign * local.dot(about.omega.cross(p - about.point));
  }
  return derivatives;
}

void RibsProblem::fill_probe(const model::NetMotion& motion, const VectorXd& x, bool with_derivatives,
                             int part, const Probe& probe, int row, ResidualBlock& block) const {
  const double scale = 1 / (unit_in_edges * fishbone_.structure.size.edge_mm * std::sqrt(count_));
  const targets::ClosestMeshPoint closest = goal_.surface->closest(in_place(motion, x, probe));
  block.r[row] = scale * (closest.distance - goal_.clearance_mm);
  if (!with_derivatives) return;
  const VectorXd by = scale * derivatives_of(motion, x, probe, closest.normal, part);
  block.by_shared.row(row) = by.head(shared());
  if (const auto own = by.size() - shared(); own > 0) block.by_local.row(row) = by.tail(own);
}

void RibsProblem::fill_ends(const model::NetMotion& motion, const VectorXd& x, bool with_derivatives, int row,
                            ResidualBlock& block) const {
  const double scale = weight_of_ends / (unit_in_edges * fishbone_.structure.size.edge_mm);
  const int part = static_cast<int>(parts_.size());
  for (const auto& end : ends_)
    for (const auto& [direction, wanted] : {std::pair{Vector3d(Vector3d::UnitZ()), goal_.rim_z},
                                            {Vector3d(Vector3d::UnitX()), goal_.middle_x}}) {
      block.r[row] = -scale * wanted;
      for (const int body : end) {
        const Probe probe{body, Vector3d::Zero()};
        block.r[row] += scale / 2 * direction.dot(in_place(motion, x, probe));
        if (with_derivatives)
          block.by_shared.row(row) += scale / 2 * derivatives_of(motion, x, probe, direction, part);
      }
      ++row;
    }
}

namespace {

// Cell edges between adjacent ribs: more leaves more of the surface bare.
constexpr double gap_in_edges = 0.15;

/// Returns the number of even spaces of a length that are nearest to the requested spacing.
int spaces_of(double length, double asked) {
  const double exact = length / asked;
  const int fewer = static_cast<int>(exact);
  if (fewer == 0) return static_cast<int>(std::lround(exact));
  return exact / fewer - 1 <= 1 - exact / (fewer + 1) ? fewer : fewer + 1;
}

/// Returns the number of ribs. @param length from the middle of the first rib to that of the last, mm
int ribs_of(const RibsSpec& spec, double length, int rows) {
  if (!spec.spacing_mm) return spec.ribs;
  const int spaces = spaces_of(length, *spec.spacing_mm);
  const bool has_room = 2 * spaces + 1 <= rows;
  return has_room || !(spaces > length / *spec.spacing_mm) ? spaces + 1 : spaces;
}

std::vector<int> rib_rows(const RibsSpec& spec, double length, double pitch, int rows) {
  const int count = ribs_of(spec, length - pitch, rows);
  if (2 * count - 1 > rows)
    throw InvalidInput(
        fmt::format("{} ribs overlap in the flat sheet: the spine has {} rows of cells, room for {} ribs. "
                    "Use fewer ribs or smaller cells",
                    count, rows, (rows + 1) / 2));
  std::vector<int> out;
  for (int k = 0; k < count; ++k)
    out.push_back(count == 1 ? rows / 2 : static_cast<int>(std::lround(k * (rows - 1.0) / (count - 1))));
  return out;
}

/// Returns the tilt of a crease whose far side turns `below` its near side.
double tilt_for(const model::Structure& structure, const model::Crease& crease, double below,
                const RibsSpec& spec, double theta) {
  const double tilt = turn_sense(structure.hinges[crease.hinges[0]].wall) * model::tilt_of_turn(below, theta);
  return std::clamp(tilt, -spec.tilt, spec.tilt);
}

/// Returns the angle of a direction above the plane, in the plane spanned by `level` and `up`.
double slope(const Vector3d& direction, const Vector3d& level, const Vector3d& up) {
  return std::atan2(direction.dot(up), direction.dot(level));
}

double slope_along_spine(const targets::SpaceCurve& spine, double arc, double span_mm) {
  return slope(spine.direction(arc, span_mm), Vector3d::UnitY(), Vector3d::UnitZ());
}

/// Returns the fall from the first to the second slope, in [-pi, pi].
double fall(double from, double to) { return std::remainder(from - to, 2 * pi); }

/// Returns the tilts of the spine. Each crease turns from the tangent in the middle of the flat piece before
/// it to that of the piece behind it.
std::vector<double> spine_tilts(const model::Fishbone& fishbone, const targets::SpaceCurve& spine,
                                double span_mm, double pitch, double theta, const RibsSpec& spec) {
  std::vector<int> rows;
  for (const model::Crease& crease : fishbone.spine) rows.push_back(line_of(fishbone.structure, crease));
  const auto middle = [&](std::size_t k) {
    const double from = k == 0 ? 0 : rows[k - 1] + 1, to = k == rows.size() ? fishbone.layout.rows : rows[k];
    return slope_along_spine(spine, std::min(pitch * (from + to) / 2, spine.length()), span_mm);
  };
  std::vector<double> tilts;
  for (std::size_t k = 0; k < rows.size(); ++k)
    tilts.push_back(
        tilt_for(fishbone.structure, fishbone.spine[k], fall(middle(k), middle(k + 1)), spec, theta));
  return tilts;
}

std::vector<double> rib_tilts(const model::Fishbone& fishbone, const std::vector<model::Crease>& creases,
                              const targets::SpaceCurve& line, double span_mm, const Vector3d& sideways,
                              const Vector3d& outward, double pitch, double theta, const RibsSpec& spec) {
  const auto angle = [&](double arc) { return slope(line.direction(arc, span_mm), sideways, outward); };
  std::vector<double> tilts;
  double last = 0;
  for (std::size_t k = 0; k < creases.size(); ++k) {
    const double next = angle(std::min((static_cast<double>(k) + 1.5) * pitch, line.length()));
    tilts.push_back(tilt_for(fishbone.structure, creases[k], fall(last, next), spec, theta));
    last = next;
  }
  return tilts;
}

class Planner {
 public:
  Planner(const targets::SpaceCurve& spine, double span_mm, const RibsSpec& spec)
      : spec_(spec), spine_(spine), span_mm_(span_mm), edge_(spec.size.edge_mm) {
    rows_ = static_cast<int>(std::lround(spine_.length() / (edge_ * std::cos(spec.start_theta))));
    if (rows_ < 2)
      throw InvalidInput(fmt::format(
          "cells of {:g} mm are too large: the line of the spine is {:.0f} mm long", edge_, spine_.length()));
    theta_ = std::clamp(std::acos(std::min(1.0, spine_.length() / (rows_ * edge_))), spec.theta.lower,
                        spec.theta.upper);
    pitch_ = edge_ * std::cos(theta_);
  }

  RibsLayout run(const TraceRib& trace) {
    RibsLayout out{{rows_, {}}, {}, spine_, {}, 0, {}};
    RibPlanes planes{
        {}, pitch_ + edge_ * (std::sin(theta_) + gap_in_edges) + spec_.size.thickness_mm, pitch_};
    for (const int row : rib_rows(spec_, spine_.length(), pitch_, rows_)) {
      const double arc = std::min((row + 0.5) * pitch_, spine_.length());
      out.spine_and_ribs.ribs.push_back({row, {0, 0}});
      planes.planes.push_back({spine_.at(arc), spine_.direction(arc, span_mm_)});
    }
    for (std::size_t r = 0; r < planes.planes.size(); ++r) {
      out.sections.push_back({trace(planes, r, -1), trace(planes, r, 1)});
      for (const int side : {0, 1})
        out.spine_and_ribs.ribs[r].cells[side] = cells_along(out.sections[r][side]);
    }
    const model::Fishbone fishbone = make_fishbone(out.spine_and_ribs, spec_.size);
    out.start.theta = theta_;
    out.start.spine = spine_tilts(fishbone, spine_, span_mm_, pitch_, theta_, spec_);
    for (std::size_t r = 0; r < planes.planes.size(); ++r)
      out.start.ribs.push_back(tilts_of_rib(fishbone, out, r, planes.planes[r].outward()));
    const double root_arc = (rows_ / 2) * pitch_;
    out.start.turn = {slope_along_spine(spine_, root_arc, span_mm_), 0, 0};
    out.start.place = spine_.at(root_arc) - pitch_ / 2 * Vector3d::UnitX();
    return out;
  }

 private:
  int cells_along(const targets::SpaceCurve& line) const {
    return std::max(0, static_cast<int>(std::floor((line.length() - pitch_ / 2) / pitch_)));
  }

  std::array<std::vector<double>, 2> tilts_of_rib(const model::Fishbone& fishbone, const RibsLayout& out,
                                                  std::size_t r, const Vector3d& outward) const {
    std::array<std::vector<double>, 2> tilts;
    for (const int side : {0, 1})
      tilts[side] = rib_tilts(fishbone, fishbone.ribs[r][side], out.sections[r][side], span_mm_,
                              (side == 0 ? -1 : 1) * Vector3d::UnitX(), outward, pitch_, theta_, spec_);
    return tilts;
  }

  const RibsSpec& spec_;
  const targets::SpaceCurve& spine_;
  double span_mm_, edge_;
  int rows_ = 0;
  double theta_ = 0, pitch_ = 0;
};

}  // namespace

bool RibPlanes::meets_neighbour(std::size_t rib, const Vector3d& p) const {
  const std::size_t next = rib % 2 == 1 ? 1 : 2;
  const bool below = rib >= next && planes[rib - next].beyond(p) < width;
  const bool above = rib + next < planes.size() && -planes[rib + next].beyond(p) < width;
  return below || above;
}

RibsLayout layout_along(const targets::SpaceCurve& spine, double span_mm, const RibsSpec& spec,
                        const TraceRib& trace) {
  return Planner(spine, span_mm, spec).run(trace);
}

}  // namespace kinetix::optim
