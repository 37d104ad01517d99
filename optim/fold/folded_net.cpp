#include "optim/fold/folded_net.hpp"

#include <limits>

#include "model/contact/wall_contact.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::optim {
namespace {

/// Tilts the walls of a crease so that its far sides rise for a positive turn.
void set_fold(model::Structure& structure, const targets::PlacedCrease& crease, double tilt) {
  for (const model::Wall& wall : bending_walls(crease))
    structure.hinges[*structure.hinge_at(wall)].parameters.beta =
        -alternation(wall) * turn_sense(wall) * tilt;
}

}  // namespace

FoldedNet fold_to(const targets::FoldNet& net, const std::vector<int>& columns, double theta,
                  const model::CellSize& size, double max_tilt) {
  FoldedNet out;
  out.net = net;
  out.layout = lay_out(net, columns);
  out.theta = theta;
  out.structure = make_structure(out.layout.cells, size);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const double wanted = model::tilt_of_turn(net.creases[c].angle / columns[c], theta);
    const double tilt = std::clamp(wanted, -max_tilt, max_tilt);
    set_fold(out.structure, out.layout.creases[c], tilt);
    out.tilt.push_back(std::abs(tilt));
  }
  out.tree = make_net_tree(out.structure, middle_body(out.layout.faces[0], out.structure));
  out.error = fold_error(net, out.layout, out.structure, fold_net(out.tree, out.structure, theta), theta);
  return out;
}

std::vector<int> parts_of_bodies(const FoldedNet& folded) {
  std::vector<int> part(folded.structure.bodies.size(), -1);
  const targets::NetLayout& layout = folded.layout;
  for (std::size_t f = 0; f < layout.faces.size(); ++f)
    for (const int body : bodies_of(layout.faces[f], folded.structure)) part[body] = static_cast<int>(f);
  for (std::size_t c = 0; c < layout.creases.size(); ++c)
    for (const model::Wall& wall : bending_walls(layout.creases[c])) {
      const model::Hinge& hinge = folded.structure.hinges[*folded.structure.hinge_at(wall)];
      for (const int body : {hinge.lower, hinge.upper})
        if (part[body] < 0) part[body] = static_cast<int>(layout.faces.size() + c);
    }
  return part;
}

std::string part_name(const targets::FoldNet& net, int part) {
  const int faces = static_cast<int>(net.faces.size());
  if (part < faces) return "face " + targets::in_ticks(net.faces[part].name);
  return "crease " + targets::in_ticks(crease_name(net, net.creases[part - faces]));
}

namespace {

// Cell edges: steps shrink with the gap, and with a limit of 0 they would never end.
constexpr double too_close_in_edges = 0.02;
// Rad of theta: steps are safe at any length, but long ones check more pairs of walls.
constexpr double longest_turn = 2 * radians_per_degree;

/// Returns an upper bound of d(fold)/d(theta) of a crease from theta on: the rate falls with theta.
double fold_rate(double tilt, int columns, double theta) {
  return columns * model::crease_derivatives(tilt, theta).by_theta;
}

/// Plates of one face in a state.
struct FaceWalls {
  std::vector<OrientedBox> boxes;
  std::vector<double> radii;
  double largest_radius = 0;
  Eigen::AlignedBox3d centers;

  void add(const OrientedBox& box) {
    boxes.push_back(box);
    radii.push_back(box.half.norm());
    largest_radius = std::max(largest_radius, radii.back());
    centers.extend(box.center);
  }
};

/// Returns a lower bound of the distance of two faces, at most `cap`.
double clearance(const FaceWalls& a, const FaceWalls& b, double cap) {
  double least = cap;
  for (std::size_t k = 0; k < a.boxes.size(); ++k) {
    const double near = least + a.radii[k] + b.largest_radius;
    if (b.centers.squaredExteriorDistance(a.boxes[k].center) >= near * near) continue;
    for (std::size_t m = 0; m < b.boxes.size(); ++m) {
      const double reach = least + a.radii[k] + b.radii[m];
      if ((a.boxes[k].center - b.boxes[m].center).squaredNorm() >= reach * reach) continue;
      least = std::min(least, separation(a.boxes[k], b.boxes[m]));
    }
  }
  return least;
}

class Watch {
 public:
  explicit Watch(const FoldedNet& folded)
      : folded_(folded), walls_(half_walls(folded.structure)), part_(parts_of_bodies(folded)) {
    const int faces = static_cast<int>(folded.net.faces.size());
    for (int a = 0; a < faces; ++a) collect_face_paths(a, a, -1, {});
  }

