#include "model/lattice/sodalite.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>

#include "model/base/invalid_input.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using Place = std::array<int, 3>;

constexpr int max_bodies = 100'000;            // bodies: a simulation of more takes over an hour
constexpr double fixed_axis_tolerance = 1e-9;  // rad: tolerance of the angles that a file may not change

/// Rotors of a cubic cell, in eighths of it, with their turns. Each has a copy in the middle of the cell. Of the five
/// choices of signs that close all rings, this one shrinks isotropically.
constexpr SodaliteRotor base[] = {{{2, 4, 0}, 0, 1},  {{6, 4, 0}, 0, -1}, {{0, 2, 4}, 1, 1},
                                  {{0, 6, 4}, 1, -1}, {{4, 0, 2}, 2, 1},  {{4, 0, 6}, 2, -1}};
constexpr int middle = 4;     // eighths: shift of the copies along each direction
constexpr int step = 2;       // eighths: distance of neighbours along two directions; it is 0 along the third
constexpr int min_walls = 3;  // walls per rotor: with fewer it would dangle

Place operator+(const Place& a, const Place& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

std::vector<Place> steps() {
  std::vector<Place> out;
  for (int still = 0; still < 3; ++still)
    for (const int a : {-step, step})
      for (const int b : {-step, step}) {
        Place p = {0, 0, 0};
        p[(still + 1) % 3] = a;
        p[(still + 2) % 3] = b;
        out.push_back(p);
      }
  return out;
}

/// Returns all rotors of the cells by position, without those that dangle.
std::map<Place, SodaliteRotor> rotors_of(const Place& cells) {
  std::map<Place, SodaliteRotor> all;
  const auto add = [&](const SodaliteRotor& rotor, const Place& shift) {
    const Place at = rotor.place + shift;
    for (int d = 0; d < 3; ++d)
      if (at[d] < 0 || at[d] > 8 * cells[d]) return;
    all[at] = {at, rotor.axis, rotor.sign};
  };
  for (int i = -1; i <= cells[0]; ++i)
    for (int j = -1; j <= cells[1]; ++j)
      for (int k = -1; k <= cells[2]; ++k)
        for (const SodaliteRotor& rotor : base)
          for (const int half : {0, middle}) add(rotor, {8 * i + half, 8 * j + half, 8 * k + half});
  const std::vector<Place> ways = steps();
  const auto dangles = [&](const auto& entry) {
    return std::count_if(ways.begin(), ways.end(),
                         [&](const Place& way) { return all.count(entry.first + way) > 0; }) < min_walls;
  };
  while (std::erase_if(all, dangles) > 0) {
  }
  return all;
}

/// Returns the midpoint between two rotors, eighths: always an integer.
Place between(const Place& a, const Place& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

Vector3d in_edges(const Place& place) { return Vector3d(place[0], place[1], place[2]) / std::sqrt(8.0); }

Vector3d axis_of(const SodaliteRotor& rotor) { return rotor.sign * Vector3d::Unit(rotor.axis); }

const SodaliteRotor& rotor_of(const SodaliteStructure& s, int hinge) {
  return s.rotors[s.gussets[hinge / 2][hinge % 2]];
}

/// Returns the vector from a hinge's rotor to the middle of its gusset, cell edges.
Vector3d wall_of(const SodaliteStructure& s, int hinge) {
  return in_edges(between(s.rotors[s.gussets[hinge / 2][0]].place, s.rotors[s.gussets[hinge / 2][1]].place)) -
         in_edges(rotor_of(s, hinge).place);
}

double alpha_of(const SodaliteStructure& s, int hinge) {
  return std::acos(axis_of(rotor_of(s, hinge)).dot(wall_of(s, hinge).normalized()));
}

/// Returns the up-direction of a wall: the direction normal to it that is nearest to the hinge's axis.
Vector3d up_of(const SodaliteStructure& s, int hinge) {
  const Vector3d e = wall_of(s, hinge).normalized(), n = axis_of(rotor_of(s, hinge));
  return (n - n.dot(e) * e).normalized();
}

void add_plates(const SodaliteStructure& s, int hinge, const RestHinge& at, std::vector<Plate>& plates) {
  const double length = at.edge.norm(), t = s.hinges[hinge].t;
  const double slant = 1 / std::tan(s.hinges[hinge].alpha);
  const Vector3d e = at.edge / length, up = up_of(s, hinge);
  plates.push_back({at.lower, hinge, e, up, -at.across, t * length, length, slant});
  plates.push_back({at.upper, hinge, -e, up, -at.across, (1 - t) * length, -length, -slant});
}

void add_rings(SodaliteStructure& s) {
  std::map<std::array<int, 2>, int> gusset_of;
  std::vector<std::vector<int>> near(s.rotors.size());
  for (int k = 0; k < static_cast<int>(s.gussets.size()); ++k) {
    const auto [a, b] = s.gussets[k];
    gusset_of[{a, b}] = gusset_of[{b, a}] = k;
    near[a].push_back(b);
    near[b].push_back(a);
  }
  for (int a = 0; a < static_cast<int>(near.size()); ++a)
    for (const int b : near[a])
      for (const int c : near[b])
        for (const int d : near[c]) {
          // Each ring is added once: from its lowest rotor, towards the lower one of that rotor's two neighbours.
          if (!(a < b && a < c && a < d && b < d) || c == a || !gusset_of.count({d, a})) continue;
          const std::array<int, 4> ring = {a, b, c, d};
          s.rings.push_back(ring);
          std::array<int, 8> bodies{}, hinges{};
          for (int k = 0; k < 4; ++k) {
            const int from = ring[k], to = ring[(k + 1) % 4], gusset = gusset_of[{from, to}];
            const bool is_first = s.gussets[gusset][0] == from;
            bodies[2 * k] = from;
            bodies[2 * k + 1] = static_cast<int>(s.rotors.size()) + gusset;
            hinges[2 * k] = 2 * gusset + (is_first ? 0 : 1);
            hinges[2 * k + 1] = 2 * gusset + (is_first ? 1 : 0);
          }
          s.ring_bodies.push_back(bodies);
          s.ring_hinges.push_back(hinges);
        }
}

std::string words(const Place& p) {
  return "[" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " + std::to_string(p[2]) + "]";
}

}  // namespace

