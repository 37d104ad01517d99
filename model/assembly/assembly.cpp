#include "model/assembly/assembly.hpp"

#include <cstdio>
#include <optional>
#include <set>

#include "model/assembly/bearing_faces.hpp"
#include "model/assembly/shells.hpp"
#include "model/assembly/soft_hinge.hpp"
#include "model/base/algorithms.hpp"
#include "model/base/box.hpp"
#include "model/base/decompositions.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double crossing_mm = 0.02;  // mm: below it is rounding of a drawing, invisible to printers.
// Ratio to the largest patch of a soft part: a smaller one is an edge that grazes a wall
constexpr double min_patch = 0.02;
// Sine of the angle between a requested axis and the part's length: a smaller one has no meaning
constexpr double near_axis = 0.1;
constexpr double stocky = 0.5;    // length over thickness, below which the formulas of blocks are not fitted
constexpr double rod_mpa = 2000;  // MPa, default of a pin: usual printing plastics
constexpr double rod_nu = 0.35;   // Poisson's ratio, default of a pin: usual printing plastics

std::string text(const Vector3d& v) {
  char out[96];
  std::snprintf(out, sizeof out, "[%.4g, %.4g, %.4g]", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
  return out;
}

/// Sets components of the size of rounding to 0, for messages.
Vector3d tidy(Vector3d v) {
  for (double& x : v)
    if (std::abs(x) < 5e-5) x = 0;
  return v;
}

class Builder {
 public:
  Builder(const std::vector<ModelPart>& parts, const HingeChoices& choices) : choices_(choices) {
    std::set<std::string> names;
    for (const ModelPart& part : parts) {
      check(part);
      if (!names.insert(part.name).second) throw InvalidInput("two parts are called `" + part.name + "`");
      if (part.soft)
        soft_.push_back(&part);
      else
        add_body(part);
    }
  }

  Assembly run() {
    if (out_.bodies.size() < 2)
      throw InvalidInput("has " + std::to_string(out_.bodies.size()) +
                         " hard parts. Split it, or give hinges that join two parts");
    check_crossings();
    add_soft_hinges();
    add_pins();
    check_joined();
    check_choices();
    order_axes();
    out_.edge_mm = hinge_distance(out_);
    if (!(out_.edge_mm > 0))
      throw InvalidInput("bodies that share a hinge have the same centre. Give `cell_mm`");
    return std::move(out_);
  }

 private:
  static void check(const ModelPart& part) {
    const std::string what = std::string(part.soft ? "soft" : "hard") + " part `" + part.name + "` ";
    for (const Vector3d& p : part.solid.points)
      if (!p.allFinite()) throw InvalidInput(what + "has a coordinate that is not a finite number");
    const std::string defect = shell_defect(part.solid);
    if (!defect.empty()) throw InvalidInput(what + defect);
    if (const auto place = self_crossing(part.solid, crossing_mm))
      throw InvalidInput(what + "crosses itself at " + text(tidy(*place)) + " mm");
  }

  void add_body(const ModelPart& part) {
    out_.bodies.push_back({part.name, mass_properties(part.solid).center, part.solid});
    boxes_.push_back(box_of(part.solid.points));
  }

  void check_crossings() const {
    for (std::size_t a = 0; a < out_.bodies.size(); ++a)
      for (std::size_t b = a + 1; b < out_.bodies.size(); ++b) {
        if (!boxes_[a].intersects(boxes_[b])) continue;
        const AssemblyBody &first = out_.bodies[a], &second = out_.bodies[b];
        const std::string what = "hard parts `" + first.name + "` and `" + second.name + "` ";
        if (const auto place = crossing(first.solid, second.solid, crossing_mm))
          throw InvalidInput(what + "overlap at " + text(tidy(*place)) + " mm");
        if ((boxes_[a].contains(boxes_[b]) && is_inside(first.solid, second.solid.points.front())) ||
            (boxes_[b].contains(boxes_[a]) && is_inside(second.solid, first.solid.points.front())))
          throw InvalidInput(what + "lie one inside the other");
      }
  }

  struct Touch {
    int body;
    ContactPatch patch;
  };

  std::vector<Touch> touches(const ModelPart& part) const {
    const ContactTolerance tolerance;
    Eigen::AlignedBox3d box = box_of(part.solid.points);
    box.min().array() -= tolerance.gap_mm;
    box.max().array() += tolerance.gap_mm;
    std::vector<Touch> out;
    double largest = 0;
    for (int b = 0; b < static_cast<int>(out_.bodies.size()); ++b) {
      if (!box.intersects(boxes_[b])) continue;
      Touch touch{b, contact_patch(part.solid, out_.bodies[b].solid, tolerance)};
      largest = std::max(largest, touch.patch.area_mm2);
      out.push_back(std::move(touch));
    }
    std::erase_if(out, [&](const Touch& t) { return !(t.patch.area_mm2 > min_patch * largest); });
    return out;
  }

  void add_soft_hinges() {
    for (const ModelPart* part : soft_) {
      const std::vector<Touch> found = touches(*part);
      if (found.size() != 2) refuse_touches(*part, found);
      add_soft_hinge(*part, found[0], found[1]);
    }
  }

  [[noreturn]] void refuse_touches(const ModelPart& part, const std::vector<Touch>& found) const {
    std::string names;
    for (const Touch& t : found) names += (names.empty() ? ": `" : ", `") + out_.bodies[t.body].name + "`";
    throw InvalidInput("soft part `" + part.name + "` touches " +
                       (found.empty() ? "no" : std::to_string(found.size())) + " hard part" +
                       (found.size() == 1 ? "" : "s") + names +
                       ". Give hinges that touch two hard parts within 0.05 mm");
  }

  void add_soft_hinge(const ModelPart& part, const Touch& first, const Touch& second) {
    std::optional<SoftHinge> shape = soft_hinge(part.solid, first.patch, second.patch);
    if (!shape)
      throw InvalidInput("soft part `" + part.name +
                         "` has no length between its two hard parts. Move the parts apart");
    const AssemblyBody &a = out_.bodies[first.body], &b = out_.bodies[second.body];
    if (const Vector3d* axis = chosen(part.name, a.name, b.name)) {
      if (!(axis->cross(shape->along).norm() > near_axis))
        throw InvalidInput(
            "hinge `" + part.name +
            "`: the given axis runs along the soft part, from one hard part to the other. Give another axis");
      shape = turned_to(*shape, part.solid, first.patch, second.patch, *axis);
    } else if (shape->is_ambiguous()) {
      settle(part, a, b, first, second, *shape);
    }
    AssemblyHinge hinge{part.name, first.body, second.body, HingeKind::block, shape->point, shape->axis};
    hinge.along = shape->along;
    hinge.confidence = shape->confidence;
    hinge.reach_mm = model::reach_mm(*shape);
    hinge.k = stiffness_of(*shape, part.name);
    hinge.soft = part.solid;
    out_.hinges.push_back(std::move(hinge));
  }

  void settle(const ModelPart& part, const AssemblyBody& a, const AssemblyBody& b, const Touch& first,
              const Touch& second, SoftHinge& shape) const {
    if (!choices_.towards)
      throw InvalidInput("soft part `" + part.name + "` between `" + a.name + "` and `" + b.name +
                         "` bends about either of two axes, " + text(tidy(shape.axis)) + " or " +
                         text(tidy(shape.other)) + ". Set it by --hinges FILE, e.g. `hinges: [{hinge: " +
                         part.name + ", axis: " + text(tidy(shape.axis)) + "}]`");
    const double own = std::abs(shape.axis.dot(*choices_.towards)),
                 other = std::abs(shape.other.dot(*choices_.towards));
    const double confidence = shape.confidence;
    if (other > own) shape = turned_to(shape, part.solid, first.patch, second.patch, shape.other);
    shape.confidence = confidence;
  }

  HingeStiffness stiffness_of(const SoftHinge& shape, const std::string& name) {
    Material material = choices_.material.value_or(*find_material("tango"));
    if (shape.length_mm < stocky * std::max(shape.bending_mm, shape.pulling_mm)) {
      material.E_mpa /= 1 - material.nu * material.nu;  // held flat at both ends, and too short to contract
      material.nu = 0;
      out_.notes.push_back("hinge `" + name +
                           "` is shorter than half its thickness: its stiffness is a rough one");
    }
    return stiffness(shape, material);
  }

  /// Returns the axis chosen for a hinge, if any, and marks the choice as used.
  const Vector3d* chosen(const std::string& name, const std::string& a, const std::string& b) {
    for (const std::string& key : {name, a + "/" + b, b + "/" + a})
      if (const auto found = choices_.axes.find(key); found != choices_.axes.end()) {
        used_.insert(key);
        return &found->second;
      }
    return nullptr;
  }

  void add_pins() {
    std::vector<Bearings> faces;
    for (const AssemblyBody& body : out_.bodies) faces.push_back(bearings_of(body.solid));
    for (int a = 0; a < static_cast<int>(faces.size()); ++a)
      for (int b = a + 1; b < static_cast<int>(faces.size()); ++b) {
        if (!boxes_[a].intersects(boxes_[b])) continue;
        const BearingFits fits = fits_between(faces[a], faces[b]);
        for (const PinFit& pin : fits.pins) add_pin(a, b, pin);
        for (const BallFit& ball : fits.balls) add_ball(a, b, ball);
      }
  }

  void add_pin(int a, int b, const PinFit& fit) {
    AssemblyHinge hinge{"pin_" + std::to_string(++pins_), a, b, HingeKind::pin, fit.point, fit.axis};
    hinge.along = direction_across(out_.bodies[b].position - out_.bodies[a].position, fit.axis);
    const ManufacturedHinge made{.kind = HingeKind::pin,
                                 .material = {.E_mpa = rod_mpa, .nu = rod_nu},
                                 .height_mm = fit.length_mm,
                                 .diameter_mm = fit.rod_mm,
                                 .clearance_mm = fit.clearance_mm};
    hinge.k = model::stiffness(made);
    hinge.reach_mm = model::reach_mm(made);
    hinge.rod_mm = fit.rod_mm;
    hinge.clearance_mm = fit.clearance_mm;
    out_.hinges.push_back(std::move(hinge));
  }

  void add_ball(int a, int b, const BallFit& fit) {
    AssemblyHinge hinge{"ball_" + std::to_string(++balls_), a, b, HingeKind::pin, fit.center};
    hinge.along = direction_across(out_.bodies[b].position - out_.bodies[a].position, hinge.axis);
    hinge.reach_mm = fit.ball_mm / 2;
    hinge.rod_mm = fit.ball_mm;
    hinge.clearance_mm = fit.clearance_mm;
    hinge.ball = true;
    out_.hinges.push_back(std::move(hinge));
  }

  void check_joined() const {
    if (out_.hinges.empty())
      throw NoHinges(
          "has no hinge: no soft part, and no hard part with a rod in a bore, a cone in a cup or a ball in a "
          "socket of another");
    if (const auto body = first_apart(out_))
      throw InvalidInput("hard part `" + out_.bodies[*body].name + "` hangs on no chain of hinges with `" +
                         out_.bodies[0].name + "`");
  }

  void check_choices() const {
    for (const auto& [key, axis] : choices_.axes) {
      if (used_.contains(key)) continue;
      throw InvalidInput("--hinges names `" + key +
                         "`, which is neither a soft part nor a pair of bodies `A/B` with one between them");
    }
  }

  /// Turns all axes to one side of their main direction, whose largest component is positive.
  void order_axes() {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const AssemblyHinge& h : out_.hinges) spread += h.axis * h.axis.transpose();
    Vector3d main = principal_axes(spread).axes.col(2);
    Eigen::Index lead = 0;
    main.cwiseAbs().maxCoeff(&lead);
    if (main[lead] < 0) main = -main;
    for (AssemblyHinge& h : out_.hinges)
      if (h.axis.dot(main) < 0) h.axis = -h.axis;
  }

  const HingeChoices& choices_;
  std::vector<const ModelPart*> soft_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::set<std::string> used_;
  Assembly out_;
  int pins_ = 0, balls_ = 0;
};

