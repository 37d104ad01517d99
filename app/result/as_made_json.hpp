#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// The section `as_made` of result.json. @pre run.printed
nlohmann::ordered_json as_made_json(const Run& run);

/// The errors of one kind of all hinges at one place.
struct PlaceSource {
  std::string place;  ///< "column 12": walls along x there, or in a strip all; "row 3": walls along y
  int parameter = 0;  ///< as in model::ScatterSource
  double share = 0;   ///< of the variance, [0, 1]
};
/// What errors do by place, largest first. None of other lattices than squares, whose walls lie in no columns.
std::vector<PlaceSource> sources_by_place(const Run& run);

/// Why prints do not hold, a sentence each; none where they do. @pre run.printed
std::vector<std::string> as_made_reasons(const Run& run);

/// What speaks against the prints beside whether they can be made: that they leave the goal, may touch on the way, need not fold to
/// the side of the design, or that the first order does not hold. @pre run.printed
std::vector<std::string> scatter_warnings(const Run& run);

/// What prints come to, in words, and what counts most. None where that is not known.
std::vector<SummaryLine> as_made_lines(const Run& run);

}  // namespace kinetix::app