SodaliteStructure make_sodalite(Place cells, double gusset, const CellSize& size) {
  check_lengths(size);
  if (!(gusset >= 0.02 && gusset <= 0.9))
    throw InvalidInput("gusset is " + number_text(gusset) + ", must be from 0.02 to 0.9 of the edge");
  double bodies = 36;  // bodies per cubic cell, about
  for (const int count : cells) {
    if (count < 1) throw InvalidInput("a sodalite lattice needs at least one cell along each direction");
    bodies *= count;
  }
  if (bodies > max_bodies)
    throw InvalidInput("a sodalite lattice of " + words(cells) + " cells has more than " +
                       std::to_string(max_bodies) + " bodies");
  SodaliteStructure s;
  s.size = size;
  s.cells = cells;
  s.gusset = gusset;
  std::map<Place, int> index;
  for (const auto& [place, rotor] : rotors_of(cells)) {
    index[place] = static_cast<int>(s.rotors.size());
    s.rotors.push_back(rotor);
  }
  for (int a = 0; a < static_cast<int>(s.rotors.size()); ++a)
    for (const Place& way : steps())
      if (const auto b = index.find(s.rotors[a].place + way); b != index.end() && b->second > a)
        s.gussets.push_back({a, b->second});
  s.hinges.resize(2 * s.gussets.size());
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h)
    s.hinges[h] = {1 - gusset, alpha_of(s, h), 0, 0};
  add_rings(s);
  return s;
}

