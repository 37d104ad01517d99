#include "app/files/origami_file.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "model/base/invalid_input.hpp"
#include "model/lattice/origami/march.hpp"
#include "targets/document/document.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;
using Json = nlohmann::json;
using Ends = std::pair<int, int>;

constexpr std::size_t max_pattern_bytes = 16 << 20;  // bytes, 16 MiB as for designs, some 100 000 facets
// Rad: opposite sectors of vertices given to six digits differ from a straight angle by less.
constexpr double straight_slack = 2e-3;
constexpr double same_multiplier = 2e-3;  // relative: around a mesh given to six digits they agree better
constexpr double min_ratio = 1e-4;        // of multipliers: below it a crease does not fold at all

std::string vertex_name(int v) { return "vertex " + std::to_string(v); }
std::string edge_name(const Ends& e) {
  return "the edge of vertices " + std::to_string(e.first) + " and " + std::to_string(e.second);
}
Ends ordered(int a, int b) { return std::minmax(a, b); }

/// Content of a FOLD file by its numbers.
struct Pattern {
  std::vector<Vector2d> vertices;
  std::vector<std::vector<int>> faces;     ///< counter-clockwise
  std::map<Ends, char> assignment;         ///< M, V, B
  std::map<Ends, std::vector<int>> sides;  ///< faces beside each edge
};

[[noreturn]] void missing(const std::string& what) {
  throw InvalidInput("this is not a FOLD file of a crease pattern: it has no `" + what +
                     "`. Give vertices_coords, faces_vertices, edges_vertices and edges_assignment");
}

const Json& list_in(const Json& frame, const char* key) {
  const auto found = frame.find(key);
  if (found == frame.end() || !found->is_array()) missing(key);
  return *found;
}

/// Returns a frame with what it inherits: frame 0 is the file itself, the others are those of file_frames.
/// @param deep number of frames that inherit from each other so far
Json with_inherited(const Json& root, std::size_t number, std::size_t deep = 0) {
  const Json& frames = list_in(root, "file_frames");
  const Json& frame = number == 0 ? root : frames[number - 1];
  if (number == 0 || frame.value("frame_inherit", Json(false)) != Json(true)) return frame;
  const Json parent = frame.value("frame_parent", Json(0));
  if (!parent.is_number_unsigned() || parent.get<std::size_t>() > frames.size() ||
      deep > targets::max_document_depth ||
      (parent != 0 && !frames[parent.get<std::size_t>() - 1].is_object()))
    throw InvalidInput(
        "frame " + std::to_string(number) +
        " inherits from a missing frame, from itself, or over more frames than allowed. Give at most " +
        std::to_string(targets::max_document_depth) + " ancestors");
  Json whole = with_inherited(root, parent.get<std::size_t>(), deep + 1);
  whole.update(frame);
  return whole;
}

/// Returns the first frame that has faces, its own or inherited.
Json frame_of(const Json& root) {
  if (!root.is_object())
    throw InvalidInput("this is not a FOLD file: its JSON is not an object. Give a FOLD file");
  if (root.contains("faces_vertices") || !root.contains("file_frames")) return root;
  const Json& frames = list_in(root, "file_frames");
  for (std::size_t k = 1; k <= frames.size(); ++k) {
    if (!frames[k - 1].is_object()) continue;
    Json frame = with_inherited(root, k);
    if (frame.contains("faces_vertices")) return frame;
  }
  return root;
}

