#pragma once

#include <string>
#include <vector>

namespace kinetix::bench {

/// One line of the table of benchmarks/README.md.
struct Figure {
  std::string what;
  std::string asked;
  std::string measured;
  bool met = false;
};

std::vector<Figure> model_figures();
std::vector<Figure> search_figures();
std::vector<Figure> physics_figures();

}  // namespace kinetix::bench