Place body_label(const SodaliteStructure& s, int body) {
  const int rotors = static_cast<int>(s.rotors.size());
  if (body < rotors) return s.rotors[body].place;
  const auto [a, b] = s.gussets[body - rotors];
  return between(s.rotors[a].place, s.rotors[b].place);
}

Vector3d sodalite_place(const SodaliteStructure& s, int body) { return in_edges(body_label(s, body)); }

RestHinge rest_hinge(const SodaliteStructure& s, int hinge) {
  const auto& [t, alpha, beta, offset] = s.hinges[hinge];
  const Vector3d edge = wall_of(s, hinge), e = edge.normalized(), up = up_of(s, hinge);
  RestHinge out;
  out.lower = s.gussets[hinge / 2][hinge % 2];
  out.upper = static_cast<int>(s.rotors.size()) + hinge / 2;
  out.edge = edge;
  out.across = up.cross(e);
  out.lower_arm = t * edge + offset * out.across;
  out.upper_arm = (t - 1) * edge + offset * out.across;
  const Vector3d leaning = std::cos(beta) * up - std::sin(beta) * out.across,
                 by_beta = -std::sin(beta) * up - std::cos(beta) * out.across;
  out.axis = std::sin(alpha) * leaning + std::cos(alpha) * e;
  out.axis_alpha = std::cos(alpha) * leaning - std::sin(alpha) * e;
  out.axis_beta = std::sin(alpha) * by_beta;
  return out;
}

HingedWall hinged_wall(const SodaliteStructure& s, int hinge) {
  return {s.gussets[hinge / 2][hinge % 2], static_cast<int>(s.rotors.size()) + hinge / 2, wall_of(s, hinge),
          s.hinges[hinge]};
}

void validate_hinges(const SodaliteStructure& s) {
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h) {
    const auto& [t, alpha, beta, offset] = s.hinges[h];
    const std::string name = "the hinge on wall [" + std::to_string(hinged_wall(s, h).lower) + ", " +
                             std::to_string(hinged_wall(s, h).upper) + "]";
    if (!(t > 0 && t < 1))
      throw InvalidInput("t of " + name + " is " + number_text(t) + ", must be in (0, 1)");
    if (!(std::abs(alpha - alpha_of(s, h)) <= fixed_axis_tolerance) ||
        !(std::abs(beta) <= fixed_axis_tolerance) || !(offset == 0))
      throw InvalidInput(name + " has the axis of its rotor. Remove all keys but hinge_position");
  }
}

SodaliteStructure::operator Linkage() const {
  Linkage out;
  out.size = size;
  const int count = static_cast<int>(rotors.size() + gussets.size());
  for (int b = 0; b < count; ++b) {
    const bool is_rotor = b < static_cast<int>(rotors.size());
    LinkageBody body{sodalite_place(*this, b), is_rotor ? 1 : -1};
    body.spin = is_rotor ? Vector3d(2 * axis_of(rotors[b])) : Vector3d::Zero();
    out.bodies.push_back(body);
  }
  for (int h = 0; h < static_cast<int>(hinges.size()); ++h) {
    out.hinges.push_back(rest_hinge(*this, h));
    add_plates(*this, h, out.hinges.back(), out.plates);
  }
  for (std::size_t k = 0; k < rings.size(); ++k)
    out.cells.push_back(
        {{ring_bodies[k].begin(), ring_bodies[k].end()}, {ring_hinges[k].begin(), ring_hinges[k].end()}});
  out.wall_name = [s = *this](int hinge) {
    const HingedWall wall = hinged_wall(s, hinge);
    return "[" + words(body_label(s, wall.lower)) + ", " + words(body_label(s, wall.upper)) + "]";
  };
  out.vertex_name = [s = *this](int body) { return words(body_label(s, body)); };
  return out;
}

