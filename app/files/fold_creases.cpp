#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "app/files/crease_pattern.hpp"
#include "model/base/geometry.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Json = nlohmann::json;

constexpr double plane_error =
    1e-6;  // of the size of a pattern: vertices within this distance of a plane are in it

std::string numbered(const char* noun, std::size_t number) {
  return std::string(noun) + " " + std::to_string(number);
}

/// A frame of a FOLD file with those from which it inherits.
class InheritingFrame {
 public:
  /// @param number 0 for the file itself, otherwise from 1 in file_frames
  InheritingFrame(const Json& root, std::size_t number) {
    while (true) {
      const Json& frame = number == 0 ? root : root["file_frames"][number - 1];
      if (!frame.is_object()) refuse(number);
      chain_.push_back(&frame);
      if (number == 0 || frame.value("frame_inherit", Json(false)) != Json(true)) return;
      const Json parent = frame.value("frame_parent", Json(0));
      if (!parent.is_number_unsigned() || parent.get<std::size_t>() > root["file_frames"].size() ||
          chain_.size() > targets::max_document_depth)
        refuse(number);
      number = parent.get<std::size_t>();
    }
  }

  /// Returns a value, also an inherited one; null if there is none.
  const Json* find(const char* key) const {
    for (const Json* frame : chain_)
      if (const auto found = frame->find(key); found != frame->end()) return &*found;
    return nullptr;
  }

  bool has_list(const char* key) const {
    const Json* list = find(key);
    return list && list->is_array() && !list->empty();
  }

  const Json& list(const char* key) const {
    const Json* found = find(key);
    if (!found || !found->is_array()) refuse_without(key);
    return *found;
  }

  /// Returns whether `frame_classes` of the frame itself has a word.
  bool has_class(const char* word) const {
    const auto classes = chain_.front()->find("frame_classes");
    return classes != chain_.front()->end() && classes->is_array() &&
           std::find(classes->begin(), classes->end(), Json(word)) != classes->end();
  }

  [[noreturn]] static void refuse_without(const std::string& key) {
    throw InvalidInput("this is not a FOLD file of a crease pattern: it has no `" + key +
                       "`. Give vertices_coords, edges_vertices and edges_assignment");
  }

 private:
  [[noreturn]] static void refuse(std::size_t number) {
    throw InvalidInput(
        numbered("frame", number) +
        " inherits from a missing frame, from itself, or over more frames than allowed. Give at most " +
        std::to_string(targets::max_document_depth) + " ancestors");
  }

  std::vector<const Json*> chain_;
};

Vector3d point_of(const Json& at, std::size_t v) {
  Vector3d p = Vector3d::Zero();
  bool fits = at.is_array() && (at.size() == 2 || at.size() == 3);
  for (std::size_t k = 0; fits && k < at.size(); ++k) {
    fits = at[k].is_number();
    if (fits) p[static_cast<Eigen::Index>(k)] = at[k].get<double>();
  }
  if (!fits || !p.allFinite())
    throw InvalidInput("vertices_coords: " + numbered("vertex", v) + " is not a point. Give [x, y]");
  return p;
}

int index_of(const Json& number, std::size_t count, const std::string& where) {
  if (!number.is_number_integer() || number.get<long>() < 0 || number.get<long>() >= static_cast<long>(count))
    throw InvalidInput(where + " refers to a missing vertex. Give numbers from 0 to " +
                       std::to_string(static_cast<long>(count) - 1));
  return number.get<int>();
}