  std::optional<FaceCrossing> run() {
    double theta = 0;
    while (true) {
      place(theta);
      double step = longest_turn;
      for (const FacePath& path : face_paths_) {
        const double speed = closing_speed(path, theta);
        const double gap = clearance(faces_[path.first], faces_[path.second], speed * step + too_close());
        if (gap < too_close()) return FaceCrossing{path.first, path.second, theta};
        step = std::min(step, gap / speed);
      }
      if (theta >= folded_.theta) return std::nullopt;
      theta = std::min(theta + step, folded_.theta);
    }
  }

 private:
  /// Two faces with the creases between them, and the length of net beyond each crease.
  struct FacePath {
    int first, second;
    std::vector<int> creases;
    std::vector<double> beyond;  ///< mm
    double length = 0;           ///< mm
  };

  double edge() const { return folded_.structure.size.edge_mm; }
  double too_close() const { return too_close_in_edges * edge(); }

  /// Returns the longest path over a face, including the half walls that protrude from it.
  double across_face(int face) const {
    const model::CellRectangle& f = folded_.layout.faces[face];
    return edge() * (std::hypot(f.width, f.height) + 1);
  }

  void collect_face_paths(int start, int at, int from, std::vector<int> creases) {
    if (creases.size() > 1 && start < at) add_face_path(start, at, creases);
    for (std::size_t c = 0; c < folded_.net.creases.size(); ++c) {
      const targets::FoldCrease& crease = folded_.net.creases[c];
      const int next = crease.first == at ? crease.second : crease.second == at ? crease.first : -1;
      if (next < 0 || next == from || visited(start, creases, next)) continue;
      creases.push_back(static_cast<int>(c));
      collect_face_paths(start, next, at, creases);
      creases.pop_back();
    }
  }

  bool visited(int start, const std::vector<int>& creases, int face) const {
    return face == start || std::any_of(creases.begin(), creases.end(), [&](int c) {
             return folded_.net.creases[c].first == face || folded_.net.creases[c].second == face;
           });
  }

  bool joined(int a, int b) const {
    return std::any_of(
        folded_.net.creases.begin(), folded_.net.creases.end(),
        [&](const targets::FoldCrease& c) { return std::minmax(c.first, c.second) == std::minmax(a, b); });
  }

  void add_face_path(int first, int second, const std::vector<int>& creases) {
    const bool known = std::any_of(face_paths_.begin(), face_paths_.end(),
                                   [&](const FacePath& w) { return w.first == first && w.second == second; });
    if (known || joined(first, second)) return;
    FacePath path{first, second, creases, std::vector<double>(creases.size()), across_face(first)};
    double beyond = across_face(second);
    int face = second;
    for (std::size_t k = creases.size(); k-- > 0;) {
      const targets::FoldCrease& crease = folded_.net.creases[creases[k]];
      beyond += edge() * folded_.layout.creases[creases[k]].columns();
      path.beyond[k] = beyond + folded_.structure.size.height_mm;
      face = crease.first == face ? crease.second : crease.first;
      if (k > 0) beyond += across_face(face);
    }
    path.length += beyond;
    face_paths_.push_back(std::move(path));
  }

  /// Returns a bound of the closing speed from theta to the end of the motion, mm per rad.
  double closing_speed(const FacePath& path, double theta) const {
    double speed = path.length * std::sin(folded_.theta) + edge() + 2 * folded_.structure.size.thickness_mm;
    for (std::size_t k = 0; k < path.creases.size(); ++k) {
      const int c = path.creases[k];
      speed += path.beyond[k] * fold_rate(folded_.tilt[c], folded_.layout.creases[c].columns(), theta);
    }
    return speed;
  }

  void place(double theta) {
    const model::State state = fold_net(folded_.tree, folded_.structure, theta);
    faces_.assign(folded_.net.faces.size(), {});
    for (const model::HalfWall& wall : walls_) {
      const int part = part_[wall.body];
      if (part >= static_cast<int>(faces_.size())) continue;
      faces_[part].add(placed(wall, state[wall.body]));
    }
  }

  const FoldedNet& folded_;
  std::vector<model::HalfWall> walls_;
  std::vector<int> part_;
  std::vector<FacePath> face_paths_;
  std::vector<FaceWalls> faces_;
};

}  // namespace

std::optional<FaceCrossing> first_face_crossing(const FoldedNet& folded) { return Watch(folded).run(); }

}  // namespace kinetix::optim
