#include "app/print/sheet/fold_motion.hpp"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

namespace kinetix::app {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using model::Pose;
using model::State;

constexpr double widest_rad = 0.1;  // rad, of an interval that is checked as a whole, as in certified ranges
constexpr double rounding = 1e-9;   // cell edges: rounding in poses of thousands of bodies is below it
constexpr int finer = 8;            // states per state of the path, for a motion without hinge laws
constexpr double no_angle = 1e-7;   // rad: below it a screw is a translation
constexpr double caution = 2;       // times the error that three states show

Pose relative(const State& state, int from, int body) {
  const Matrix3d back = state[from].R.transpose();
  return {back * state[body].R, back * (state[body].p - state[from].p)};
}

/// Screw motion from one pose to another, in a time of 1: r' = v + omega x r.
struct Screw {
  Vector3d omega = Vector3d::Zero(), v = Vector3d::Zero();

  Screw(const Pose& from, const Pose& to) {
    const Eigen::AngleAxisd turn(Matrix3d(to.R * from.R.transpose()));
    omega = turn.angle() * turn.axis();
    const Vector3d shift = to.p - turn * from.p;
    v = left(1).inverse() * shift;
  }

  Pose after(double time, const Pose& from) const {
    const double angle = time * omega.norm();
    const Matrix3d turn =
        angle > 0 ? Eigen::AngleAxisd(angle, omega.normalized()).toRotationMatrix() : Matrix3d::Identity();
    return {turn * from.R, turn * from.p + time * left(time) * v};
  }

 private:
  /// Returns the integral of the turn over a time, divided by the time.
  Matrix3d left(double time) const {
    const double angle = time * omega.norm();
    if (!(angle > no_angle)) return Matrix3d::Identity();
    const Vector3d a = omega.normalized();
    Matrix3d cross;
    cross << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return Matrix3d::Identity() + (1 - std::cos(angle)) / angle * cross +
           (1 - std::sin(angle) / angle) * cross * cross;
  }
};

/// Bounds the distance between two poses of a body, for points within its reach.
double largest_distance(const Pose& a, const Pose& b, double reach) {
  return (a.p - b.p).norm() + reach * Eigen::AngleAxisd(Matrix3d(a.R.transpose() * b.R)).angle();
}

// ---- by the laws of the hinges

class LawfulInterval : public MotionInterval {
 public:
  LawfulInterval(const model::LinkageMotion& linkage, const model::ExactMotion& exact, double sign,
                 double low, double high, const model::LawDeviation& deviation)
      : linkage_(linkage), interval_(linkage, exact, sign, low, high), deviation_(deviation) {
    theta = interval_.theta();
    half_width = interval_.half_width();
    state = interval_.state();
  }

  SeenBody seen(int from, int body, const model::HingeChain& chain) const override {
    return {interval_.relative(from, body), interval_.motion(from, chain), margin_of(chain.size())};
  }
  std::vector<model::SweptMotion> motions() const override { return interval_.motions(); }
  double margin_mm() const override { return margin_of(linkage_.links.size()); }

 private:
  double margin_of(std::size_t hinges) const {
    return linkage_.edge() * rounding + linkage_.margin_mm(hinges, deviation_.gap, deviation_.off);
  }

  const model::LinkageMotion& linkage_;
  const model::ThetaInterval interval_;
  const model::LawDeviation& deviation_;
};

class LawfulMotion : public PrintMotion {
 public:
  explicit LawfulMotion(const PrintSheet& sheet)
      : linkage_(sheet.linkage, sheet.turns),
        exact_{sheet.motion, "", ""},
        sign_(sheet.thetas.back() < 0 ? -1 : 1),
        end_(std::abs(sheet.thetas.back())) {}

  /// Checks whether the hinges turn by their laws. Records the deviations.
  bool is_lawful() {
    if (linkage_.unconnected_body() >= 0) return false;
    for (double s = 0; s < end_; s = next(s)) {
      const double middle = (s + next(s)) / 2;
      const model::ThetaInterval there(linkage_, exact_, sign_, middle, middle);
      if (!is_finite(there.state())) return false;
      const model::LawDeviation found = there.deviation();
      if (found.hinge >= 0) return false;
      deviation_.gap = std::max(deviation_.gap, found.gap);
      deviation_.off = std::max(deviation_.off, found.off);
    }
    return true;
  }