/// Returns 1 and -1 alternately from body 0 on, across hinges.
std::vector<int> alternating(const Assembly& assembly) {
  std::vector<int> sense(assembly.bodies.size(), 0);
  for (std::size_t first = 0; first < sense.size(); ++first) {
    if (sense[first] != 0) continue;
    sense[first] = 1;
    for (bool grows = true; grows;) {
      grows = false;
      for (const AssemblyHinge& h : assembly.hinges)
        for (const auto& [from, to] : {std::pair(h.lower, h.upper), std::pair(h.upper, h.lower)})
          if (sense[from] != 0 && sense[to] == 0) {
            sense[to] = -sense[from];
            grows = true;
          }
    }
  }
  return sense;
}

}  // namespace

double hinge_distance(const Assembly& assembly) {
  std::vector<double> all;
  for (const AssemblyHinge& h : assembly.hinges)
    all.push_back((assembly.bodies[h.upper].position - assembly.bodies[h.lower].position).norm());
  return lower_median(std::move(all));
}

std::optional<int> first_apart(const Assembly& assembly) {
  UnionFind joined(assembly.bodies.size());
  for (const AssemblyHinge& h : assembly.hinges) joined.unite(h.lower, h.upper);
  for (int b = 1; b < static_cast<int>(assembly.bodies.size()); ++b)
    if (joined.find(b) != joined.find(0)) return b;
  return std::nullopt;
}