namespace {

using Eigen::Matrix3d;

constexpr double closed = 1e-9;     // cell edges: rings that do not close exceed it by far at some probe
constexpr double same_axis = 1e-9;  // rad: tolerance as in validate_hinges
constexpr double one_row = 1e-9;    // cell edges: rounding separates rotors of one layer by as much

/// Path over a gusset from one rotor to the next, with its two hinges.
struct Bridge {
  int from = 0, to = 0, gusset = 0;  ///< rotors, and the gusset's number
  /// To the first hinge, on to the second one, and to that one from its rotor
  Vector3d from_arm, over, to_arm;
  Vector3d to_middle;  ///< from the first hinge to the gusset's middle
};

/// Tree of bridges from rotor 0, and the remaining bridges.
struct Walk {
  std::vector<Bridge> tree, rest;
};

Bridge bridge(const SodaliteStructure& s, const Linkage& linkage, int gusset, int from) {
  const int first = s.gussets[gusset][0] == from ? 0 : 1;
  const RestHinge &a = linkage.hinges[2 * gusset + first], &b = linkage.hinges[2 * gusset + 1 - first];
  return {from, b.lower, gusset, a.lower_arm, b.upper_arm - a.upper_arm, b.lower_arm, -a.upper_arm};
}

Walk walk(const SodaliteStructure& s) {
  const Linkage linkage = s;
  std::vector<std::vector<int>> at(s.rotors.size());
  for (int k = 0; k < static_cast<int>(s.gussets.size()); ++k)
    for (const int rotor : s.gussets[k]) at[rotor].push_back(k);
  std::vector<bool> met(s.rotors.size()), used(s.gussets.size());
  std::vector<int> queue = {0};
  met[0] = true;
  Walk out;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const int k : at[queue[next]]) {
      if (used[k]) continue;
      used[k] = true;
      const Bridge b = bridge(s, linkage, k, queue[next]);
      (met[b.to] ? out.rest : out.tree).push_back(b);
      if (met[b.to]) continue;
      met[b.to] = true;
      queue.push_back(b.to);
    }
  return out;
}

Matrix3d turn_of(const SodaliteRotor& rotor, double theta) {
  return Eigen::AngleAxisd(2 * rotor.sign * theta, Vector3d::Unit(rotor.axis)).toRotationMatrix();
}

/// Returns the position of a bridge's second rotor.
Vector3d over(const Bridge& b, const State& state) {
  return state[b.from].p + state[b.from].R * b.from_arm + b.over - state[b.to].R * b.to_arm;
}

/// Returns the state at theta, in cell edges.
State folded(const SodaliteStructure& s, const Walk& walk, double theta) {
  const int rotors = static_cast<int>(s.rotors.size());
  State state(rotors + s.gussets.size());
  for (int r = 0; r < rotors; ++r) state[r].R = turn_of(s.rotors[r], theta);
  state[0].p = sodalite_place(s, 0);
  for (const Bridge& b : walk.tree) state[b.to].p = over(b, state);
  for (const std::vector<Bridge>* part : {&walk.tree, &walk.rest})
    for (const Bridge& b : *part)
      state[rotors + b.gusset].p = state[b.from].p + state[b.from].R * b.from_arm + b.to_middle;
  return state;
}

State in_mm(State state, double edge_mm) {
  for (Pose& pose : state) pose.p *= edge_mm;
  return state;
}

/// Returns the largest misfit of the walk, cell edges.
double misfit(const SodaliteStructure& s, const Walk& walk) {
  double most = 0;
  for (const double theta : probe_thetas) {
    const State state = folded(s, walk, theta);
    for (const Bridge& b : walk.rest) most = std::max(most, (over(b, state) - state[b.to].p).norm());
  }
  return most;
}