/// Returns the unit of a frame, mm; empty if the frame has "unit" or none.
std::optional<double> unit_of(const Json& frame) {
  static const std::map<std::string, double> known = {
      {"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"pt", 25.4 / 72}};
  const auto found = frame.find("frame_unit");
  if (found == frame.end()) return std::nullopt;
  const std::string word = found->is_string() ? found->get<std::string>() : found->dump();
  if (word == "unit") return std::nullopt;
  if (const auto unit = known.find(word); unit != known.end()) return unit->second;
  throw InvalidInput("the unit " + targets::in_ticks(word) +
                     " (frame_unit) is not known. Give unit, mm, cm, m, in or pt");
}

Vector2d point_of(const Json& at, std::size_t v) {
  const bool fits = at.is_array() && (at.size() == 2 || at.size() == 3) && at[0].is_number() &&
                    at[1].is_number() && (at.size() == 2 || at[2].is_number());
  if (!fits)
    throw InvalidInput("vertices_coords: " + vertex_name(static_cast<int>(v)) +
                       " is not a point. Give [x, y]");
  if (at.size() == 3 && at[2].get<double>() != 0)
    throw InvalidInput("vertices_coords: " + vertex_name(static_cast<int>(v)) +
                       " is not in the plane z = 0. Give the flat crease pattern as the first frame");
  return {at[0].get<double>(), at[1].get<double>()};
}

int index_of(const Json& number, std::size_t count, const std::string& where) {
  if (!number.is_number_integer() || number.get<long>() < 0 || number.get<long>() >= static_cast<long>(count))
    throw InvalidInput(where + " refers to a missing vertex. Give numbers from 0 to " +
                       std::to_string(static_cast<long>(count) - 1));
  return number.get<int>();
}

void read_face(const Json& list, Pattern& p) {
  const std::string name = "face " + std::to_string(p.faces.size());
  if (!list.is_array() || list.size() != 4)
    throw InvalidInput(name + " has " + std::to_string(list.size()) +
                       " corners. Give quadrilaterals, which alone fold as a sheet");
  std::vector<int> face;
  for (const Json& v : list) face.push_back(index_of(v, p.vertices.size(), name));
  const double area = signed_area(face.size(), [&](std::size_t k) { return p.vertices[face[k]]; });
  if (area < 0) std::reverse(face.begin(), face.end());
  for (std::size_t k = 0; k < face.size(); ++k)
    p.sides[ordered(face[k], face[(k + 1) % face.size()])].push_back(static_cast<int>(p.faces.size()));
  p.faces.push_back(std::move(face));
}

char letter_of(const Json& frame, std::size_t edge) {
  if (const auto words = frame.find("edges_assignment"); words != frame.end()) {
    if (!words->is_array() || edge >= words->size() || !(*words)[edge].is_string())
      missing("edges_assignment");
    const std::string word = (*words)[edge].get<std::string>();
    return word.empty() ? ' ' : word[0];
  }
  const Json& angles = list_in(frame, "edges_foldAngle");
  if (edge >= angles.size() || !angles[edge].is_number()) return 'B';
  const double angle = angles[edge].get<double>();
  return angle > 0 ? 'V' : angle < 0 ? 'M' : 'F';
}

Pattern read_pattern(const Json& frame) {
  Pattern p;
  for (const Json& at : list_in(frame, "vertices_coords"))
    p.vertices.push_back(point_of(at, p.vertices.size()));
  for (const Json& list : list_in(frame, "faces_vertices")) read_face(list, p);
  if (p.faces.empty()) missing("faces_vertices");
  const Json& edges = list_in(frame, "edges_vertices");
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::string name = "edge " + std::to_string(e);
    if (!edges[e].is_array() || edges[e].size() != 2)
      throw InvalidInput(name + " does not join two vertices. Give two different vertices");
    p.assignment[ordered(index_of(edges[e][0], p.vertices.size(), name),
                         index_of(edges[e][1], p.vertices.size(), name))] = letter_of(frame, e);
  }
  return p;
}

/// Checks that vertices inside the boundary have four creases.
void check_degrees(const Pattern& p) {
  std::vector<int> degree(p.vertices.size(), 0);
  std::vector<bool> at_boundary(p.vertices.size(), false);
  for (const auto& [edge, faces] : p.sides) {
    if (faces.size() > 2)
      throw InvalidInput(edge_name(edge) + " has more than two faces. Give a plane pattern");
    for (const int v : {edge.first, edge.second}) {
      ++degree[v];
      if (faces.size() == 1) at_boundary[v] = true;
    }
  }
  for (int v = 0; v < static_cast<int>(degree.size()); ++v)
    if (!at_boundary[v] && degree[v] > 0 && degree[v] != 4)
      throw InvalidInput(vertex_name(v) + " inside the pattern has " + std::to_string(degree[v]) +
                         " creases. Give vertices of four creases, which alone fold exactly");
}

/// Vertices in columns and rows, from a corner of the pattern.
class Grid {
 public:
  explicit Grid(const Pattern& p) : p_(p) {
    std::vector<int> face = corner_face();
    for (bool more = true; more;) {
      add_row(face);
      more = step(face, face[3], face[2]);
    }
    if ((rows_.size() - 1) * (rows_[0].size() - 1) != p.faces.size()) refuse();
  }

  int columns() const { return static_cast<int>(rows_[0].size()) - 1; }
  int rows() const { return static_cast<int>(rows_.size()) - 1; }
  int at(int i, int j) const { return rows_[j][i]; }

 private:
  [[noreturn]] static void refuse() {
    throw InvalidInput(
        "the faces are not a grid of equally long columns and rows. Give a pattern with such a grid");
  }

  /// Returns the face of the first vertex that only one face has, with that vertex at its front.
  std::vector<int> corner_face() const {
    std::vector<int> count(p_.vertices.size(), 0);
    for (const auto& face : p_.faces)
      for (const int v : face) ++count[v];
    for (std::vector<int> face : p_.faces)
      for (int k = 0; k < 4; ++k) {
        if (count[face[0]] == 1) return face;
        std::rotate(face.begin(), face.begin() + 1, face.end());
      }
    refuse();
  }

  /// Replaces `face` by the face beyond an edge, turned so that it begins with this edge. @return false if there is
  /// none
  bool step(std::vector<int>& face, int a, int b) const {
    for (const int f : p_.sides.at(ordered(a, b))) {
      std::vector<int> next = p_.faces[f];
      for (int k = 0; k < 4; ++k) {
        if (next[0] == a && next[1] == b) {
          face = next;
          return true;
        }
        std::rotate(next.begin(), next.begin() + 1, next.end());
      }
    }
    return false;
  }

  void add_row(std::vector<int> face) {
    std::vector<int> below = {face[0]}, above = {face[3]};
    std::size_t count = 0;
    while (true) {
      below.push_back(face[1]);
      above.push_back(face[2]);
      if (++count > p_.faces.size()) refuse();
      if (!step_right(face)) break;
    }
    if (rows_.empty()) rows_.push_back(below);
    if (rows_.back() != below || rows_.size() > p_.faces.size()) refuse();
    rows_.push_back(above);
  }

  /// Replaces `face` by the face to its right, beyond its corners [1] and [2]. The new face begins with the old [1]
  /// and ends with the old [2]. @return false if there is none
  bool step_right(std::vector<int>& face) const {
    std::vector<int> next = face;
    if (!step(next, face[2], face[1])) return false;
    face = {next[1], next[2], next[3], next[0]};
    return true;
  }

  const Pattern& p_;
  std::vector<std::vector<int>> rows_;
};

class Reading {
 public:
  explicit Reading(const Pattern& p) : p_(p), grid_(p) {
    if (grid_.columns() < 2 || grid_.rows() < 2)
      throw InvalidInput("the pattern has no inner vertex. Give at least 2 x 2 faces");
    raw_ = model::empty_mesh<double>(grid_.columns(), grid_.rows());
    for (int j = 0; j <= grid_.rows(); ++j)
      for (int i = 0; i <= grid_.columns(); ++i) raw_.at(i, j) = p.vertices[grid_.at(i, j)];
  }

  OrigamiFile run() {
    find_multipliers();
    OrigamiFile out{model::march(boundary()).mesh, {}, 0};
    lay_over(out);
    for (int j = 0; j <= grid_.rows(); ++j)
      for (int i = 0; i <= grid_.columns(); ++i) out.vertex_of.push_back(grid_.at(i, j));
    validate(out.mesh);
    return out;
  }

 private:
  std::string name(int i, int j) const { return vertex_name(grid_.at(i, j)); }

  /// Returns +1 for a valley, -1 for a mountain.
  int sign(int i, int j, int to_i, int to_j) const {
    const Ends edge = ordered(grid_.at(i, j), grid_.at(to_i, to_j));
    const auto found = p_.assignment.find(edge);
    const char letter = found == p_.assignment.end() ? ' ' : found->second;
    if (letter == 'V' || letter == 'v') return 1;
    if (letter == 'M' || letter == 'm') return -1;
    throw InvalidInput(edge_name(edge) +
                       " is inside and neither mountain nor valley. Assign it \"M\" or \"V\"");
  }

  /// Returns |level| over |rising| of the creases of a vertex.
  double ratio(int i, int j) const {
    const Eigen::Vector4d sector = sectors(raw_, i, j);
    const double a = sector[0], b = sector[1];
    if (!(std::abs(a + sector[2] - pi) <= straight_slack))
      throw InvalidInput(name(i, j) +
                         " is not flat-foldable: opposite angles between its creases add up to " +
                         number_text(to_degrees(a + sector[2])) + " deg. Give angles that add up to 180 deg");
    const int right = sign(i, j, i + 1, j), up = sign(i, j, i, j + 1), left = sign(i, j, i - 1, j),
              down = sign(i, j, i, j - 1);
    const bool level_flips = up == down && left != right;
    if (!level_flips && !(left == right && up != down))
      throw InvalidInput(name(i, j) +
                         " does not fold. Give its opposite creases as one pair of equal folds, and one pair "
                         "of a mountain and a valley");
    const double of_other = level_flips ? std::sin((a - b) / 2) / std::sin((a + b) / 2)
                                        : -std::cos((a + b) / 2) / std::cos((a - b) / 2);
    if (!(std::abs(of_other) >= min_ratio))
      throw InvalidInput(name(i, j) +
                         " does not fold: two of its creases lie on one line, and the other two are at right "
                         "angles to them. Change an angle" +
                         "right angles to them");
    if ((of_other > 0) != (right == up))
      throw InvalidInput(name(i, j) +
                         " does not fold. Exchange the mountain and the valley of its unequal pair");
    return std::abs(level_flips ? of_other : 1 / of_other);
  }

  /// Computes the multipliers of all lines from the first column and row of vertices, with a largest of 1. The other
  /// vertices must agree with them.
  void find_multipliers() {
    const int p = grid_.columns() - 1, q = grid_.rows() - 1;
    for (int j = 1; j <= q; ++j) level_.push_back(ratio(1, j));
    for (int i = 1; i <= p; ++i) rising_.push_back(level_[0] / ratio(i, 1));
    for (int j = 1; j <= q; ++j)
      for (int i = 1; i <= p; ++i) {
        const double asked = ratio(i, j), found = level_[j - 1] / rising_[i - 1];
        if (!(std::abs(asked / found - 1) <= same_multiplier))
          throw InvalidInput("the pattern does not fold rigidly: round " + name(i, j) +
                             " its creases fold in the ratio " + number_text(asked) +
                             ", and the other vertices need " + number_text(found));
      }
    double most = 0;
    for (const double c : rising_) most = std::max(most, c);
    for (const double c : level_) most = std::max(most, c);
    for (double& c : rising_) c /= most;
    for (double& c : level_) c /= most;
  }

  double length(int i, int j, int to_i, int to_j) const {
    return (raw_.at(to_i, to_j) - raw_.at(i, j)).norm();
  }

  model::MarchData boundary() const {
    const int n = grid_.columns(), r = grid_.rows();
    model::MarchData data;
    for (int i = 1; i < n; ++i) {
      data.rising.push_back(sign(i, 1, i, 2) * rising_[i - 1]);
      data.bottom_angle.push_back(sectors(raw_, i, 1)[0]);
      if (i > 1) data.bottom_length.push_back(length(i - 1, 1, i, 1));
      data.south.push_back(length(i, 1, i, 0));
      data.north.push_back(length(i, r - 1, i, r));
    }
    for (int j = 1; j < r; ++j) {
      data.level.push_back(sign(1, j, 2, j) * level_[j - 1]);
      data.left_angle.push_back(sectors(raw_, 1, j)[0]);
      if (j > 1) data.left_length.push_back(length(1, j - 1, 1, j));
      data.west.push_back(length(1, j, 0, j));
      data.east.push_back(length(n - 1, j, n, j));
    }
    return data;
  }

  /// Moves the marched mesh to the place of the file's mesh; corners stay those of the file.
  void lay_over(OrigamiFile& out) const {
    const Vector2d along = (raw_.at(2, 1) - raw_.at(1, 1)).normalized();
    Eigen::Matrix2d R;
    R << along.x(), -along.y(), along.y(), along.x();
    int worst_i = 0, worst_j = 0;
    const double edge = mean_edge(raw_);
    for (int j = 0; j <= raw_.rows; ++j)
      for (int i = 0; i <= raw_.columns; ++i) {
        const bool is_corner = (i == 0 || i == raw_.columns) && (j == 0 || j == raw_.rows);
        Vector2d& at = out.mesh.at(i, j);
        at = is_corner ? raw_.at(i, j) : Vector2d(R * at + raw_.at(1, 1));
        const double by = (at - raw_.at(i, j)).norm() / edge;
        if (by <= out.moved) continue;
        out.moved = by;
        worst_i = i;
        worst_j = j;
      }
    if (!(out.moved <= most_moved))
      throw InvalidInput("the pattern does not fold rigidly: " + name(worst_i, worst_j) + " is off by " +
                         number_text(out.moved) +
                         " mean edges from the place that the others need. Correct the pattern: at most " +
                         number_text(most_moved) + " is corrected automatically");
  }

  const Pattern& p_;
  Grid grid_;
  model::QuadMesh raw_;
  std::vector<double> rising_, level_;
};

Place place_at(const std::string& text, std::size_t position, const std::string& file) {
  const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n');
  return {file, static_cast<int>(lines) + 1, targets::column_of(text, position)};
}

}  // namespace