/// Returns the unit of a frame, mm; empty if the frame has "unit" or none.
std::optional<double> unit_of(const InheritingFrame& frame) {
  static const std::map<std::string, double> known = {
      {"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"pt", 25.4 / 72}};
  const Json* found = frame.find("frame_unit");
  if (!found) return std::nullopt;
  const std::string word = found->is_string() ? found->get<std::string>() : found->dump();
  if (word == "unit") return std::nullopt;
  if (const auto unit = known.find(word); unit != known.end()) return unit->second;
  throw InvalidInput("the unit " + targets::in_ticks(word) +
                     " (frame_unit) is not known. Give unit, mm, cm, m, in or pt");
}

/// Axes of a plane as its two rows.
using PlaneAxes = Eigen::Matrix<double, 2, 3>;

/// Returns the axes of the plane in which all points are; empty if they are in no plane. Planes across a coordinate
/// axis keep the order of the other two. @param normal wanted direction of the plane's upper side; 0 for any
std::optional<PlaneAxes> plane_of(const std::vector<Vector3d>& points, const Vector3d& normal) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points) middle += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : points) {
    spread += (p - middle) * (p - middle).transpose();
    box.extend(p);
  }
  const double near = points.empty() ? 0 : plane_error * box.sizes().norm();
  for (const auto& [u, v] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
    if (box.isEmpty() || !(box.sizes()[3 - u - v] <= near)) continue;
    PlaneAxes axes = PlaneAxes::Zero();
    axes(0, u) = axes(1, v) = 1;
    const Vector3d up = axes.row(0).transpose().cross(axes.row(1).transpose());
    // The letters of a pattern in z = 0 are those seen from above.
    if (u + v > 1 && up.dot(normal) < 0) axes.row(0) *= -1;
    return axes;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  Vector3d up = solver.eigenvectors().col(0);
  for (const Vector3d& p : points)
    if (!(std::abs(up.dot(p - middle)) <= near)) return std::nullopt;
  if (up.dot(normal) < 0 || (normal.isZero() && up.z() < 0)) up *= -1;
  PlaneAxes axes;
  axes.row(0) = solver.eigenvectors().col(2).transpose();
  axes.row(1) = up.cross(Vector3d(axes.row(0).transpose())).transpose();
  return axes;
}

/// Reads one frame.
class FrameReader {
 public:
  explicit FrameReader(const InheritingFrame& frame) : frame_(frame) {
    for (const Json& at : frame.list("vertices_coords")) points_.push_back(point_of(at, points_.size()));
    read_faces();
    read_edges();
  }

  /// Returns the lines in the plane of the frame; empty if it is in no plane.
  std::optional<CreaseLines> lines() const {
    std::vector<Vector3d> used;
    for (const auto& [a, b] : edges_)
      for (const int v : {a, b}) used.push_back(points_[v]);
    const auto axes = plane_of(used, normal());
    if (!axes) return std::nullopt;
    CreaseLines out;
    for (const Vector3d& p : points_) out.vertices.push_back(*axes * p);
    for (const auto& [a, b] : edges_) out.lines.push_back({out.vertices[a], out.vertices[b]});
    out.letters = letters_;
    for (const auto& face : faces_)
      out.face_area +=
          std::abs(signed_area(face.size(), [&](std::size_t k) { return out.vertices[face[k]]; }));
    out.unit_mm = unit_of(frame_);
    return out;
  }

 private:
  void read_faces() {
    if (!frame_.has_list("faces_vertices")) return;
    for (const Json& list : frame_.list("faces_vertices")) {
      const std::string name = numbered("face", faces_.size());
      if (!list.is_array() || list.size() < 3)
        throw InvalidInput(name + " has less than 3 corners. Give the vertices around each face");
      std::vector<int>& face = faces_.emplace_back();
      for (const Json& v : list) face.push_back(index_of(v, points_.size(), name));
    }
  }