  double end() const override { return end_; }
  double next(double from) const override { return std::min(from + widest_rad, end_); }
  double theta(double at) const override { return sign_ * at; }
  std::unique_ptr<MotionInterval> over(double low, double high) const override {
    return std::make_unique<LawfulInterval>(linkage_, exact_, sign_, low, high, deviation_);
  }

 private:
  model::LinkageMotion linkage_;
  model::ExactMotion exact_;
  double sign_, end_;
  model::LawDeviation deviation_;
};

// ---- from state to state

/// States of a path, with estimates of the motion between them.
struct Samples {
  std::vector<State> states;
  std::vector<double> thetas;  // rad
  std::vector<bool> is_jump;   // from this state to the next
  const std::vector<double>& reach;

  /// Returns the pose of a body in a state as the body `from` sees it. -1 is space.
  Pose at(std::size_t k, int from, int body) const {
    return from < 0 ? states[k][body] : relative(states[k], from, body);
  }

  /// Estimates the error of a screw over the step from `k`. It is the error at state `middle` of the screw between the
  /// states before and after, scaled by the square of the step.
  double error(std::size_t middle, std::size_t k, int from, int body) const {
    if (middle < 1 || middle + 1 >= states.size() || is_jump[middle - 1] || is_jump[middle]) return 0;
    const double whole = thetas[middle + 1] - thetas[middle - 1];
    const double part = (thetas[middle] - thetas[middle - 1]) / whole;
    if (!(part > 0 && part < 1)) return 0;
    const Pose before = at(middle - 1, from, body);
    const Pose meant = Screw(before, at(middle + 1, from, body)).after(part, before);
    const double step = (thetas[k + 1] - thetas[k]) / whole;
    return largest_distance(meant, at(middle, from, body), reach[body]) * step * step / 4 /
           (part * (1 - part));
  }

  double margin(std::size_t k, int from, int body) const {
    if (is_jump[k]) return 0;
    return caution * std::max(error(k, k, from, body), error(k + 1, k, from, body));
  }
};

class SampledInterval : public MotionInterval {
 public:
  SampledInterval(const Samples& samples, double low, double high)
      : samples_(samples),
        k_(static_cast<std::size_t>((low + high) / 2)),
        part_((low + high) / 2 - static_cast<double>(k_)) {
    half_width = (high - low) / 2;
    theta = samples.thetas[k_] + part_ * (samples.thetas[k_ + 1] - samples.thetas[k_]);
    for (int b = 0; b < static_cast<int>(samples.reach.size()); ++b) state.push_back(seen_from(-1, b).pose);
  }

  SeenBody seen(int from, int body, const model::HingeChain&) const override {
    SeenBody out = seen_from(from, body);
    out.margin_mm = samples_.margin(k_, from, body);
    return out;
  }
  std::vector<model::SweptMotion> motions() const override {
    std::vector<model::SweptMotion> all;
    for (int b = 0; b < static_cast<int>(state.size()); ++b) all.push_back(seen_from(-1, b).motion);
    return all;
  }
  double margin_mm() const override {
    double most = 0;
    for (int b = 0; b < static_cast<int>(state.size()); ++b)
      most = std::max(most, samples_.margin(k_, -1, b));
    return most;
  }

 private:
  SeenBody seen_from(int from, int body) const {
    const Pose before = samples_.at(k_, from, body);
    const Screw screw(before, samples_.at(k_ + 1, from, body));
    SeenBody out{screw.after(part_, before), model::SweptMotion(half_width)};
    out.motion.screw(screw.omega, screw.v);
    return out;
  }