OrigamiFile parse_origami(const std::string& text, const std::string& file) {
  try {
    if (const auto at = targets::find_too_deep(text))
      throw InvalidInput("the lists are nested too deep. Give a FOLD file of at most " +
                             std::to_string(targets::max_document_depth) + " levels",
                         place_at(text, *at, file));
    const Json root = Json::parse(text);
    const Json frame = frame_of(root);
    const Pattern pattern = read_pattern(frame);
    check_degrees(pattern);
    OrigamiFile out = Reading(pattern).run();
    out.unit_mm = unit_of(frame);
    return out;
  } catch (const Json::parse_error& e) {
    throw InvalidInput("this is not JSON. Give a FOLD file",
                       place_at(text, std::min(text.size(), e.byte), file));
  } catch (const Json::out_of_range&) {
    throw InvalidInput("a number is too large. Give smaller numbers", {file});
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty()) throw;
    throw InvalidInput(e.reason(), {file});
  }
}

OrigamiFile read_origami_file(const std::string& file) {
  return parse_origami(targets::read_text_file(file, max_pattern_bytes), file);
}

model::QuadMesh tilted(const OrigamiFile& pattern, double tilt) {
  model::QuadMesh mesh = pattern.mesh;
  for (auto* multipliers : {&mesh.rising, &mesh.level})
    for (double& c : *multipliers) c *= std::tan(tilt);
  return mesh;
}

}  // namespace kinetix::app
