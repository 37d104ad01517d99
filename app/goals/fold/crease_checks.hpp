#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/goals/fold/fold_file.hpp"
#include "optim/fold/fit_box.hpp"

namespace kinetix::app {

/// How far a crease of a net folds, rad.
struct FoldedCrease {
  std::string name;
  double asked = 0, reached = 0;
};

/// Every crease of a net of either kind. @param reached of each, rad
template <class Creases, class Name>
std::vector<FoldedCrease> folded_creases(const Creases& creases, const std::vector<double>& reached,
                                         const Name& name) {
  std::vector<FoldedCrease> out;
  for (std::size_t c = 0; c < creases.size(); ++c)
    out.push_back({name(creases[c]), creases[c].angle, reached[c]});
  return out;
}

/// The most that a crease folds too far or not far enough, rad.
double largest_miss(const std::vector<FoldedCrease>& creases);

/// "12 creases within 0.001 deg, faces less than 0.001 of their edge from the solid (rms)". @param rms over the edge of a face
std::string in_words(const std::vector<FoldedCrease>& creases, double rms);

/// What a state lacks of what the file asks, a line each. @param who shows the state: "model"
std::vector<std::string> violations(const FoldFile& file, const std::vector<FoldedCrease>& creases,
                                    double rms, const std::string& who);

/// How far the search may go.
optim::FoldOptions search_of(const FoldFile& file);

/// fold_deg, fold_miss_deg and face_rms. @param state "", or "_physics" for those of the physics run
void add_fold_metrics(const std::vector<FoldedCrease>& creases, double rms, const std::string& state,
                      nlohmann::ordered_json& metrics);

/// `optimiser` of a search by closed form. @param why_not it folds, where it does not
nlohmann::ordered_json closed_form_json(std::size_t starts, int evaluations, bool stopped, bool folds,
                                        const std::string& why_not);

}  // namespace kinetix::app