  const Samples& samples_;
  const std::size_t k_;
  const double part_;
};

class SampledMotion : public PrintMotion {
 public:
  SampledMotion(const PrintSheet& sheet, const std::vector<double>& reach) : samples_{{}, {}, {}, reach} {
    const int steps = sheet.motion ? finer : 1;
    samples_.states.push_back(sheet.path.front());
    samples_.thetas.push_back(sheet.thetas.front());
    for (std::size_t k = 0; k + 1 < sheet.path.size(); ++k)
      for (int part = 1; part <= steps; ++part) {
        const double theta = sheet.thetas[k] + (sheet.thetas[k + 1] - sheet.thetas[k]) * part / steps;
        samples_.states.push_back(part < steps ? sheet.motion(theta) : sheet.path[k + 1]);
        samples_.thetas.push_back(theta);
        samples_.is_jump.push_back(std::find(sheet.jumps.begin(), sheet.jumps.end(), static_cast<int>(k)) !=
                                   sheet.jumps.end());
      }
  }

  double end() const override { return static_cast<double>(samples_.states.size()) - 1; }
  double next(double from) const override { return std::min(std::floor(from) + 1, end()); }
  double theta(double at) const override {
    const auto k = std::min(static_cast<std::size_t>(at), samples_.thetas.size() - 2);
    return samples_.thetas[k] + (at - static_cast<double>(k)) * (samples_.thetas[k + 1] - samples_.thetas[k]);
  }
  std::unique_ptr<MotionInterval> over(double low, double high) const override {
    return std::make_unique<SampledInterval>(samples_, low, high);
  }

 private:
  Samples samples_;
};

constexpr double touching_mm = 1e-9;  // mm: nearer witnesses have no direction

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const model::Pose& pose) {
  const Eigen::Matrix3d& R = pose.R;
  const btMatrix3x3 turn(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2));
  return btTransform(turn, to_bullet(pose.p));
}

std::shared_ptr<btConvexHullShape> hull_of(const Eigen::Matrix3Xd& points) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (const auto& p : points.colwise()) hull->addPoint(to_bullet(p), false);
  hull->setMargin(0);
  hull->recalcLocalAabb();
  return hull;
}

PieceEnd end_of(int body, Eigen::Matrix3Xd points) {
  PieceEnd end{body, std::move(points)};
  end.center = end.points.rowwise().mean();
  end.radius = (end.points.colwise() - end.center).colwise().norm().maxCoeff();
  return end;
}

Eigen::Matrix3Xd matrix_of(const std::vector<Vector3d>& points) {
  Eigen::Matrix3Xd out(3, points.size());
  for (std::size_t k = 0; k < points.size(); ++k) out.col(k) = points[k];
  return out;
}

/// Returns both ends of a soft part at a hinge, each relative to its own body.
std::vector<PieceEnd> soft_ends(const PrintSheet& sheet, int h) {
  const model::RestHinge& hinge = sheet.linkage.hinges[h];
  const Eigen::Matrix3Xd points = matrix_of(sheet.soft[h].points);
  const auto half = points.cols() / 2;
  const Vector3d between =
      sheet.linkage.rest_position(hinge.lower) - sheet.linkage.rest_position(hinge.upper);
  return {end_of(hinge.lower, points.leftCols(half)),
          end_of(hinge.upper, points.rightCols(points.cols() - half).colwise() + between)};
}

/// Piece in space, with a pose. Several ends form the hull of their places.
struct Placed {
  explicit Placed(const PlacedPiece& at) {
    if (at.piece.hull) {
      hull = at.piece.hull;
      pose = to_bullet(*at.poses.front());
      return;
    }
    std::vector<Vector3d> all;
    for (std::size_t k = 0; k < at.piece.ends.size(); ++k)
      for (const auto& p : at.piece.ends[k].points.colwise())
        all.emplace_back(at.poses[k]->R * p + at.poses[k]->p);
    hull = hull_of(matrix_of(all));
    pose.setIdentity();
  }
  std::shared_ptr<btConvexHullShape> hull;
  btTransform pose;
};