  void read_edges() {
    if (!frame_.has_list("edges_vertices")) {
      if (faces_.empty() || frame_.has_list("edges_assignment"))
        InheritingFrame::refuse_without("edges_vertices");
      std::set<std::pair<int, int>> known;
      for (const auto& face : faces_)
        for (std::size_t k = 0; k < face.size(); ++k)
          known.insert(std::minmax(face[k], face[(k + 1) % face.size()]));
      edges_.assign(known.begin(), known.end());
      letters_.assign(edges_.size(), 'U');
      return;
    }
    const Json& edges = frame_.list("edges_vertices");
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::string name = numbered("edge", e);
      if (!edges[e].is_array() || edges[e].size() != 2)
        throw InvalidInput(name + " does not join two vertices. Give two different vertices");
      edges_.emplace_back(index_of(edges[e][0], points_.size(), name),
                          index_of(edges[e][1], points_.size(), name));
      letters_.push_back(letter_of(e));
    }
  }

  /// Returns the fold angle of an edge, in degrees; empty if it has none.
  std::optional<double> angle_of(std::size_t edge) const {
    const Json* angles = frame_.find("edges_foldAngle");
    if (!angles || !angles->is_array() || edge >= angles->size() || !(*angles)[edge].is_number())
      return std::nullopt;
    return (*angles)[edge].get<double>();
  }

  /// Returns the letter of a sign. @param flat letter of the angle 0
  static char letter_of_angle(double angle, char flat) { return angle > 0 ? 'V' : angle < 0 ? 'M' : flat; }

  char letter_of(std::size_t edge) const {
    const std::optional<double> angle = angle_of(edge);
    const Json* words = frame_.find("edges_assignment");
    if (!words) return angle ? letter_of_angle(*angle, 'F') : 'U';
    if (!words->is_array() || edge >= words->size() || !(*words)[edge].is_string())
      InheritingFrame::refuse_without("edges_assignment");
    const std::string word = (*words)[edge].get<std::string>();
    const char letter =
        word.size() == 1 ? static_cast<char>(std::toupper(static_cast<unsigned char>(word[0]))) : ' ';
    if (letter == 'U') return letter_of_angle(angle.value_or(0), 'U');
    if (letter == 'J') return letter_of_angle(angle.value_or(0), 'F');
    if (std::string_view("MVBCF").find(letter) == std::string_view::npos)
      throw InvalidInput(numbered("edge", edge) + " has the letter " + targets::in_ticks(word) +
                         ". Give M, V, B, F, U, C or J");
    return letter;
  }

  /// Returns the sum of the normals of the faces, each as long as twice its area; 0 without faces.
  Vector3d normal() const {
    Vector3d sum = Vector3d::Zero();
    for (const auto& face : faces_)
      for (std::size_t k = 2; k < face.size(); ++k)
        sum += (points_[face[k - 1]] - points_[face[0]]).cross(points_[face[k]] - points_[face[0]]);
    return sum;
  }

  const InheritingFrame& frame_;
  std::vector<Vector3d> points_;
  std::vector<std::vector<int>> faces_;
  std::vector<std::pair<int, int>> edges_;
  std::vector<char> letters_;
};

Json parse_fold(const std::string& text) {
  const auto place_at = [&](std::size_t position) {
    const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n');
    return Place{"", static_cast<int>(lines) + 1, targets::column_of(text, position)};
  };
  if (const auto at = targets::find_too_deep(text))
    throw InvalidInput("the lists are nested too deep. Give a FOLD file of at most " +
                           std::to_string(targets::max_document_depth) + " levels",
                       place_at(*at));
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& e) {
    throw InvalidInput("this is not JSON. Give a FOLD file", place_at(std::min(text.size(), e.byte)));
  } catch (const Json::out_of_range&) {
    throw InvalidInput("a number is too large. Give smaller numbers");
  }
}

/// Returns the frames that may be a crease pattern: those that say so, then others, and folded forms last.
std::vector<std::size_t> ordered_frames(const Json& root) {
  const auto frames = root.find("file_frames");
  const std::size_t count = frames != root.end() && frames->is_array() ? frames->size() : 0;
  std::vector<std::size_t> of_class[3];
  for (std::size_t k = 0; k <= count; ++k) {
    if (k > 0 && !(*frames)[k - 1].is_object()) continue;
    const InheritingFrame frame(root, k);
    if (!frame.has_list("vertices_coords") ||
        !(frame.has_list("edges_vertices") || frame.has_list("faces_vertices")))
      continue;
    of_class[frame.has_class("creasePattern") ? 0 : frame.has_class("foldedForm") ? 2 : 1].push_back(k);
  }
  std::vector<std::size_t> out;
  for (const auto& some : of_class) out.insert(out.end(), some.begin(), some.end());
  return out;
}

}  // namespace

CreaseLines read_fold_creases(const std::string& text) {
  const Json root = parse_fold(text);
  if (!root.is_object())
    throw InvalidInput("this is not a FOLD file: its JSON is not an object. Give a FOLD file");
  const std::vector<std::size_t> frames = ordered_frames(root);
  for (const std::size_t k : frames) {
    const InheritingFrame frame(root, k);
    if (auto lines = FrameReader(frame).lines()) return *std::move(lines);
  }
  if (!frames.empty())
    throw InvalidInput(
        "the vertices are not in a plane: this is a folded form. Give the flat crease pattern");
  const InheritingFrame top(root, 0);
  for (const char* key : {"vertices_coords", "edges_vertices"})
    if (!top.has_list(key)) InheritingFrame::refuse_without(key);
  InheritingFrame::refuse_without("edges_vertices");
}

}  // namespace kinetix::app
