#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "targets/display/display_goal.hpp"

struct Pix;  // of leptonica

namespace kinetix::targets {

struct PixDeleter {
  void operator()(Pix* pix) const;
};
using PixPointer = std::unique_ptr<Pix, PixDeleter>;

/// Takes ownership of a result that is null only if memory ran out. @throws std::bad_alloc for null
PixPointer owned(Pix* pix);

/// Ink on paper, much finer than the cells of a panel.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> ink;  ///< 0 = paper, 255 = ink; row after row from the top left
};

/// An upright rectangle in pixels, x to the right and y down from the top left corner of a picture. It may
/// reach beyond the picture, where there is no ink.
struct Window {
  double left = 0, right = 0, top = 0, bottom = 0;
};

/// Returns the window of the whole picture.
Window frame(const Picture& picture);

/// Computes the part of each cell's area that ink covers if the panel fills the window, [0, 1]. It is the mean of the
/// pixels under the cell, each weighted by its part inside. Cells are in the order of DisplayGoal::levels.
/// @pre left < right, top < bottom
std::vector<double> ink_coverage(const Picture& picture, const Window& window, PanelSize size);

/// Connectivity of a binary picture. Its Euler number is components - holes.
struct Topology {
  int components = 0;  ///< of ink; pixels that share an edge or a corner belong together
  int holes = 0;       ///< parts of the paper, joined over edges, that ink encloses
  bool operator==(const Topology&) const = default;
};

/// Computes the topology of the pixels that are at least half ink.
Topology topology(const Picture& picture);

/// Returns the picture in two levels, 0 and 255, without specks: inverts parts of ink, then holes in it, below an
/// area. @param area pixels
Picture without_specks(const Picture& picture, double area);

/// Computes the topology of the letter cells.
Topology topology(const DisplayGoal& goal);

/// Computes the topology that one value per cell can show. Cells above a level between the means of letter and rest
/// count as letter. If any level gives the topology of the goal, the result is that; otherwise it is that of the
/// middle level. Fewer parts or holes than drawn mean that some have merged.
/// @param values in the order of DisplayGoal::levels, larger for the letter
Topology seen_topology(const DisplayGoal& goal, const std::vector<double>& values);

/// Outline of the largest part of a picture, in pixels, y upwards.
struct Silhouette {
  std::vector<Eigen::Vector2d> points;  ///< each once, closed
  std::size_t left_out = 0;             ///< smaller parts, without specks
};

/// Finds the outer outline of the largest connected part of a picture of two levels. A picture whose margin is mostly
/// ink is inverted first. Steps of the pixels are cut off, and the outline keeps within about a pixel of theirs.
/// @throws InvalidInput without a place for a part that reaches the edge of the picture, or has under 20 pixels
Silhouette silhouette_of(const Picture& picture);

}  // namespace kinetix::targets