double axial_clearance_mm(double clearance_mm, const model::Process& process, bool inclined) {
  const double flat = std::max(clearance_mm, process.upright_clearance_mm);
  return inclined ? std::max(flat, model::cone_rise * clearance_mm + process.filament->layer_mm) : flat;
}

}  // namespace

std::unique_ptr<PrintMotion> fold_motion(const PrintSheet& sheet, const std::vector<double>& reach) {
  if (sheet.motion && sheet.turns.size() == sheet.linkage.hinges.size()) {
    auto lawful = std::make_unique<LawfulMotion>(sheet);
    if (lawful->is_lawful()) return lawful;
  }
  return std::make_unique<SampledMotion>(sheet, reach);
}

double sampling_error_mm(const PrintPath& path, const model::Linkage& linkage) {
  const std::vector<double> reach(linkage.bodies.size(), linkage.size.edge_mm);
  Samples samples{path.states, path.thetas, std::vector<bool>(path.states.size()), reach};
  for (const int k : path.jumps) samples.is_jump[k] = true;
  double most = 0;
  for (std::size_t k = 0; k + 1 < path.states.size(); ++k)
    for (const model::RestHinge& hinge : linkage.hinges)
      most = std::max(most, samples.margin(k, hinge.lower, hinge.upper));
  return most;
}

MovingParts::MovingParts(const PrintSheet& sheet)
    : bodies(static_cast<int>(sheet.bodies.size())), pieces_of(sheet.bodies.size() + sheet.soft.size()) {
  const auto add = [&](PartPiece piece) {
    pieces_of[piece.part].push_back(static_cast<int>(pieces.size()));
    pieces.push_back(std::move(piece));
  };
  for (int b = 0; b < bodies; ++b) {
    std::vector<Vector3d> all{Vector3d::Zero()};
    if (!sheet.bodies[b].arms.empty())
      for (const model::ConvexPiece& piece : convex_pieces(sheet.bodies[b])) {
        if (piece.is_rod) continue;
        add({b, {end_of(b, matrix_of(piece.corners))}});
        pieces.back().hull = hull_of(pieces.back().ends.front().points);
        all.insert(all.end(), piece.corners.begin(), piece.corners.end());
      }
    whole.push_back(end_of(b, matrix_of(all)));
  }
  for (int h = 0; h < static_cast<int>(sheet.soft.size()); ++h)
    if (!sheet.soft[h].points.empty()) add({bodies + h, soft_ends(sheet, h)});
}

Vector3d PlacedPiece::center() const {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < poses.size(); ++k) sum += poses[k]->R * piece.ends[k].center + poses[k]->p;
  return sum / static_cast<double>(poses.size());
}

PieceDistance piece_distance(const PlacedPiece& a, const PlacedPiece& b) {
  const Placed one(a), other(b);
  btGjkEpaSolver2::sResults result;
  const btVector3 guess = to_bullet(Vector3d(b.center() - a.center()));
  const bool apart =
      btGjkEpaSolver2::Distance(one.hull.get(), one.pose, other.hull.get(), other.pose, guess, result);
  if (!apart && !btGjkEpaSolver2::Penetration(one.hull.get(), one.pose, other.hull.get(), other.pose, guess,
                                              result, false))
    result.distance = 0;  // they touch
  PieceDistance out{result.distance, 0.5 * from_bullet(result.witnesses[0] + result.witnesses[1])};
  const Vector3d between = from_bullet(result.witnesses[1] - result.witnesses[0]);
  if (between.norm() > touching_mm) out.normal = (result.distance < 0 ? -1 : 1) * between.normalized();
  return out;
}

model::HingePrint with_faces(model::HingePrint pin, const model::Process& process) {
  const bool inclined = process.filament && !pin.loose;
  pin.axial_clearance_mm = axial_clearance_mm(gap_mm(pin), process, inclined);
  if (inclined) pin.rim_mm = process.filament->line_mm;
  return pin;
}

double min_pin_height_mm(double clearance_mm, const model::Process& process, bool loose) {
  return 4 * axial_clearance_mm(clearance_mm, process, process.filament && !loose);
}

}  // namespace kinetix::app