Assembly make_assembly(const std::vector<ModelPart>& parts, const HingeChoices& choices) {
  return Builder(parts, choices).run();
}

Linkage linkage_of(const Assembly& assembly) {
  Linkage out;
  out.size = {
      .edge_mm = assembly.edge_mm, .thickness_mm = 0.1 * assembly.edge_mm, .height_mm = assembly.edge_mm};
  const std::vector<int> sense = alternating(assembly);
  std::vector<Vector3d> spins(assembly.bodies.size(), Vector3d::Zero());
  for (const AssemblyHinge& h : assembly.hinges) {
    const Vector3d lower = assembly.bodies[h.lower].position, upper = assembly.bodies[h.upper].position;
    RestHinge rest;
    rest.lower = h.lower;
    rest.upper = h.upper;
    rest.edge = h.along;
    rest.across = h.axis.cross(h.along).normalized();
    rest.lower_arm = (h.point - lower) / assembly.edge_mm;
    rest.upper_arm = (h.point - upper) / assembly.edge_mm;
    rest.axis = h.axis;
    rest.axis_alpha = rest.axis_beta = Vector3d::Zero();
    rest.ball = h.ball;
    out.hinges.push_back(rest);
    for (const int b : {h.lower, h.upper}) spins[b] += h.axis;
  }
  for (std::size_t b = 0; b < assembly.bodies.size(); ++b) {
    LinkageBody body{assembly.bodies[b].position / assembly.edge_mm, sense[b]};
    body.spin = sense[b] * spins[b].stableNormalized();
    out.bodies.push_back(body);
  }
  std::vector<std::string> hinges, bodies;
  for (const AssemblyHinge& h : assembly.hinges) hinges.push_back(h.name);
  for (const AssemblyBody& b : assembly.bodies) bodies.push_back(b.name);
  out.wall_name = [hinges](int hinge) { return "`" + hinges[hinge] + "`"; };
  out.vertex_name = [bodies](int body) { return "`" + bodies[body] + "`"; };
  return out;
}

}  // namespace kinetix::model
