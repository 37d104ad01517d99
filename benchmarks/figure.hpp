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

std::vector<Figure> whole_run_figures();
std::vector<Figure> model_figures();
std::vector<Figure> stable_state_figures();
std::vector<Figure> play_figures();
std::vector<Figure> elastic_figures();
std::vector<Figure> equilibrium_path_figures();
std::vector<Figure> search_figures();
std::vector<Figure> physics_figures();
std::vector<Figure> elastic_physics_figures();
std::vector<Figure> display_figures();
std::vector<Figure> planar_figures();
std::vector<Figure> scaled_display_figures();
std::vector<Figure> qr_code_figures();
std::vector<Figure> outline_figures();
std::vector<Figure> crease_figures();
std::vector<Figure> surface_figures();
std::vector<Figure> space_figures();
std::vector<Figure> certified_figures();
std::vector<Figure> block_stiffness_figures();
std::vector<Figure> framed_physics_figures();
std::vector<Figure> compensation_figures();
std::vector<Figure> print_figures();
std::vector<Figure> print_judge_figures();
std::vector<Figure> measured_figures();
std::vector<Figure> studio_figures();
std::vector<Figure> bridge_figures();
std::vector<Figure> import_figures();
std::vector<Figure> fold_figures();
std::vector<Figure> helmet_figures();
std::vector<Figure> growth_figures();
std::vector<Figure> sweep_figures();
std::vector<Figure> regression_figures();
std::vector<Figure> speed_error_figures();
std::vector<Figure> mechanism_figures();
std::vector<Figure> mujoco_figures();
std::vector<Figure> search_peer_figures();

/// Markdown table: both joint solvers of the physics run on arcs of growing length.
std::string solver_table();

/// SVG picture: energy barrier of the twist unit against its in-plane hinge angle.
std::string barrier_plot();

/// SVG picture: energy barrier of the paper's twist unit against the clearance of its pins.
std::string play_plot();

/// Markdown table and SVG picture: speed against error of every method on every scene.
std::string speed_error_section();
std::string speed_error_picture();

}  // namespace kinetix::bench
