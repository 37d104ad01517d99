#include "app/files/origami_file.hpp"

#include <fmt/format.h>
#include <filesystem>

#include "app/files/crease_pattern.hpp"
#include "model/lattice/origami/crease_signs.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

constexpr std::size_t max_pattern_bytes = 16 << 20;  // bytes, 16 MiB as for designs, some 100 000 facets
constexpr double reported_move = 1e-4;               // mean edges: files of six digits need less

CreaseLines read_crease_lines(const std::string& text, const std::string& file) {
  const std::string ending = targets::lower_case(std::filesystem::path(file).extension().string());
  if (ending == ".svg") return read_drawn_creases(targets::parse_svg(text));
  if (ending == ".dxf") return read_drawn_creases(targets::parse_dxf(text));
  if (ending == ".cp") return read_cp_creases(text);
  return read_fold_creases(text);
}

std::vector<std::string> notes_on(const CreaseMesh& pattern, const model::SolvedSigns& signs, double moved) {
  std::vector<std::string> notes;
  if (pattern.joined)
    notes.push_back(fmt::format("ends of creases up to {:.2g} apart were joined, in the unit of the file",
                                *pattern.joined));
  if (signs.is_either)
    notes.push_back(
        fmt::format("none of {} creases is mountain or valley. They follow from the angles up to turning "
                    "the sheet over, and one of its two sides was chosen",
                    signs.solved));
  else if (signs.solved > 0)
    notes.push_back(fmt::format("mountain or valley of {} follows from the angles and the other creases",
                                targets::counted(signs.solved, "crease")));
  if (moved > reported_move)
    notes.push_back(
        fmt::format("vertices were moved by up to {:.2g} % of the mean edge, so that the pattern folds "
                    "flat",
                    100 * moved));
  return notes;
}

/// Pattern with its columns and rows.
struct GriddedPattern {
  CreaseMesh pattern;
  QuadGrid grid;
};

GriddedPattern gridded(CreaseMesh pattern) {
  QuadGrid grid = find_quad_grid(pattern);
  return {std::move(pattern), std::move(grid)};
}

/// Finds the mesh of lines. Lines of drawings, which have no common vertices, are joined widely if they form no mesh
/// otherwise.
GriddedPattern find_mesh(const CreaseLines& lines) {
  try {
    return gridded(make_crease_mesh(lines));
  } catch (const InvalidInput&) {
    if (!lines.vertices.empty()) throw;
    try {
      return gridded(make_crease_mesh(lines, true));
    } catch (const InvalidInput&) {
      // The fault of the lines as they are is the answer.
    }
    throw;
  }
}

OrigamiFile mended_pattern(const CreaseLines& lines) {
  auto [pattern, grid] = find_mesh(lines);
  const model::VertexName name = [&pattern = pattern, &grid = grid](int i, int j) {
    return pattern.name(grid.vertex_of[grid.mesh.vertex(i, j)]);
  };
  const model::SolvedSigns signs = solve_signs(grid.mesh, name);
  const model::MendedMesh mended = mend_mesh(grid.mesh, name);
  validate(mended.mesh);
  return {mended.mesh, mended.moved, notes_on(pattern, signs, mended.moved), lines.unit_mm};
}

}  // namespace

OrigamiFile parse_origami(const std::string& text, const std::string& file) {
  try {
    return mended_pattern(read_crease_lines(text, file));
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty()) throw;
    throw InvalidInput(e.reason(), {file, e.place().line, e.place().column});
  }
}

OrigamiFile read_origami_file(const std::string& file) {
  const std::string ending = targets::lower_case(std::filesystem::path(file).extension().string());
  const bool is_drawing = ending == ".svg" || ending == ".dxf";
  return parse_origami(is_drawing ? targets::read_bytes(file, max_pattern_bytes)
                                  : targets::read_text_file(file, max_pattern_bytes),
                       file);
}

model::QuadMesh tilted(const OrigamiFile& pattern, double tilt) {
  model::QuadMesh mesh = pattern.mesh;
  for (auto* multipliers : {&mesh.rising, &mesh.level})
    for (double& c : *multipliers) c *= std::tan(tilt);
  return mesh;
}

}  // namespace kinetix::app
