#include "targets/fold/fold_net.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "model/base/invalid_input.hpp"
#include "targets/document/number.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

void check_faces(const FoldNet& net) {
  if (net.faces.empty()) throw InvalidInput("holds no faces; give at least one");
  std::set<std::string> names;
  for (const FoldFace& face : net.faces) {
    if (std::min(face.width, face.height) < 1 || std::max(face.width, face.height) > max_face_side)
      throw InvalidInput("face " + in_ticks(face.name) + " has " + std::to_string(face.width) + " x " +
                         std::to_string(face.height) + " cells; allowed: 1 to " +
                         std::to_string(max_face_side) + " a side");
    if (!names.insert(face.name).second)
      throw InvalidInput("two faces are named " + in_ticks(face.name) + "; give each its own name");
  }
}

void check_creases(const FoldNet& net) {
  std::set<std::pair<int, int>> pairs;
  for (const FoldCrease& crease : net.creases) {
    const std::string name = "crease " + in_ticks(crease_name(net, crease));
    if (crease.first == crease.second) throw InvalidInput(name + " joins a face with itself");
    if (!pairs.insert(std::minmax(crease.first, crease.second)).second)
      throw InvalidInput(name + " is given twice; give one crease for two faces");
    if (!(std::abs(crease.angle) <= pi))
      throw InvalidInput(name + " turns by " + shortest_text(to_degrees(crease.angle)) +
                         " degrees; allowed: -180 to 180");
  }
}

/// Returns which faces are connected to the first one.
std::vector<bool> reached(const FoldNet& net) {
  std::vector<bool> in(net.faces.size(), false);
  in[0] = true;
  for (std::size_t round = 1; round < net.faces.size(); ++round)
    for (const FoldCrease& c : net.creases)
      if (in[c.first] || in[c.second]) in[c.first] = in[c.second] = true;
  return in;
}

}  // namespace

std::string crease_name(const FoldNet& net, const FoldCrease& crease) {
  return net.faces[crease.first].name + "-" + net.faces[crease.second].name;
}

void validate(const FoldNet& net) {
  check_faces(net);
  check_creases(net);
  const std::vector<bool> in = reached(net);
  const auto loose = std::find(in.begin(), in.end(), false);
  if (loose != in.end())
    throw InvalidInput("face " + in_ticks(net.faces[loose - in.begin()].name) + " is joined to face " +
                       in_ticks(net.faces[0].name) + " by no creases; a net must hang together");
}

}  // namespace kinetix::targets
