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
std::vector<Figure> stable_state_figures();
std::vector<Figure> elastic_figures();
std::vector<Figure> load_path_figures();
std::vector<Figure> search_figures();
std::vector<Figure> physics_figures();
std::vector<Figure> elastic_physics_figures();
std::vector<Figure> display_figures();
std::vector<Figure> fold_figures();
std::vector<Figure> helmet_figures();
std::vector<Figure> growth_figures();
std::vector<Figure> sweep_figures();
std::vector<Figure> regression_figures();

/// Markdown table: both joint solvers of the physics run on arcs of growing length.
std::string solver_table();

/// SVG picture: energy barrier of the twist unit against its in-plane hinge angle.
std::string barrier_plot();

}  // namespace kinetix::bench
