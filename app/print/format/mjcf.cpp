#include <fmt/format.h>
#include <iterator>
#include <queue>
#include <set>

#include "app/print/format/print_format.hpp"
#include "model/closure/closure.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector3d;

constexpr double density = 1200;    // kg/m^3: of PLA and of the resins of PolyJet and SLA, 1150 to 1250
constexpr double quickness = 30;    // rad/s of the actuator: the sheet follows its control within 0.1 s
constexpr double stiffer = 10;      // least ratio of actuator to hinge stiffness: only the fold mode yields
constexpr double resolved = 0.2;    // of a period over 2 pi: the longest step in which the actuator is stable
constexpr double step_s = 2e-3;     // s: MuJoCo's default
constexpr double loop_step = 2.5;   // times the step: time in which gaps of loops close
constexpr double min_mass = 1e-12;  // kg m^2: with less the actuator would have nothing to move

std::string text(const Vector3d& v) { return fmt::format("{:.10g} {:.10g} {:.10g}", v.x(), v.y(), v.z()); }

/// Body of the scene, in a tree with the fewest hinges to its root.
struct TreeLink {
  int parent = -1, hinge = -1;
  int root = -1;  ///< body held by the world: the sheet's middle, or one of each separate part
  std::vector<int> children = {};
};

int middle_body(const PrintSheet& sheet) {
  Vector3d middle = Vector3d::Zero();
  const int n = static_cast<int>(sheet.bodies.size());
  for (int b = 0; b < n; ++b) middle += sheet.linkage.rest_position(b) / n;
  int nearest = 0;
  for (int b = 1; b < n; ++b)
    if ((sheet.linkage.rest_position(b) - middle).norm() <
        (sheet.linkage.rest_position(nearest) - middle).norm() - 1e-9)
      nearest = b;
  return nearest;
}

std::vector<TreeLink> trees_of(const PrintSheet& sheet) {
  std::vector<std::vector<int>> at(sheet.bodies.size());
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h)
    for (const int b : {sheet.linkage.hinges[h].lower, sheet.linkage.hinges[h].upper}) at[b].push_back(h);
  std::vector<TreeLink> links(sheet.bodies.size());
  const auto grow = [&](int root) {
    if (links[root].root >= 0) return;
    std::queue<int> next;
    next.push(root);
    links[root].root = root;
    for (; !next.empty(); next.pop())
      for (const int h : at[next.front()]) {
        const model::RestHinge& hinge = sheet.linkage.hinges[h];
        const int other = hinge.lower == next.front() ? hinge.upper : hinge.lower;
        if (links[other].root >= 0) continue;
        links[other] = {.parent = next.front(), .hinge = h, .root = root};
        links[next.front()].children.push_back(other);
        next.push(other);
      }
  };
  grow(middle_body(sheet));
  for (int b = 0; b < static_cast<int>(links.size()); ++b) grow(b);
  return links;
}

