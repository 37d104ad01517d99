#include "app/pipeline/body_pieces.hpp"

#include <algorithm>

#include "app/run/run_options.hpp"
#include "model/base/parallel_runs.hpp"
#include "sim/compression_run.hpp"

namespace kinetix::app {
namespace {

constexpr double bore_share = 1.05;  // times a bore's radius: its polygon's corners lie outside it
constexpr double pin_share =
    2;  // times a pin's reach h / sqrt(12), h the length that bears: a little over h / 2
constexpr double one_shape_mm =
    1e-4;  // mm: rounding of floats far from the origin leaves equal shapes this near

/// Returns the bores of a body. Rods turn in them and do not collide with the material around them.
std::vector<sim::FilledBore> bores_of(const model::Assembly& assembly, int body) {
  std::vector<sim::FilledBore> out;
  for (const model::AssemblyHinge& h : assembly.hinges)
    if (h.rod_mm > 0 && (h.lower == body || h.upper == body))
      out.push_back({h.point, h.axis, bore_share * (h.rod_mm / 2 + h.clearance_mm), pin_share * h.reach_mm});
  return out;
}

std::vector<std::vector<sim::FilledBore>> all_bores(const model::Assembly& assembly) {
  std::vector<std::vector<sim::FilledBore>> out;
  for (int b = 0; b < static_cast<int>(assembly.bodies.size()); ++b) out.push_back(bores_of(assembly, b));
  return out;
}

bool are_same(const sim::FilledBore& a, const sim::FilledBore& b) {
  return a.point == b.point && a.axis == b.axis && a.radius_mm == b.radius_mm && a.half_mm == b.half_mm;
}

bool have_one_shape(const model::AssemblyBody& a, const model::AssemblyBody& b) {
  if (a.solid.triangles != b.solid.triangles) return false;
  return std::equal(a.solid.points.begin(), a.solid.points.end(), b.solid.points.begin(),
                    b.solid.points.end(), [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
                      return ((p - a.position) - (q - b.position)).cwiseAbs().maxCoeff() < one_shape_mm;
                    });
}

/// Returns, for each body, the first body of the same shape.
std::vector<int> first_of_shape(const model::Assembly& assembly) {
  std::vector<int> out, firsts;
  for (int b = 0; b < static_cast<int>(assembly.bodies.size()); ++b) {
    const auto known = std::find_if(firsts.begin(), firsts.end(), [&](int f) {
      return have_one_shape(assembly.bodies[f], assembly.bodies[b]);
    });
    out.push_back(known == firsts.end() ? b : *known);
    if (known == firsts.end()) firsts.push_back(b);
  }
  return out;
}

sim::CutPiece shifted(sim::CutPiece piece, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& corner : piece.corners) corner += by;
  piece.faces.col(3) += piece.faces.leftCols<3>() * by;
  return piece;
}

}  // namespace

std::size_t BodyPieces::count() const {
  std::size_t sum = 0;
  for (const auto& pieces : of_body) sum += pieces.size();
  return sum;
}

bool BodyPieces::fit(const model::Assembly& assembly) const {
  const auto others = all_bores(assembly);
  return std::equal(bores.begin(), bores.end(), others.begin(), others.end(),
                    [](const auto& a, const auto& b) {
                      return std::equal(a.begin(), a.end(), b.begin(), b.end(), are_same);
                    });
}

BodyPieces pieces_of(const model::Assembly& assembly, int threads) {
  Stopwatch watch;
  BodyPieces out{.of_body = {}, .bores = all_bores(assembly)};
  const int count = static_cast<int>(assembly.bodies.size());
  out.of_body.resize(assembly.bodies.size());
  const std::vector<int> first = first_of_shape(assembly);
  model::run_in_parallel(count, threads, [&](int b) {
    if (first[b] == b) out.of_body[b] = sim::convex_cuts(assembly.bodies[b].solid, {.filled = out.bores[b]});
  });
  for (int b = 0; b < count; ++b)
    if (first[b] != b)
      for (const sim::CutPiece& piece : out.of_body[first[b]])
        out.of_body[b].push_back(
            shifted(piece, assembly.bodies[b].position - assembly.bodies[first[b]].position));
  out.seconds = watch.lap();
  return out;
}

sim::ContactParts contact_parts(const BodyPieces& pieces, const model::Assembly& assembly) {
  sim::ContactParts parts;
  for (std::size_t b = 0; b < pieces.of_body.size(); ++b) {
    auto& of_this = parts.of_body.emplace_back();
    for (const sim::CutPiece& piece : pieces.of_body[b])
      of_this.push_back(shifted(piece, -assembly.bodies[b].position).corners);
  }
  return parts;
}

model::ConvexBodies convex_bodies(const BodyPieces& pieces, const model::Assembly& assembly,
                                  const model::Linkage& linkage) {
  model::ConvexBodies out;
  std::vector<int> first;
  for (std::size_t b = 0; b < pieces.of_body.size(); ++b) {
    first.push_back(static_cast<int>(out.pieces.size()));
    for (const sim::CutPiece& piece : pieces.of_body[b]) {
      sim::CutPiece own = shifted(piece, -assembly.bodies[b].position);
      out.pieces.push_back({static_cast<int>(b), std::move(own.corners), std::move(own.faces)});
    }
  }
  for (const sim::TouchingPieces& pair : sim::touching_pieces(linkage, contact_parts(pieces, assembly)))
    out.passing.emplace_back(first[pair.body] + pair.piece, first[pair.other] + pair.piece_of_other);
  return out;
}

}  // namespace kinetix::app