/// Returns a hinge that leans from its rotor's axis, about which it would have to turn; -1 if there is none.
int off_its_axis(const SodaliteStructure& s) {
  const Linkage linkage = s;
  for (int h = 0; h < static_cast<int>(linkage.hinges.size()); ++h) {
    const SodaliteRotor& rotor = s.rotors[linkage.hinges[h].lower];
    if (!((linkage.hinges[h].axis - rotor.sign * Vector3d::Unit(rotor.axis)).norm() <= same_axis)) return h;
  }
  return -1;
}

GrippedRows outer_rotors(const SodaliteStructure& s, Axis axis) {
  const int d = component(axis);
  double low = 0, high = 0;
  for (int r = 0; r < static_cast<int>(s.rotors.size()); ++r) {
    const double at = sodalite_place(s, r)[d];
    low = r == 0 ? at : std::min(low, at);
    high = r == 0 ? at : std::max(high, at);
  }
  GrippedRows rows;
  for (int r = 0; r < static_cast<int>(s.rotors.size()); ++r) {
    const double at = sodalite_place(s, r)[d];
    if (at < low + one_row) rows[0].push_back(r);
    if (at > high - one_row) rows[1].push_back(r);
  }
  return rows;
}

/// Theta and turns of hinges apart by rounding: as the bodies of plates have it.
void check_between_plates(const LinkageDrive& drive, const Linkage& linkage, const State& state) {
  if (!drive.has_plates()) return;
  if (planes_of(drive.gripped, state).off_plane <= 1e-8 * linkage.size.edge_mm) return;
  throw InvalidInput("plates would hold rotors in a plane that leave it in the lattice's exact motion",
                     {"", 0, 0, "drive.axis"});
}

}  // namespace

ExactMotion exact_motion(const SodaliteStructure& structure) {
  const auto s = std::make_shared<const SodaliteStructure>(structure);
  const auto way = std::make_shared<const Walk>(walk(*s));
  if (const double gap = misfit(*s, *way); !(gap <= closed))
    return {{},
            "none",
            "no exact family: rings of rotors and gussets do not close; they are off by " + number_text(gap) +
                " cell edges"};
  if (const int h = off_its_axis(*s); h >= 0)
    return {{},
            "none",
            "no exact family: the hinge on wall [" + std::to_string(hinged_wall(*s, h).lower) + ", " +
                std::to_string(hinged_wall(*s, h).upper) + "] has not the axis of its rotor"};
  const auto at = [s, way](double theta) { return in_mm(folded(*s, *way, theta), s->size.edge_mm); };
  const auto theta = [s, at](const LinkageDrive& drive) {
    const Linkage linkage = *s;
    check_between_plates(drive, linkage, at(probe_thetas[1]));
    return theta_of(drive, linkage, at);
  };
  return {
      at, "sodalite",
      "sodalite: rotors turn by twice the fold angle about the axes x, y and z, gussets keep their direction",
      theta};
}

LinkageDrive plate_drive(const SodaliteStructure& structure, Axis axis, double compression, int branch) {
  validate_hinges(structure);
  return plates_between(outer_rotors(structure, axis), axis, compression, branch,
                        static_cast<int>(structure.rotors.size() + structure.gussets.size()));
}

LinkageDrive hinge_drive(const SodaliteStructure& structure, int hinge, double angle) {
  validate_hinges(structure);
  return turned_hinge(hinge, 1, angle);
}

LinkageDrive drive_to(const SodaliteStructure& structure, double theta) {
  require("theta", theta, std::abs(theta) < pi / 2, "in (-pi/2, pi/2) rad");
  const ExactMotion exact = exact_motion(structure);
  if (!exact) return hinge_drive(structure, 0, turn_at_theta(1, theta));
  LinkageDrive drive = plate_drive(structure, Axis::y, 0, theta < 0 ? -1 : 1);
  const Linkage linkage = structure;
  drive.compression = 1 - planes_of(drive.gripped, exact.at(theta)).distance /
                              planes_of(drive.gripped, rest_state(linkage)).distance;
  return drive;
}

}  // namespace kinetix::model