class MujocoFile {
 public:
  explicit MujocoFile(const PrintSheet& sheet)
      : sheet_(sheet), links_(trees_of(sheet)), masses_(sheet.bodies.size()) {
    for (int b = 0; b < static_cast<int>(masses_.size()); ++b) masses_[b] = mass_of(b);
    for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h)
      if (!sheet.soft[h].points.empty())
        for (const int b : {sheet.linkage.hinges[h].lower, sheet.linkage.hinges[h].upper})
          add_mass(0.5 * density * 1e-9 * volume_mm3(rounded_for_file(placed_soft(sheet, flat(), h))),
                   hinge_point(h, b), masses_[b]);
    find_turns();
    share_loops();
  }

  std::string text() {
    out_ = fmt::format(
        "<mujoco model=\"{}\">\n<compiler angle=\"radian\" inertiafromgeom=\"false\" boundmass=\"0\"/>\n"
        "<size njmax=\"{}\" nconmax=\"10\" nstack=\"{}\"/>\n"
        "<option timestep=\"{:g}\" gravity=\"0 0 0\" integrator=\"implicit\" iterations=\"50\"/>\n"
        "<default>\n<geom contype=\"0\" conaffinity=\"0\" rgba=\"0.85 0.85 0.82 1\"/>\n"
        "<equality solref=\"{:g} 1\" solimp=\"0.99 0.999 0.001\"/>\n</default>\n",
        sheet_.name, rows() + 100, stack(), step(), loop_step * step());
    add_assets();
    out_ += "<worldbody>\n<light pos=\"0 0 1\" dir=\"0 0 -1\" directional=\"true\"/>\n";
    for (int b = 0; b < static_cast<int>(links_.size()); ++b)
      if (links_[b].root == b) add_body(b);
    out_ += "</worldbody>\n";
    add_loops();
    if (turned_ > 0) add_actuator();
    return out_ + "</mujoco>\n";
  }

 private:
  struct Mass {
    double kg = 0;
    Vector3d center = Vector3d::Zero();                 // m, from the body's rest position
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m^2, about the center
  };

  const model::State& flat() const { return sheet_.path.front(); }

  Mass mass_of(int body) const {
    const model::MassProperties m = mass_properties(sheet_.with_rods(body));
    const double volume_mm3 = model::volume_mm3(rounded_for_file(placed_body(sheet_, flat(), body)));
    return {density * 1e-9 * volume_mm3, metres_per_mm * m.center, density * 1e-15 * m.inertia};
  }

  /// Adds a point mass. @param place m
  static void add_mass(double kg, const Vector3d& place, Mass& to) {
    const Vector3d apart = place - to.center;
    const double reduced = kg * to.kg / (kg + to.kg);
    to.inertia += reduced * (apart.squaredNorm() * Eigen::Matrix3d::Identity() - apart * apart.transpose());
    to.center += kg / (kg + to.kg) * apart;
    to.kg += kg;
  }

  int loops() const {
    const auto in_trees =
        std::count_if(links_.begin(), links_.end(), [](const TreeLink& link) { return link.hinge >= 0; });
    return static_cast<int>(sheet_.hinges.size()) - static_cast<int>(in_trees);
  }
  int rows() const { return 6 * loops(); }
  /// Returns the size of the solver's stack, numbers: its Jacobian, a Hessian and vectors, several times over.
  long stack() const {
    const long rows_ = rows() + 100, dofs = static_cast<long>(links_.size());
    return 8 * (rows_ * dofs + dofs * dofs + rows_) + 1000000;
  }

  Vector3d hinge_point(int h, int body) const {
    const model::RestHinge& hinge = sheet_.linkage.hinges[h];
    return metres_per_mm * sheet_.linkage.size.edge_mm *
           (hinge.lower == body ? hinge.lower_arm : hinge.upper_arm);
  }

  /// Finds the turn of each hinge of the trees from flat to the fold, rad.
  void find_turns() {
    turns_.assign(sheet_.hinges.size(), 0);
    const model::State& folded = sheet_.path.back();
    for (int b = 0; b < static_cast<int>(links_.size()); ++b) {
      if (links_[b].hinge < 0) continue;
      const Eigen::AngleAxisd turn(Eigen::Matrix3d(folded[links_[b].parent].R.transpose() * folded[b].R));
      const Vector3d& axis = sheet_.linkage.hinges[links_[b].hinge].axis;
      turns_[links_[b].hinge] = turn.angle() * (turn.axis().dot(axis) < 0 ? -1 : 1);
      turned_ += turns_[links_[b].hinge] * turns_[links_[b].hinge];
    }
  }

  /// Adds the resistance of hinges of loops, which have no joint, to the joints of the trees. If some hinges are pins,
  /// all joints share it equally, so that the actuator also moves what turns freely.
  void share_loops() {
    double all = 0;
    const model::State& folded = sheet_.path.back();
    for (int h = 0; h < static_cast<int>(turns_.size()); ++h)
      all += stiffness(h) * std::pow(hinge_turn(sheet_.linkage, folded, h), 2);
    const bool has_pins = std::any_of(sheet_.hinges.begin(), sheet_.hinges.end(), has_pin);
    if (has_pins && turned_ > 0)
      shared_ = all / turned_;
    else if (held() > 0)
      with_loops_ = all / held();
  }

  void add_assets() {
    out_ += "<asset>\n";
    for (int b = 0; b < static_cast<int>(sheet_.bodies.size()); ++b) {
      if (sheet_.meshes[b].points.empty()) continue;
      const auto pieces = convex_pieces(sheet_.bodies[b]);
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        out_ += fmt::format("<mesh name=\"m{}_{}\" vertex=\"", b, k);
        for (const Vector3d& p : pieces[k].corners)
          fmt::format_to(std::back_inserter(out_), "{:.7g} {:.7g} {:.7g} ", metres_per_mm * p.x(),
                         metres_per_mm * p.y(), metres_per_mm * p.z());
        out_ += "\"/>\n";
      }
    }
    out_ += "</asset>\n";
  }

  void add_body(int b) {
    const TreeLink& link = links_[b];
    const Vector3d from = link.parent < 0 ? Vector3d::Zero() : sheet_.linkage.rest_position(link.parent);
    out_ += fmt::format("<body name=\"b{}\" pos=\"{}\">\n", b,
                        kinetix::app::text(metres_per_mm * (sheet_.linkage.rest_position(b) - from)));
    add_inertia(masses_[b]);
    if (link.hinge >= 0) add_joint(b);
    const std::size_t pieces = sheet_.meshes[b].points.empty() ? 0 : convex_pieces(sheet_.bodies[b]).size();
    for (std::size_t k = 0; k < pieces; ++k)
      out_ += fmt::format("<geom type=\"mesh\" mesh=\"m{}_{}\"/>\n", b, k);
    for (const int child : link.children) add_body(child);
    out_ += "</body>\n";
  }

  void add_inertia(const Mass& m) {
    const Eigen::Matrix3d& I = m.inertia;
    out_ += fmt::format(
        "<inertial pos=\"{}\" mass=\"{:.12g}\" fullinertia=\"{:.12g} {:.12g} {:.12g} {:.12g} {:.12g} "
        "{:.12g}\"/>\n",
        kinetix::app::text(m.center), m.kg, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  }

  void add_joint(int b) {
    const int h = links_[b].hinge;
    out_ += fmt::format(
        "<joint name=\"j{}\" type=\"hinge\" pos=\"{}\" axis=\"{}\" stiffness=\"{:.6g}\" "
        "damping=\"{:.6g}\"/>\n",
        h, kinetix::app::text(hinge_point(h, b)), kinetix::app::text(sheet_.linkage.hinges[h].axis),
        stiffness(h), damping());
  }

  /// Returns the damping of each joint, N m s/rad. Together they stop the sheet as fast as its actuator moves it.
  double damping() const {
    return turned_ > 0 ? 2 * std::sqrt(moved_mass() * (gain() + held())) / turned_ : 0;
  }

  /// Returns twice the kinetic energy of the sheet that folds within a second, kg m^2.
  double moved_mass() const {
    double sum = min_mass;
    const model::State &flat = sheet_.path.front(), &folded = sheet_.path.back();
    for (std::size_t b = 0; b < masses_.size(); ++b) {
      const model::Pose& root = folded[links_[b].root];
      const Vector3d now = root.R.transpose() * (folded[b].p - root.p),
                     before = flat[b].p - flat[links_[b].root].p;
      sum += masses_[b].kg * (metres_per_mm * (now - before)).squaredNorm();
    }
    return sum;
  }

  /// Adds the hinges outside the trees, each by two points on its axis.
  void add_loops() {
    std::set<int> in_tree;
    for (const TreeLink& link : links_) in_tree.insert(link.hinge);
    out_ += "<equality>\n";
    for (int h = 0; h < static_cast<int>(sheet_.hinges.size()); ++h) {
      if (in_tree.count(h)) continue;
      const model::RestHinge& hinge = sheet_.linkage.hinges[h];
      const double reach = metres_per_mm * reach_mm(sheet_.hinges[h].made);
      for (const double side : {-1.0, 1.0})
        out_ +=
            fmt::format("<connect body1=\"b{}\" body2=\"b{}\" anchor=\"{}\"/>\n", hinge.lower, hinge.upper,
                        kinetix::app::text(hinge_point(h, hinge.lower) + side * reach * hinge.axis));
    }
    out_ += "</equality>\n";
  }

  static bool has_pin(const model::HingePrint& hinge) { return is_pin(hinge.made.kind); }
  /// Returns the stiffness of a joint of the trees, N m/rad.
  double stiffness(int h) const {
    if (shared_) return *shared_;
    const model::HingePrint& hinge = sheet_.hinges[h];
    return has_pin(hinge) ? 0 : with_loops_ * model::stiffness(hinge.made).turn * metres_per_mm;
  }
  /// Returns the force of the trees' hinges on the tendon at the fold, N m: the sum of stiffness times turn^2.
  double held() const {
    double sum = 0;
    for (int h = 0; h < static_cast<int>(turns_.size()); ++h) sum += stiffness(h) * turns_[h] * turns_[h];
    return sum;
  }
  /// Returns the gain of the actuator, N m.
  double gain() const { return std::max(moved_mass() * quickness * quickness, stiffer * held()); }
  /// Returns the time step, s.
  double step() const {
    return turned_ > 0 ? std::min(step_s, resolved * std::sqrt(moved_mass() / (gain() + held()))) : step_s;
  }

  /// Adds one tendon for all hinges of the trees. It is 1 longer when each has turned to the fold. It pulls at each
  /// hinge as hard as that hinge resists there. All hinges then rest in the fold, for any number of degrees of
  /// freedom.
  void add_actuator() {
    out_ += "<tendon>\n<fixed name=\"fold\">\n";
    const double all = held();
    for (int h = 0; h < static_cast<int>(turns_.size()); ++h)
      if (turns_[h] != 0)
        out_ += fmt::format("<joint joint=\"j{}\" coef=\"{:.10g}\"/>\n", h,
                            turns_[h] * (all > 0 ? stiffness(h) / all : 1 / turned_));
    // The resistance of the hinges at the fold adds to the push, so that the tendon's length is exactly the control
    // there.
    out_ += fmt::format(
        "</fixed>\n</tendon>\n<actuator>\n<general name=\"fold\" tendon=\"fold\" gainprm=\"{:.10g}\" "
        "biastype=\"affine\" biasprm=\"0 {:.10g} 0\" ctrllimited=\"true\" ctrlrange=\"0 1\"/>\n</actuator>\n",
        gain() + held(), -gain());
  }

  const PrintSheet& sheet_;
  const std::vector<TreeLink> links_;
  std::vector<Mass> masses_;
  std::vector<double> turns_;
  double turned_ = 0;             // sum of their squares, rad^2
  double with_loops_ = 1;         // energy of all hinges at the fold over that of those in trees
  std::optional<double> shared_;  // N m/rad, of each joint of the tree of a sheet with pins
  std::string out_;
};

std::vector<NamedContent> write_mjcf(const PrintJob& job) {
  return {{job.sheet.name + ".xml", MujocoFile(job.sheet).text()}};
}

}  // namespace

// Entry of the format mjcf: name, meaning and writer.
const PrintFormat mjcf_format = {.name = "mjcf",
                                 .meaning = "MuJoCo, with an actuator that folds it",
                                 .write = write_mjcf,
                                 .is_always_flat = true,
                                 .turns_alone = true};

}  // namespace kinetix::app
